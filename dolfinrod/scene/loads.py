"""What acts on a rod; histories are over pseudo-time, in a Dynamic motion over seconds."""

from __future__ import annotations

from dataclasses import dataclass

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.history import History, history
from dolfinrod.scene.quantity import Place, VectorLike, assign, entries, nonnegative, place, rod_index, vector

__all__ = ["FollowerForce", "FollowerMoment", "Gravity", "LineForce", "Load", "PointForce", "PointMoment"]


@dataclass(frozen=True)
class PointForce:
    """Dead force at a section, δW = F·δr.

    Args:
        force: F in spatial axes [N].
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
        history: How it grows; None: proportional, in a Dynamic motion steady.
    """

    force: VectorLike
    at: Place
    rod: int | None = None
    history: History = None

    def __post_init__(self) -> None:
        _check_point_load(self, "force", "N")


@dataclass(frozen=True)
class PointMoment:
    """Dead moment at a section, δW = M·δθ with the spatial spin δθ.

    Args:
        moment: M in spatial axes [N m].
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
        history: How it grows; None: proportional, in a Dynamic motion steady.
    """

    moment: VectorLike
    at: Place
    rod: int | None = None
    history: History = None

    def __post_init__(self) -> None:
        _check_point_load(self, "moment", "N m")


@dataclass(frozen=True)
class FollowerForce:
    """Force fixed to a section, δW = (R·F)·δr.

    Args:
        force: F along d1, d2, d3 [N].
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
        history: How it grows; None: proportional, in a Dynamic motion steady.
    """

    force: VectorLike
    at: Place
    rod: int | None = None
    history: History = None

    def __post_init__(self) -> None:
        _check_point_load(self, "force", "N")


@dataclass(frozen=True)
class FollowerMoment:
    """Moment fixed to a section, δW = (R·M)·δθ.

    Args:
        moment: M about d1, d2, d3 [N m].
        at: "start", "end" or arc length [m].
        rod: Number of the rod; None: every rod.
        history: How it grows; None: proportional, in a Dynamic motion steady.
    """

    moment: VectorLike
    at: Place
    rod: int | None = None
    history: History = None

    def __post_init__(self) -> None:
        _check_point_load(self, "moment", "N m")


@dataclass(frozen=True)
class LineForce:
    """Dead force per reference length, δW = ∫ f·δr ds.

    Args:
        force: f in spatial axes [N/m].
        between: Arc lengths (s_a, s_b) between which it acts [m]; None: the whole rod.
        rod: Number of the rod; None: every rod.
        history: How it grows; None: proportional, in a Dynamic motion steady.

    Raises:
        SceneError: s_a is not below s_b.
    """

    force: VectorLike
    between: tuple[float, float] | None = None
    rod: int | None = None
    history: History = None

    def __post_init__(self) -> None:
        assign(
            self,
            force=vector(self.force, "LineForce.force", "N/m"),
            between=None if self.between is None else _stretch(self.between),
            rod=rod_index(self.rod, "LineForce.rod"),
            history=history(self.history, "LineForce.history"),
        )


@dataclass(frozen=True)
class Gravity:
    """Weight of every rod, δW = ∫ ρA g·δr ds; every section needs its `rhoA`.

    Args:
        g: Acceleration in spatial axes [m/s²].
        history: How it grows; None: proportional, in a Dynamic motion steady.
    """

    g: VectorLike
    history: History = None

    def __post_init__(self) -> None:
        assign(self, g=vector(self.g, "Gravity.g", "m/s²"), history=history(self.history, "Gravity.history"))


PointLoad = PointForce | PointMoment | FollowerForce | FollowerMoment
Load = PointLoad | LineForce | Gravity


def _check_point_load(load: PointLoad, name: str, unit: str) -> None:
    """Check and store the fields of a load at a section; `name` is its vector."""
    kind = type(load).__name__
    assign(
        load,
        at=place(load.at, f"{kind}.at"),
        rod=rod_index(load.rod, f"{kind}.rod"),
        history=history(load.history, f"{kind}.history"),
        **{name: vector(getattr(load, name), f"{kind}.{name}", unit)},
    )


def _stretch(between: object) -> tuple[float, float]:
    """Two ascending arc lengths."""
    field = "LineForce.between"
    a, b = (nonnegative(s, f"{field}[{i}]", "m") for i, s in enumerate(entries(between, field, "m", 2)))
    if a >= b:
        raise SceneError(f"must ascend, got ({a}, {b}) m", field=field)
    return a, b
