"""Scenes as TOML files: every name as in Python, quantities with their units.

    [section.ramie.circle]
    diameter = "20 um"
    E = "2224.6 cN/tex"        # a modulus per density is multiplied by the density
    G = "106.2 cN/tex"
    density = "1.54 g/cm**3"

    [[rods]]
    straight = { length = "40 mm" }
    section = "ramie"

    [[supports]]
    clamp = { at = "start" }

    [[loads]]
    point_force = { at = "end", force = ["0 N", "-1 uN", "0 N"] }

    [motion.dynamic]
    t_end = "10 ms"
    dt = "1 us"
    scheme = "midpoint"

    [[velocities]]
    omega = [0, 0, "1 turn/s"]

    [air]
    field = ["20 m/s", 0, 0]

    [[contacts]]
    cylinder = { point = [0, 0, "-25 mm"], axis = [0, 1, 0], radius = "25 mm" }
    law.penalty = { eps_N = "4e5 N/m**2", g_0 = "1 um" }
    friction.coulomb = { mu = 0.64 }

    [[contacts]]
    rods = { law = "tight", friction.coulomb = { mu = 0.3 }, rods = [0, 1] }

Plain numbers are SI. A section is `circle`, `rectangle` or `ramie`, or has the fields of `Section` itself. A history is
"steady" or rows [t, factor]; a displacement that is not prescribed is "free". Without a table `motion` the scene is
static. The file of a rod `from_mesh` is sought from the folder of the scene file. The law of a contact may be "paper"
or "tight" instead of a table; a table `motion` of its surface says how that moves. Contact of rods with rods is a table
`rods`, those it names or all.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from dolfinrod.scene import source
from dolfinrod.scene.contact import Contact
from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.kinds import AIR, CONTACT, LOADS, MOTIONS, RODS, SUPPORTS, TOUCHED, VELOCITIES
from dolfinrod.scene.motion import Static
from dolfinrod.scene.options import options
from dolfinrod.scene.rod import Rod
from dolfinrod.scene.rodcontact import RodContact
from dolfinrod.scene.scene import MOST_PARTS, Scene
from dolfinrod.scene.section import Section
from dolfinrod.scene.sectiontables import read_section, section_table
from dolfinrod.scene.shape import UniformCurvature
from dolfinrod.scene.spline import Spline
from dolfinrod.scene.tables import meant, refuse_unknown, table_of

__all__ = ["dumps", "load", "loads", "parsed"]

TABLES = ("section", "rods", "supports", "loads", "contacts", "air", "motion", "velocities", "solve")
# The time of tomllib grows with the square of the names in a dotted key.
NAME = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+"""
ENDLESS_KEY = re.compile(rf"""(?<![\w"'-])(?:{NAME}\.[ \t]*+){{32}}""")


def load(path: str | Path) -> tuple[Scene, dict[str, Any]]:
    """A scene from a file.

    Args:
        path: Of a TOML file.

    Returns:
        The scene, and the options of its table `solve`.

    Raises:
        SceneError: Not TOML, or a field that is unknown, missing, or cannot be.
        OSError: The file cannot be read.
    """
    return loads(source.text(path), folder=Path(path).parent)


def loads(text: str, *, folder: str | Path = ".") -> tuple[Scene, dict[str, Any]]:
    """A scene from the text of a file; as `load`, the files it names being sought from `folder`."""
    try:
        data = parsed(text)
        scene = _scene(data, Path(folder))
        return scene, options(table_of(data.get("solve", {}), "solve"), len(scene.rods))
    except RecursionError:
        raise SceneError("a scene must not nest lists and tables so deeply") from None


def parsed(text: str) -> dict[str, Any]:
    """The tables that a text holds.

    Args:
        text: TOML.

    Returns:
        Its tables.

    Raises:
        SceneError: Not TOML, or tables within tables without end.
    """
    if ENDLESS_KEY.search(text):
        raise SceneError("a scene must not nest tables so deeply: more than 32 names joined by dots")
    # Numbers of thousands of digits are a ValueError of their own.
    try:
        return tomllib.loads(text)
    except ValueError as error:
        raise SceneError(f"a scene must be a TOML file: {error}") from None


def _scene(data: Mapping[str, Any], folder: Path) -> Scene:
    """The scene that the tables of a file describe."""
    refuse_unknown(data, TABLES, "")
    sections = {
        name: read_section(table, f"section.{name}")
        for name, table in table_of(data.get("section", {}), "section").items()
    }
    return Scene(
        rods=[_rod(table, f"rods[{i}]", sections, folder) for i, table in enumerate(_list(data, "rods"))],
        supports=[SUPPORTS.read(table, f"supports[{i}]") for i, table in enumerate(_list(data, "supports"))],
        loads=[LOADS.read(table, f"loads[{i}]") for i, table in enumerate(_list(data, "loads"))],
        contacts=[_contact(table, f"contacts[{i}]") for i, table in enumerate(_list(data, "contacts"))],
        air=AIR.read(data["air"], "air") if "air" in data else None,
        motion=MOTIONS.read(data["motion"], "motion") if data.get("motion", {}) != {} else Static(),
        velocities=[VELOCITIES.read(table, f"velocities[{i}]") for i, table in enumerate(_list(data, "velocities"))],
    )


def dumps(scene: Scene, solve: Mapping[str, Any] | None = None) -> str:
    """The text of a scene file from which `loads` makes an equal scene.

    Args:
        scene: Any scene without functions.
        solve: Options for the table `solve`.

    Returns:
        TOML, in SI units.

    Raises:
        SceneError: A history or a velocity is a function.
    """
    import tomli_w

    sections = list(dict.fromkeys(rod.section for rod in scene.rods))
    names = {section: f"section_{i}" for i, section in enumerate(sections)}
    tables = {
        "section": {name: section_table(section, f"section.{name}") for section, name in names.items()},
        "rods": [_shape(rod, f"rods[{i}]") | {"section": names[rod.section]} for i, rod in enumerate(scene.rods)],
        "supports": [SUPPORTS.write(part, f"supports[{i}]") for i, part in enumerate(scene.supports)],
        "loads": [LOADS.write(part, f"loads[{i}]") for i, part in enumerate(scene.loads)],
        "contacts": [_touching(part, f"contacts[{i}]") for i, part in enumerate(scene.contacts)],
        "air": {} if scene.air is None else AIR.told(scene.air, "air"),
        "motion": MOTIONS.write(scene.motion, "motion"),
        "velocities": [VELOCITIES.told(v, f"velocities[{i}]") for i, v in enumerate(scene.velocities)],
        "solve": dict(solve or {}),
    }
    return tomli_w.dumps({name: table for name, table in tables.items() if table})


def _rod(table: Any, path: str, sections: Mapping[str, Section], folder: Path) -> Rod:
    """A rod: its shape, and the name of its section; a mesh lies beside the scene file."""
    shape = dict(table_of(table, path))
    if "section" not in shape:
        raise SceneError("is missing", field=f"{path}.section")
    name = shape.pop("section")
    if not isinstance(name, str) or name not in sections:
        close = meant(name, sections) if isinstance(name, str) else ""
        message = f"must be the name of a section ({', '.join(sections)}), got {name!r}{close}"
        raise SceneError(message, field=f"{path}.section")
    kind, inner, path = RODS.chosen(shape, path)
    if kind is RODS.kinds["from_mesh"] and isinstance(inner, dict) and isinstance(inner.get("file"), str):
        inner = inner | {"file": folder / inner["file"]}
    rod: Rod = kind.read(inner, path, section=sections[name])
    return rod


def _contact(table: Any, path: str) -> Contact | RodContact:
    """A contact: the surface its table names and the laws beside it; or a table of rods, with laws of its own."""
    table = table_of(table, path)
    refuse_unknown(table, (*TOUCHED.kinds, *CONTACT.fields), path)
    laws = {name: table[name] for name in CONTACT.fields if name in table}
    touched = TOUCHED.read({name: table[name] for name in TOUCHED.kinds if name in table}, path)
    if isinstance(touched, RodContact):
        for name in laws:
            raise SceneError("must be left out here, and may stand in the table rods", field=f"{path}.{name}")
        return touched
    contact: Contact = CONTACT.read(laws, path, surface=touched)
    return contact


def _touching(contact: Contact | RodContact, path: str) -> dict[str, Any]:
    """The table of a contact."""
    if isinstance(contact, RodContact):
        return TOUCHED.write(contact, path)
    return TOUCHED.write(contact.surface, path) | CONTACT.told(contact, path)


def _list(data: Mapping[str, Any], name: str) -> list[Any]:
    """An array of tables, empty where it is left out."""
    value = data.get(name, [])
    if not isinstance(value, list):
        raise SceneError(f"must be a list of tables, written [[{name}]], got {value!r}", field=name)
    if len(value) > MOST_PARTS:  # before each is read
        raise SceneError(f"must be at most {MOST_PARTS}, got {len(value)}", field=name)
    return value


def _shape(rod: Rod, path: str) -> dict[str, Any]:
    """The table that names the shape of a rod; an arc is written as curved, to keep every digit of its curvature."""
    shape = rod.shape
    values: dict[str, Any] = {"pretwist": rod.pretwist or None}
    if isinstance(shape, UniformCurvature):
        name = "curved" if any(shape.kappa) else "straight"
        values |= {"length": shape.length, "start": shape.start, "direction": shape.direction, "d2": shape.d2}
        values["curvature"] = shape.kappa if any(shape.kappa) else None
    elif isinstance(shape, Spline):
        name = "through"
        values |= {"points": shape.points, "d2": shape.d2}
    else:
        raise SceneError(f"must be a shape of this package to be written to a file, got {shape!r}", field=path)
    return {name: RODS.kinds[name].write(values, f"{path}.{name}")}
