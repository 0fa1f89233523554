"""Scenarios that take mechanisms apart: each adds or takes away one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import sqrt
from typing import Any, Literal

from dolfinrod.groove.core import AnyCore, FixedCore, RollingCore
from dolfinrod.groove.limits import known
from dolfinrod.groove.scenario import Scenario
from dolfinrod.scene import Coulomb, Penalty, SceneError, SmoothPenalty

__all__ = ["VARIANTS", "variant", "varied"]

# What each variant is, for lists and pages.
VARIANTS = {
    "L0": "friction as a force alone, core at rest: the paper's",
    "L1": "friction at the surface of the fibres, which it turns",
    "L2": "the core rolls, on contact as much stiffer as it is heavier than a fibre: an extension",
    "S-leading": "the leading end of the edge fibre is free",
    "S-trailing": "the trailing end of the edge fibre is free",
    "pinned": "fibres held sideways at B, too: net winding cannot change",
    "transport": "fibres and roller go on at the speed of the machine, the nip at A with them",
    "transit": "the nip at A has let go of the fibres: they and the roller go on at the speed of the machine",
    "damped": "what strikes a wall, a fibre or the core does not swing back, being damped critically: an extension",
    "mirrored": "left is right",
}
# Of delivery [m/s]: 7000 r/min at 680 turns/m.
DELIVERY = 7000.0 / 60.0 / 680.0


def variant(scenario: Scenario, name: str) -> Scenario:
    """A scenario with one mechanism changed.

    Args:
        scenario: Any.
        name: One of `VARIANTS`.

    Returns:
        Another scenario.

    Raises:
        SceneError: An unknown name, or what cannot be combined.
    """
    known(name, "variant", tuple(VARIANTS))
    return replace(scenario, **_changes(scenario)[name]())


def _changes(scenario: Scenario) -> dict[str, Callable[[], dict[str, Any]]]:
    """Fields that each variant changes, made only where it is asked for: not all can be combined."""
    n, ends = scenario.fibres, scenario.ends
    return {
        "L0": lambda: {**_rubbing(scenario, "centreline"), **_around(scenario, FixedCore())},
        "L1": lambda: {**_rubbing(scenario, "surface"), **_around(scenario, FixedCore())},
        "L2": lambda: {**_rubbing(scenario, "surface"), **_around(scenario, RollingCore())},
        "S-leading": lambda: {"ends": replace(ends, leading=(*ends.leading, n))},
        "S-trailing": lambda: {"ends": replace(ends, trailing=(*ends.trailing, n))},
        "pinned": lambda: {"ends": replace(ends, exit="held")},
        "transport": lambda: {"ends": replace(ends, speed=DELIVERY)},
        "transit": lambda: {"ends": replace(ends, speed=DELIVERY, leading=(), trailing=range(1, n + 1))},
        "damped": lambda: {"law": _damped(scenario)},
        "mirrored": lambda: {"mirrored": not scenario.mirrored},
    }


def varied(scenario: Scenario, name: str, value: Any) -> Scenario:
    """A scenario with one parameter changed.

    Args:
        scenario: Any.
        name: Of the parameter, with a dot in a part: "seed", "ends.tension", "wall_friction.mu".
        value: What it shall be.

    Returns:
        Another scenario.

    Raises:
        SceneError: No such parameter, or a value out of its range.
    """
    part, _, inner = name.partition(".")
    owner: Any = scenario.section if part == "groove" else getattr(scenario, part, None)
    if part not in Scenario.__dataclass_fields__ or (inner and inner not in getattr(owner, "__dataclass_fields__", {})):
        raise SceneError(f"must be the name of a parameter, such as ends.tension, got {name!r}", field="parameter")
    return replace(scenario, **{part: replace(owner, **{inner: value}) if inner else value})


def _around(scenario: Scenario, core: FixedCore | RollingCore) -> dict[str, Any]:
    """A core, and a law with which what moves presses in as deep at one speed, v √(m/ε_N), be it a fibre or the core.

    With the law of fibres a core of 52 of them presses two that cross between it and the wall half-way into each other.
    """
    return {"core": core, "law": scenario.law.softened(_weight(scenario.core) / _weight(core))}


def _weight(core: AnyCore | None) -> float:
    """Mass of the heaviest that moves, in fibres."""
    return core.fibres if isinstance(core, RollingCore) else 1.0


def _damped(scenario: Scenario) -> Penalty | SmoothPenalty:
    """The law with ½ τ √(ε_N/ρA) = 1, ρA being that of the heaviest that moves."""
    law, ρA = scenario.law, _weight(scenario.core) * (scenario.bundle.section.rhoA or 0.0)
    return replace(law, damping=2.0 * sqrt(ρA / law.eps_N))


def _rubbing(scenario: Scenario, at: Literal["surface", "centreline"]) -> dict[str, Any]:
    """Both frictions, acting elsewhere."""
    frictions = {"wall_friction": scenario.wall_friction, "fibre_friction": scenario.fibre_friction}
    return {name: replace(law, at=at) if isinstance(law, Coulomb) else law for name, law in frictions.items()}
