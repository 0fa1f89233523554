"""What must be the same for a run to go on: the scene and the options of the model, part by part, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.scene import Dynamic, Prescribed, SceneError

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene

__all__ = ["compare", "goes_on", "identity", "origin"]

Identity = dict[str, str | list[float]]

# Where functions of time are looked at, in t_end, and those of place along each of the first rods.
TIMES = (0.0, 0.137, 0.31, 0.5, 0.71, 1.0)
PLACES, RODS = (0.0, 0.4, 1.0), 10
# Difference of function values, relative to the largest, that another machine may make.
ROUND_OFF = 1e-9


def identity(scene: Scene, options: Mapping[str, object], t_end: float) -> Identity:
    """All that a run depends on, but for how far it goes.

    Functions of time or place cannot be compared; their values at some times and places stand for them. The end of the
    time belongs to it where something grows evenly until then.

    Args:
        scene: What is posed.
        options: Of the model, by name; numbers in a list count to round-off.
        t_end: Up to which functions are looked at [s].

    Returns:
        Name of each part → its value in words, or the values of a function.
    """
    found: Identity = {name: value if isinstance(value, list) else repr(value) for name, value in options.items()}
    return found | dict(_parts(scene, "", scene, t_end))


def compare(kept: Mapping[str, object], own: Identity) -> None:
    """Two runs are the same.

    Args:
        kept: Identity of the one in a file.
        own: Identity of the one that is to go on.

    Raises:
        SceneError: They are not; names the first part that differs.
    """
    for name in (*own, *kept):
        there, here = kept.get(name), own.get(name)
        if _same(there, here):
            continue
        if isinstance(there, list) or isinstance(here, list):
            raise SceneError(f"must be of this scene and model, but {name} had other values")
        words = ("nothing" if value is None else value for value in (there, here))
        raise SceneError("must be of this scene and model, but {} was {} and is {}".format(name, *words))


def origin(start: Result | None) -> list[float] | None:
    """Where a run begins: the time and some places of the last state of a result; None: stress free."""
    if start is None:
        return None
    places = [rod.r[-1, np.linspace(0, len(rod.s) - 1, len(PLACES)).astype(int)] for rod in start.rods[:RODS]]
    return [float(start.t[-1]), *np.ravel(places).tolist()]


def goes_on(before: Scene, scene: Scene) -> bool:
    """Whether a scene in motion is one that was in motion before, from the same start with the same scheme.

    Steps, outputs and the end of the time may be others, the end only where nothing grows evenly until then.
    """
    was, now = before.motion, scene.motion
    if not isinstance(was, Dynamic) or not isinstance(now, Dynamic) or was.scheme != now.scheme:
        return False
    same_end = was.t_end == now.t_end or not _grows_to_the_end(scene)
    return same_end and replace(before, motion=now) == scene


def _grows_to_the_end(scene: Scene) -> bool:
    """Whether the end of the time says how fast something grows."""
    if not isinstance(scene.motion, Dynamic):
        return True
    return any(isinstance(part, Prescribed) and part.history is None for part in scene.supports)


def _parts(value: Any, path: str, scene: Scene, t_end: float) -> Iterator[tuple[str, str | list[float]]]:
    """Every number and name of a record, with its place in the scene."""
    if is_dataclass(value) and not isinstance(value, type):
        if path:
            yield path, type(value).__name__
        for field in fields(value):
            name = f"{path}.{field.name}" if path else field.name
            if name != "motion.t_end" or _grows_to_the_end(scene):
                yield from _parts(getattr(value, field.name), name, scene, t_end)
    elif isinstance(value, tuple) and any(is_dataclass(part) for part in value):
        yield path, f"{len(value)} of them"
        for i, part in enumerate(value):
            yield from _parts(part, f"{path}[{i}]", scene, t_end)
    elif callable(value):
        yield path, _sampled(value, path.rpartition(".")[2], scene, t_end)
    else:
        # The order of a set changes from process to process.
        yield path, repr(sorted(value) if isinstance(value, frozenset) else value)


def _sampled(function: Callable[..., Any], name: str, scene: Scene, t_end: float) -> list[float]:
    """Values of a function: a history f(t), the air's velocity f(x, t), or that of a rod f(x)."""
    times = [part * t_end for part in TIMES]
    if name == "history":
        return [float(function(t)) for t in times]
    x = np.concatenate([rod.centerline(rod.length * np.array(PLACES)) for rod in scene.rods[:RODS]])
    values = [function(x.copy(), t) for t in times] if name == "field" else [function(x)]
    return [float(value) for value in np.ravel(values)]


def _same(there: object, here: str | list[float] | None) -> bool:
    """Whether a part is as it was: in every digit, functions to round-off."""
    if not (isinstance(there, list) and isinstance(here, list)):
        return there == here
    if len(there) != len(here) or not all(isinstance(value, int | float) for value in there):
        return False
    return bool(np.allclose(there, here, rtol=0.0, atol=ROUND_OFF * np.abs(here).max(initial=0.0)))
