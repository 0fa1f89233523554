"""What a scene file may hold: each kind of table, its constructor and the units of its fields."""

from __future__ import annotations

from dolfinrod.scene.air import Air
from dolfinrod.scene.contact import Contact
from dolfinrod.scene.fields import SPEED, At, Field, Flow, Growth, Modulus, Plain, Quantity, Scheme
from dolfinrod.scene.friction import Coulomb, CreepingCoulomb
from dolfinrod.scene.loads import FollowerForce, FollowerMoment, Gravity, LineForce, PointForce, PointMoment
from dolfinrod.scene.motion import Dynamic, Static
from dolfinrod.scene.pressure import AugmentedLagrangian, Penalty, SmoothPenalty
from dolfinrod.scene.rod import Rod
from dolfinrod.scene.rodcontact import RodContact
from dolfinrod.scene.section import Section
from dolfinrod.scene.supports import Clamp, Guide, Pin, Prescribed
from dolfinrod.scene.surfaces import Cylinder, Groove, Plane, WallMotion
from dolfinrod.scene.tables import Choice, Inner, Kind
from dolfinrod.scene.velocity import Velocity

__all__ = ["AIR", "CONTACT", "LOADS", "MOTIONS", "RODS", "SECTION", "SECTIONS", "SUPPORTS", "TOUCHED", "VELOCITIES"]

METRE, SECOND = Quantity("m"), Quantity("s")
NEWTON, NEWTON_METRE = Quantity("N"), Quantity("N*m")
MATERIAL: dict[str, Field] = {
    "E": Modulus(),
    "G": Modulus(),
    "density": Quantity("kg/m**3"),
    "shear_factor": Plain(),
    "rigid": Plain(),
    "damping": SECOND,
}
SECTION = Kind(
    Section,
    {
        "EA": NEWTON,
        "GA": NEWTON,
        "GJ": Quantity("N*m**2"),
        "EI": Quantity("N*m**2"),
        "rhoA": Quantity("kg/m"),
        "rhoI": Quantity("kg*m"),
        "rigid": Plain(),
        "radius": METRE,
        "damping": SECOND,
    },
)
SECTIONS = Choice(
    {
        "circle": Kind(Section.circle, {"diameter": METRE, **MATERIAL}),
        "rectangle": Kind(Section.rectangle, {"width": METRE, "height": METRE, "torsion": Plain(), **MATERIAL}),
        "ramie": Kind(Section.ramie, {"rigid": Plain(), "damping": SECOND}),
    }
)
FRAMED: dict[str, Field] = {"start": METRE, "direction": Plain(), "d2": Plain(), "pretwist": Quantity("rad/m")}
RODS = Choice(
    {
        "straight": Kind(Rod.straight, {"length": METRE, **FRAMED}),
        "arc": Kind(
            Rod.arc,
            {
                "radius": METRE,
                "angle": Quantity("rad"),
                "start": METRE,
                "direction": Plain(),
                "towards": Plain(),
                "pretwist": Quantity("rad/m"),
            },
        ),
        "curved": Kind(Rod.curved, {"length": METRE, "curvature": Quantity("1/m"), **FRAMED}),
        "through": Kind(Rod.through, {"points": METRE, "d2": Plain(), "pretwist": Quantity("rad/m")}),
        "from_mesh": Kind(
            Rod.from_mesh,
            {"file": Plain(), "unit": Plain(), "group": Plain(), "d2": Plain(), "pretwist": Quantity("rad/m")},
        ),
    }
)
HERE: dict[str, Field] = {"at": At(), "rod": Plain()}
SUPPORTS = Choice(
    {
        "clamp": Kind(Clamp, HERE),
        "pin": Kind(Pin, HERE),
        "guide": Kind(Guide, {"free": Plain(), **HERE}),
        "prescribed": Kind(
            Prescribed,
            {"displacement": Quantity("m", word="free"), "rotation": Quantity("rad"), "history": Growth(), **HERE},
        ),
    }
)
FORCE: dict[str, Field] = {"force": NEWTON, "history": Growth(), **HERE}
MOMENT: dict[str, Field] = {"moment": NEWTON_METRE, "history": Growth(), **HERE}
LOADS = Choice(
    {
        "point_force": Kind(PointForce, FORCE),
        "point_moment": Kind(PointMoment, MOMENT),
        "follower_force": Kind(FollowerForce, FORCE),
        "follower_moment": Kind(FollowerMoment, MOMENT),
        "line_force": Kind(
            LineForce, {"force": Quantity("N/m"), "between": METRE, "rod": Plain(), "history": Growth()}
        ),
        "gravity": Kind(Gravity, {"g": Quantity("m/s**2"), "history": Growth()}),
    }
)
MOTIONS = Choice(
    {
        "static": Kind(Static, {"steps": Plain(), "t_end": Plain()}),
        "dynamic": Kind(
            Dynamic,
            {"t_end": SECOND, "dt": SECOND, "scheme": Scheme(), "tol": Plain(), "output": SECOND, "rest": SPEED},
        ),
    }
)
AIR = Kind(Air, {"field": Flow(), "density": Quantity("kg/m**3"), "viscosity": Quantity("Pa*s")})
VELOCITIES = Kind(Velocity, {"v": Flow(), "omega": Quantity("rad/s"), "about": METRE, "rod": Plain()})
MOTION: dict[str, Field] = {
    "motion": Inner(
        Kind(
            WallMotion,
            {
                "displacement": METRE,
                "rotation": Quantity("rad"),
                "history": Growth(),
                "velocity": Quantity("m/s"),
                "spin": Quantity("rad/s"),
                "about": METRE,
            },
        )
    )
}
SURFACES = {
    "plane": Kind(Plane, {"point": METRE, "normal": Plain(), **MOTION}),
    "cylinder": Kind(Cylinder, {"point": METRE, "axis": Plain(), "radius": METRE, "side": Plain(), **MOTION}),
    "groove": Kind(
        Groove,
        {
            "profile": METRE,
            "point": METRE,
            "axis": Plain(),
            "up": Plain(),
            "fillet": METRE,
            "roller": METRE,
            **MOTION,
        },
    ),
}
STIFFNESS = Quantity("N/m**2")
PENALTIES = {
    "penalty": Kind(Penalty, {"eps_N": STIFFNESS, "g_0": METRE, "damping": SECOND}),
    "smooth_penalty": Kind(SmoothPenalty, {"eps_N": STIFFNESS, "foot": METRE, "g_0": METRE, "damping": SECOND}),
}
LAWS = {"paper": Penalty.paper, "tight": Penalty.tight}
DRY = {"coulomb": Kind(Coulomb, {"mu": Plain(), "eps_T": STIFFNESS, "at": Plain()})}
CONTACT = Kind(
    Contact,
    {
        "law": Choice(
            PENALTIES | {"augmented_lagrangian": Kind(AugmentedLagrangian, {"eps_N": STIFFNESS, "tolerance": METRE})},
            words=LAWS,
        ),
        "friction": Choice(DRY | {"creeping_coulomb": Kind(CreepingCoulomb, {"mu": Plain(), "v_0": Quantity("m/s")})}),
        "rod": Plain(),
    },
)
TOUCHED = Choice(
    SURFACES
    | {"rods": Kind(RodContact, {"law": Choice(PENALTIES, words=LAWS), "friction": Choice(DRY), "rods": Plain()})}
)
