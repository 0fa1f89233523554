"""The problem as plain data: rods, what holds them, what acts on them; NumPy only."""

from dolfinrod.scene.air import Air
from dolfinrod.scene.contact import Contact
from dolfinrod.scene.core import Core
from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.friction import Coulomb, CreepingCoulomb
from dolfinrod.scene.history import Steady, corners, factor, kinks
from dolfinrod.scene.kinematics import Kinematics, Planar, Spatial, detect, obstacle
from dolfinrod.scene.loads import FollowerForce, FollowerMoment, Gravity, LineForce, Load, PointForce, PointMoment
from dolfinrod.scene.motion import Dynamic, ImplicitEuler, Midpoint, Static, in_time
from dolfinrod.scene.pressure import AugmentedLagrangian, Penalty, SmoothPenalty
from dolfinrod.scene.rod import Rod
from dolfinrod.scene.rodcontact import RodContact
from dolfinrod.scene.scene import Scene
from dolfinrod.scene.section import Section
from dolfinrod.scene.shape import UniformCurvature
from dolfinrod.scene.spline import Spline
from dolfinrod.scene.supports import Clamp, Guide, Pin, Prescribed, Support
from dolfinrod.scene.surfaces import Cylinder, Groove, Plane, WallMotion
from dolfinrod.scene.touch import Touch
from dolfinrod.scene.velocity import Velocity

__all__ = [
    "Air",
    "AugmentedLagrangian",
    "Clamp",
    "Contact",
    "Core",
    "Coulomb",
    "CreepingCoulomb",
    "Cylinder",
    "Dynamic",
    "FollowerForce",
    "FollowerMoment",
    "Gravity",
    "Groove",
    "Guide",
    "ImplicitEuler",
    "Kinematics",
    "LineForce",
    "Load",
    "Midpoint",
    "Penalty",
    "Pin",
    "Planar",
    "Plane",
    "PointForce",
    "PointMoment",
    "Prescribed",
    "Rod",
    "RodContact",
    "Scene",
    "SceneError",
    "Section",
    "SmoothPenalty",
    "Spatial",
    "Spline",
    "Static",
    "Steady",
    "Support",
    "Touch",
    "UniformCurvature",
    "Velocity",
    "WallMotion",
    "corners",
    "detect",
    "factor",
    "in_time",
    "kinks",
    "obstacle",
]
