"""Supports: which components each holds, and what cannot be."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from math import nan

import numpy as np
import pytest

from dolfinrod.scene import Clamp, Guide, Pin, Prescribed, SceneError, Support

EVERY = frozenset({"x", "y", "z", "rx", "ry", "rz"})


def test_a_clamp_holds_everything_and_a_pin_the_position() -> None:
    assert Clamp("start").held() == EVERY
    assert Pin("end").held() == {"x", "y", "z"}


def test_a_guide_holds_what_it_does_not_free() -> None:
    for n in range(len(EVERY)):
        for free in combinations(sorted(EVERY), n):
            assert Guide("start", free=free).held() == EVERY.difference(free)


def test_what_is_prescribed_is_held() -> None:
    assert Prescribed("end", displacement=(None, 1.0, None)).held() == {"y"}
    assert Prescribed("end", rotation=(0, 0, 1)).held() == {"rx", "ry", "rz"}
    assert Prescribed("end", (1.0, None, 0.0), (0.0, 0.0, 9.0)).held() == {"x", "z", "rx", "ry", "rz"}


def test_supports_compare_by_what_they_are() -> None:
    assert Guide("start", ["x", "rx"]) == Guide("start", free={"rx", "x"})
    assert Prescribed(1, np.array([0, 1, 2])) == Prescribed(1.0, [0.0, 1.0, 2.0])
    assert Prescribed("end", (None, None, None), (1, 0, 0)) == Prescribed("end", rotation=(1, 0, 0))
    assert Clamp("start") != Clamp(0.0)
    assert len({Clamp("start"), Clamp("start"), Pin("start")}) == 2


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Clamp("middle"), r'Clamp\.at must be "start", "end" or an arc length \[m\], got \'middle\''),
        (lambda: Clamp(-0.1), r"Clamp\.at must not be negative, got -0\.1 m"),
        (lambda: Pin(nan), r"Pin\.at must be a finite number \[m\], got nan m"),
        (lambda: Pin("end", rod=-1), r"Pin\.rod must be the number of a rod \(0, 1, …\) or None for every rod, got -1"),
        (lambda: Pin("end", rod=True), r"Pin\.rod must be the number of a rod .*, got True"),
        (lambda: Guide("end", free={"u"}), r"Guide\.free must be a set of names out of x, y, z, rx, ry, rz, got {'u'}"),
        (lambda: Guide("end", free=EVERY), r"Guide\.free must leave something held, got all six components"),
        (lambda: Prescribed("end"), r"Prescribed must have a displacement component or a rotation, got neither"),
        (lambda: Prescribed("end", (None,) * 3), r"Prescribed must have a displacement component or a rotation"),
        (
            lambda: Prescribed("end", (0, nan, None)),
            r"Prescribed\.displacement\[1\] must be a finite number \[m\], got nan m",
        ),
        (lambda: Prescribed("end", (0, 1)), r"Prescribed\.displacement must have 3 entries \[m\], got \(0, 1\)"),
        (lambda: Prescribed("end", rotation=(1, 2)), r"Prescribed\.rotation must have 3 entries \[rad\], got \(1, 2\)"),
        (
            lambda: Prescribed("end", (0, 0, 0), history=[(0, 0), (0, 1)]),
            r"Prescribed\.history\[1\]\[0\] must be later",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_words(make: Callable[[], Support], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()
