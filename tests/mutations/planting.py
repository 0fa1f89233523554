"""How a fault gets into the code: a function, method or property of it is replaced by one that is wrong."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

from dolfinrod.continuum import forms, pool, recovery

Plant = Callable[[pytest.MonkeyPatch], None]


def replaced(owner: Any, name: str, wrong: Callable[..., Any]) -> Plant:
    """`owner.name(…)` becomes `wrong(right, …)`, with the right one as first argument."""

    def plant(patch: pytest.MonkeyPatch) -> None:
        right = getattr(owner, name)
        patch.setattr(owner, name, lambda *args, **options: wrong(right, *args, **options))

    return plant


def derived(owner: type, name: str, wrong: Callable[[Any], Any]) -> Plant:
    """The property `owner.name` gives `wrong(right value)`."""

    def plant(patch: pytest.MonkeyPatch) -> None:
        right = getattr(owner, name)
        patch.setattr(owner, name, property(lambda self: wrong(right.fget(self))))

    return plant


def all_of(*plants: Plant) -> Plant:
    """One fault in several places."""

    def plant(patch: pytest.MonkeyPatch) -> None:
        for each in plants:
            each(patch)

    return plant


def with_own_discretizations(patch: pytest.MonkeyPatch) -> None:
    """Nothing that a fault has touched is kept for later solves, nothing sound is used meanwhile."""
    patch.setattr(pool, "_IDLE", {"world": OrderedDict(), "self": OrderedDict()})
    patch.setattr(recovery, "_tables", cache(recovery._tables.__wrapped__))


def with_own_forms(patch: pytest.MonkeyPatch) -> None:
    """The same for the weak forms; on disk DOLFINx tells them apart by their formula."""
    with_own_discretizations(patch)
    patch.setattr(forms, "_KNOWN", {})
