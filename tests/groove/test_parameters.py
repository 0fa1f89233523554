"""The list of parameters: each is there, described, and says what the record itself takes."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace

import pytest

from dolfinrod.cli.listing import listing
from dolfinrod.groove import RollingCore, Scenario, parameters, varied
from dolfinrod.groove.parameters import meanings, unit_of
from dolfinrod.scene import SceneError, Section

# What a scenario settles by itself, or what may be anywhere.
BOUNDLESS = {"air.bottom", "air.between", "law.g_0"}
LISTED = parameters()


def test_every_field_of_every_part_is_listed_once():
    scenario = Scenario()
    expected = [field.name for field in fields(Scenario)]
    for name in tuple(expected):
        part = scenario.section if name == "groove" else getattr(scenario, name)
        expected += [f"{name}.{field.name}" for field in fields(part)] if is_dataclass(part) else []
    assert set(expected) <= {parameter.name for parameter in LISTED}
    assert len({(parameter.name, parameter.owner) for parameter in LISTED}) == len(LISTED)
    assert {field.name for field in fields(RollingCore)} == {p.name[5:] for p in LISTED if p.owner is RollingCore}


@pytest.mark.parametrize("parameter", LISTED, ids=lambda parameter: f"{parameter.owner.__name__}.{parameter.name}")
def test_every_parameter_has_a_meaning_a_source_and_a_range(parameter):
    assert parameter.words
    assert set(parameter.source.split(", ")) <= set("PLCI")
    assert parameter.range or parameter.name in BOUNDLESS


@pytest.mark.parametrize("parameter", [p for p in LISTED if " to " in p.range], ids=lambda p: p.name)
def test_ranges_are_those_that_are_refused_beyond(parameter):
    low, high = (float(end) for end in parameter.range.split(" to "))
    base = Scenario(core=parameter.owner()) if parameter.owner is RollingCore else Scenario()
    assert low < high
    for beyond in (low - abs(low) - 1, 2 * high + 1):
        with pytest.raises(SceneError, match=parameter.name.rpartition(".")[2]):
            varied(base, parameter.name, type(parameter.default or 0.0)(beyond))


def test_units_are_those_in_which_a_record_complains():
    units = {parameter.name: parameter.unit for parameter in LISTED}
    assert units["ends.tension"] == "N"
    assert units["groove.beta_left"] == "rad"
    assert units["air.speed"] == "m/s"
    assert units["output"] == "s"
    assert units["law.eps_N"] == "N/m²"
    assert units["wall_friction.mu"] == units["fibres"] == units["kind"] == ""


def test_sources_are_the_marks_of_the_description():
    sources = {parameter.name: parameter.source for parameter in LISTED if parameter.owner is not RollingCore}
    assert sources["bundle.length"] == "P"
    assert sources["bundle.pitch"] == "I"
    assert sources["air.speed"] == "L"
    assert sources["core"] == "P, I"
    # A law stands where the scenario says.
    assert sources["wall_friction.mu"] == "P"
    assert sources["fibre_friction.mu"] == "I"


def test_defaults_are_those_of_the_scenario_asked_about():
    told = {p.name: p.default for p in parameters(replace(Scenario(), fibres=7, core=RollingCore(fibres=40.0)))}
    assert told["fibres"] == 7
    assert told["core.fibres"] == 40.0


@dataclass(frozen=True)
class Undescribed:
    """A record whose second field nobody has described.

    Args:
        told: Length over
            two lines [m].

    Raises:
        SceneError: Never.
    """

    told: float = 1.0
    untold: float = 2.0


def test_a_field_without_a_description_has_no_meaning():
    assert meanings(Undescribed) == {"told": "Length over two lines [m]."}
    assert unit_of(Undescribed(), "told") == "m"
    assert unit_of(Undescribed(), "untold") == ""
    assert "section" not in meanings(Section)


def test_the_printed_list_has_a_row_a_parameter():
    lines = listing().splitlines()
    assert lines[0].split() == ["name", "default", "unit", "range", "source"]
    for parameter in LISTED:
        rows = [line for line in lines if line.split()[:1] == [parameter.name]]
        assert any(parameter.range in row and row.endswith(parameter.source) for row in rows)
    assert any(line.split()[:4] == ["ends.tension", "0.1", "mN", "N"] for line in lines)
