"""Scenarios that take mechanisms apart: each adds or takes away one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

from dolfinrod.groove.core import FixedCore, RollingCore
from dolfinrod.groove.limits import known
from dolfinrod.groove.scenario import Scenario
from dolfinrod.scene import Coulomb, SceneError

__all__ = ["VARIANTS", "variant", "varied"]

# What each variant is, for lists and pages.
VARIANTS = {
    "L0": "friction as a force alone, core at rest: the paper's",
    "L1": "friction at the surface of the fibres, which it turns",
    "L2": "the core rolls: an extension",
    "S-leading": "the leading end of the edge fibre is free",
    "S-trailing": "the trailing end of the edge fibre is free",
    "pinned": "fibres held sideways at B, too: net winding cannot change",
    "transport": "fibres and roller go on at the speed of the machine",
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
    edge, ends = scenario.fibres, scenario.ends
    changes: dict[str, dict[str, Any]] = {
        "L0": {**_rubbing(scenario, "centreline"), "core": FixedCore()},
        "L1": {**_rubbing(scenario, "surface"), "core": FixedCore()},
        "L2": {**_rubbing(scenario, "surface"), "core": RollingCore()},
        "S-leading": {"ends": replace(ends, leading=(*ends.leading, edge))},
        "S-trailing": {"ends": replace(ends, trailing=(*ends.trailing, edge))},
        "pinned": {"ends": replace(ends, exit="held")},
        "transport": {"ends": replace(ends, speed=DELIVERY)},
        "mirrored": {"mirrored": not scenario.mirrored},
    }
    return replace(scenario, **changes[known(name, "variant", tuple(VARIANTS))])


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


def _rubbing(scenario: Scenario, at: Literal["surface", "centreline"]) -> dict[str, Any]:
    """Both frictions, acting elsewhere."""
    frictions = {"wall_friction": scenario.wall_friction, "fibre_friction": scenario.fibre_friction}
    return {name: replace(law, at=at) if isinstance(law, Coulomb) else law for name, law in frictions.items()}
