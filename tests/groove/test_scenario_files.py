"""Scenario files: they hold every parameter with its unit and its meaning, and give the same scenario back."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dolfinrod.groove import (
    VARIANTS,
    Bundle,
    CrossSection,
    Ends,
    FixedCore,
    LineSink,
    RollingCore,
    Scenario,
    parameters,
    toml,
    variant,
)
from dolfinrod.groove.tables import Measure
from dolfinrod.scene import Coulomb, CreepingCoulomb, Penalty, SceneError, Section, SmoothPenalty

EXAMPLES = Path(__file__).parents[2] / "demos" / "groove"
few = settings(max_examples=12)
lengths = st.floats(1e-5, 1e-3)
scenarios = st.builds(
    Scenario,
    kind=st.sampled_from(["lateral", "intermediate"]),
    fibres=st.integers(1, 200),
    seed=st.integers(0, 2**32 - 1),
    groove=st.none() | st.builds(CrossSection, beta_left=st.floats(0.1, 1.0), fillet=st.just(0.0)),
    bundle=st.builds(
        Bundle,
        pitch=lengths,
        offset=st.none() | lengths,
        section=st.just(Section.circle(diameter=2e-5, E=3e10, G=1e9, density=1540.0)),
    ),
    ends=st.builds(Ends, tension=st.floats(0.0, 0.1), exit=st.sampled_from(["free", "held"]), leading=st.just((1,))),
    core=st.none()
    | st.builds(FixedCore, radius=st.floats(1e-5, 1e-4))
    | st.builds(RollingCore, start=st.none() | lengths),
    air=st.none() | st.builds(LineSink, speed=st.floats(0.0, 200.0), between=st.just((0.0, 0.03))),
    law=st.just(SmoothPenalty(4e5, 1e-7, 1e-6)) | st.builds(Penalty, st.floats(1.0, 1e9), st.floats(0.0, 1e-4)),
    wall_friction=st.none() | st.builds(Coulomb, st.floats(0.0, 1.0), eps_T=st.none() | st.floats(1.0, 1e9)),
    fibre_friction=st.none() | st.builds(CreepingCoulomb, st.floats(0.0, 1.0), st.floats(1e-6, 1.0)),
    mirrored=st.booleans(),
    t_end=st.floats(1e-6, 10.0),
)


@few
@given(scenarios)
def test_a_scenario_is_that_of_its_file(scenario):
    assert toml.loads(toml.dumps(scenario)) == scenario


@pytest.mark.parametrize("name", VARIANTS)
def test_so_is_every_variant(name):
    scenario = variant(Scenario(), name)
    assert toml.loads(toml.dumps(scenario)) == scenario


def test_so_is_what_the_paper_prints():
    scenario = Scenario.paper("mm_N", "long")
    assert toml.loads(toml.dumps(scenario)) == scenario


@pytest.mark.parametrize("kind", ["lateral", "intermediate"])
def test_the_shipped_example_is_the_default_with_every_parameter(kind):
    """Renewed by `dolfinrod groove KIND --toml > demos/groove/KIND.toml`."""
    text = (EXAMPLES / f"{kind}.toml").read_text(encoding="utf-8")
    default = Scenario(kind)
    assert text == toml.dumps(default)
    assert toml.load(EXAMPLES / f"{kind}.toml") == default
    assigned = set(re.findall(r"^(?:# )?(\w+) = ", text, re.MULTILINE))
    shown = {type(default.core), *(type(getattr(default, name)) for name in default.__dataclass_fields__)}
    for parameter in parameters(default):
        leaf = parameter.name.rpartition(".")[2]
        if parameter.owner in shown and parameter.default is not None and not hasattr(parameter.default, "__module__"):
            assert leaf in assigned or leaf == "bottom", parameter.name


@pytest.mark.parametrize("kind", ["lateral", "intermediate", "lateral_steep"])
def test_what_is_a_comment_is_what_would_be_there_anyway(kind):
    text = toml.dumps(Scenario(kind))
    given = re.sub(r"^# (\[|\w+ = )", r"\1", text, flags=re.MULTILINE)
    assert toml.loads(given).section == Scenario(kind).section
    assert toml.loads(given).groove is not None


def test_what_is_left_out_has_its_default():
    assert toml.loads("") == Scenario()
    assert toml.loads('kind = "intermediate"\nends.tension = "0.2 mN"') == replace(
        Scenario("intermediate"), ends=Ends(tension=2e-4)
    )


def test_none_is_a_word_and_a_section_may_have_a_shape():
    found = toml.loads(
        """
        core = "none"
        air = "none"
        fibre_friction = "none"
        law = "paper"
        [groove]
        beta_left = "30 deg"
        [bundle.section.circle]
        diameter = "20 um"
        E = "2224.6 cN/tex"
        G = "106.2 cN/tex"
        density = "1.54 g/cm**3"
        """
    )
    assert found == Scenario(
        core=None,
        air=None,
        fibre_friction=None,
        law=Penalty.paper(),
        groove=CrossSection(beta_left=0.5235987755982988),
        bundle=Bundle(section=Section.ramie()),
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("fibers = 5", "fibers is unknown; known are kind, .*; did you mean fibres"),
        ("ends.tension = '1 mm'", "ends.tension must be a quantity in N, got '1 mm'"),
        ("ends.tension = '1 N'", "ends.tension must lie between 0 and 0.1 N, got 1.0 N"),
        ("fibres = 0", "fibres must be a whole number from 1 to 200, got 0"),
        ("core.fixed = {}", "core.fixed is unknown; known are fixed_core, rolling_core"),
        ("core = 1", "core must be a table, got 1"),
        ("[air]\nbottom = [0, 0]", "air.bottom is unknown"),
        ("[law.penalty]\ng_0 = 0", "law.penalty.eps_N is missing"),
        ("kind = ", "must be a TOML file"),
        ("a." * 40 + "b = 1", "must not nest tables so deeply"),
        ("bundle.section.circle = { diameter = 2e-5 }", r"bundle.section.circle.E is missing"),
    ],
)
def test_a_file_that_cannot_be_meant_is_refused_in_words(text, words):
    with pytest.raises(SceneError, match=words) as refused:
        toml.loads(text)
    assert not str(refused.value).startswith(".")


@few
@given(st.floats(allow_nan=False), st.sampled_from(["m", "s", "N", "rad", "m/s"]))
def test_a_measure_is_written_to_the_last_digit(value, unit):
    measure = Measure(unit)
    assert measure.read(measure.write(value, ""), "") == value


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (2.5e-4, "m", "250 um"),
        (0.04, "m", "40 mm"),
        (1e-6, "s", "1 us"),
        (1e-4, "N", "0.1 mN"),
        (20.0, "m/s", "20 m/s"),
    ],
)
def test_a_measure_is_written_as_a_person_would(value, unit, text):
    assert Measure(unit).write(value, "") == text
