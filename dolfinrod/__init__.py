"""Rods in space: one scene, posed once as plain data, solved by the continuum model.

    import dolfinrod as dr

    rod = dr.Rod.straight(length=1.0, section=dr.Section(EA=1e4, GA=4e3, GJ=1.0, EI=1.0))
    scene = dr.Scene(rods=[rod], supports=[dr.Clamp(at="start")], loads=[dr.PointForce((0, -1, 0), at="end")])
    result = dr.solve(scene, elements=8, degree=3)

Importing this package loads neither DOLFINx nor PETSc; `solve` does. `groove` and `twist` load when they are used.
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from dolfinrod.eigen import Buckling, Modes, RodShapes
from dolfinrod.result import (
    ContactHistory,
    Formulation,
    MeetingHistory,
    Meetings,
    NotConverged,
    Result,
    RodHistory,
    Statistics,
    StepLog,
    Touching,
)
from dolfinrod.scene import (
    Air,
    AugmentedLagrangian,
    Clamp,
    Contact,
    Core,
    Coulomb,
    CreepingCoulomb,
    Cylinder,
    Dynamic,
    FollowerForce,
    FollowerMoment,
    Gravity,
    Groove,
    Guide,
    ImplicitEuler,
    LineForce,
    Midpoint,
    Penalty,
    Pin,
    Planar,
    Plane,
    PointForce,
    PointMoment,
    Prescribed,
    Rod,
    RodContact,
    Scene,
    SceneError,
    Section,
    SmoothPenalty,
    Spatial,
    Static,
    Steady,
    Velocity,
    WallMotion,
)
from dolfinrod.solving import buckling, critical, modes, solve

if TYPE_CHECKING:
    from dolfinrod import groove, twist

__all__ = [
    "Air",
    "AugmentedLagrangian",
    "Buckling",
    "Clamp",
    "Contact",
    "ContactHistory",
    "Core",
    "Coulomb",
    "CreepingCoulomb",
    "Cylinder",
    "Dynamic",
    "FollowerForce",
    "FollowerMoment",
    "Formulation",
    "Gravity",
    "Groove",
    "Guide",
    "ImplicitEuler",
    "LineForce",
    "MeetingHistory",
    "Meetings",
    "Midpoint",
    "Modes",
    "NotConverged",
    "Penalty",
    "Pin",
    "Planar",
    "Plane",
    "PointForce",
    "PointMoment",
    "Prescribed",
    "Result",
    "Rod",
    "RodContact",
    "RodHistory",
    "RodShapes",
    "Scene",
    "SceneError",
    "Section",
    "SmoothPenalty",
    "Spatial",
    "Static",
    "Statistics",
    "Steady",
    "StepLog",
    "Touching",
    "Velocity",
    "WallMotion",
    "buckling",
    "critical",
    "groove",
    "modes",
    "solve",
    "twist",
]


def __getattr__(name: str) -> ModuleType:
    """Packages of their own, loaded when somebody asks for them: most scenes have neither."""
    if name in ("groove", "twist"):
        return import_module(f"dolfinrod.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
