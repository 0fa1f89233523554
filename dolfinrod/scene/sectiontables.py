"""The table of a section: its shape and material, or its stiffnesses."""

from __future__ import annotations

from typing import Any

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.fields import Specific
from dolfinrod.scene.kinds import SECTION, SECTIONS
from dolfinrod.scene.section import Section
from dolfinrod.scene.tables import table_of

__all__ = ["read_section", "section_table"]


def read_section(table: Any, path: str) -> Section:
    """A section by shape and material, or by its stiffnesses.

    Args:
        table: What TOML holds.
        path: Where it stands.

    Returns:
        The section.

    Raises:
        SceneError: An unknown or missing field, or a value that cannot be.
    """
    table = table_of(table, path)
    shapes = table.keys() & SECTIONS.kinds.keys()
    if not shapes:
        section: Section = SECTION.read(table, path)
        return section
    kind, inner, path = SECTIONS.chosen(table, path)
    values = kind.values(inner, path, {})
    for name, value in values.items():
        if isinstance(value, Specific):
            if values.get("density") is None:
                raise SceneError(f"must be given, since {name} is a modulus per density", field=f"{path}.density")
            values[name] = value.value * values["density"]
    made: Section = kind.made(values, path)
    return made


def section_table(section: Section, path: str) -> dict[str, Any]:
    """The table of the stiffnesses of a section; what is rigid has none to tell.

    Args:
        section: Any.
        path: Where it will stand.

    Returns:
        What TOML holds.
    """
    untold = {name for strain, name in (("extension", "EA"), ("shear", "GA")) if strain in section.rigid}
    told = {name: getattr(section, name) for name in SECTION.fields if name not in untold}
    return SECTION.write(told | {"rigid": section.rigid or None}, path)
