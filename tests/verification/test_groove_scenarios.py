"""Claims on bundles in the groove: judged from ensembles, never where there are too few, and shown on the page."""

from __future__ import annotations

from dataclasses import replace

import pytest

from dolfinrod.groove.scenario import MODELS
from verification import groovescenariotrials
from verification.groovepaper import as_printed
from verification.groovescenario import DAMPED, LATERAL, SEEDS, SETTINGS, GrooveEnsemble, gathered, setting
from verification.groovescenariobeside import brief, by_both, with_image
from verification.groovescenarioclaims import judged, with_claims
from verification.groovescenariosteps import NUDGE, GrooveSteps, in_shorter_steps
from verification.groovescenariotrials import ACCEPTANCE, SCENARIOS
from verification.ledger import decode, encode
from verification.plan import selected
from verification.references.friction import restitution
from verification.report import groovescenario, groovescenariopaper
from verification.report.groovekept import bundles_kept
from verification.report.groovescenariosteps import stepped
from verification.report.misses import sentence

NAMES = ("lateral", "intermediate", "mirrored", "L2", "L2-mirrored", "pinned", "still", "half-elements")


def made(name: str, n: int = SEEDS, *, about: float = 0.0, wound: float = 0.0) -> GrooveEnsemble:
    """An ensemble whose twists lie evenly within 1 turn/m of their mean."""
    spread = tuple(about + 2.0 * k / (n - 1) - 1.0 for k in range(n))
    several = tuple(wound + k % 2 for k in range(n))
    rest = {"edge": (0.0,) * n, "width": (1.02e-3,) * n, "begun": 1.02e-3, "seconds": 1.0, "failed": ()}
    return GrooveEnsemble(name, name, "discrete", n, spread, spread, several, (0.0,) * n, **rest)


def as_hoped(n: int = SEEDS) -> dict[str, GrooveEnsemble]:
    """What would make every claim hold."""
    twists = {"lateral": 3.0, "mirrored": -3.0, "half-elements": 3.2, "L2": 20.0, "L2-mirrored": -20.0}
    found = {name: made(name, n, about=twists.get(name, 0.0)) for name in NAMES}
    for name in ("lateral", "half-elements"):
        found[name] = made(name, n, about=twists[name], wound=2.0)
    found["still"] = replace(found["still"], wound=(0.0,) * n)
    return found


def test_what_is_as_hoped_holds_and_what_is_only_told_is_not_judged():
    claims = judged(tuple(as_hoped().values()))
    assert all(claim.holds for claim in claims)
    assert [claim.title[:3] for claim in claims if claim.asked] == ["(a)", "(b)", "(c)", "(d)", "(e)", "hel", "(f)"]
    assert len([claim for claim in claims if not claim.asked]) == 2


@pytest.mark.parametrize(
    ("name", "change", "title"),
    [
        ("intermediate", {"about": 5.0}, "(a)"),
        ("intermediate", {"wound": 2.0}, "(b)"),
        ("mirrored", {"about": 3.0}, "(c)"),
        ("still", {"wound": 1.0}, "(d)"),
        ("L2", {"about": 0.1}, "(e)"),
        ("L2-mirrored", {"about": 20.0}, "(e)"),
        ("half-elements", {"about": 9.0, "wound": 2.0}, "(f)"),
        ("half-elements", {"about": 3.0, "wound": 7.0}, "(f)"),
    ],
)
def test_what_does_not_come_out_is_missed(name, change, title):
    claims = judged(tuple((as_hoped() | {name: made(name, **change)}).values()))
    missed = [claim for claim in claims if not claim.holds]
    assert [claim.title[: len(title)] for claim in missed] == [title]
    assert sentence(missed[0]).startswith(f"Bundles in the groove: {title}")


def test_pairs_held_at_both_ends_that_wind_and_bundles_that_narrow_are_missed():
    found = as_hoped()
    found["pinned"] = replace(found["pinned"], most=(0.0, 1.0))
    found["still"] = replace(found["still"], width=(0.9e-3,) * SEEDS)
    assert [claim.title[:3] for claim in judged(tuple(found.values())) if not claim.holds] == ["(d)", "hel"]


def test_few_runs_tell_nothing():
    few = [made(name, 3, about=50.0) for name in ("lateral", "intermediate", "mirrored", "half-elements")]
    assert not any(claim.asked for claim in judged(few))
    assert all(claim.holds for claim in judged(few))
    assert not any("Welch" in claim.found for claim in judged(few))
    assert sum("Welch" in claim.found for claim in judged(tuple(as_hoped().values()))) == 2
    assert judged([made("lateral", 2), made("intermediate", 2)])
    assert judged([]) == ()


def test_runs_that_fail_are_told_and_the_others_count():
    broken = replace(made("lateral"), failed=("seed 3 at 0.1 ms: NotConverged",))
    assert not broken.holds
    assert "1 of 10 runs failed, seed 3 at 0.1 ms" in sentence(broken)
    assert any(claim.title.startswith("(b) fibre 5") for claim in judged([broken]))


def test_every_setting_is_another_scenario_and_can_be_asked_for():
    posed = [one.scenario for one in SETTINGS]
    assert all(a != b for k, a in enumerate(posed) for b in posed[:k])
    names = groovescenariotrials.names()
    assert len(set(names)) == len(names)
    for quick in (False, True):
        units = list(groovescenariotrials.units(names, quick=quick))
        assert len({unit.parameters for unit in units}) == len(units)
    assert len(list(groovescenariotrials.listing(names))) == len(names)


def test_markdown_holds_every_claim_its_verdict_and_the_means_it_rests_on():
    ensembles = tuple((as_hoped() | {"mirrored": made("mirrored", about=3.0)}).values())
    found = with_claims(ensembles)
    heading, claims, means = bundles_kept(found)
    assert heading.startswith("## ")
    for claim in judged(ensembles):
        sign = ("✓" if claim.holds else "✗") if claim.asked else "not judged"
        assert f"| {claim.title} | {claim.found} | {sign} |" in claims
    assert "✗" in claims
    assert "| L2 | 10 of 10 | 20.0 (19.5 to 20.5) |" in means
    assert len(means.splitlines()) == 2 + len(ensembles)
    assert bundles_kept(()) == bundles_kept(with_claims(tuple(as_hoped(SEEDS - 1).values()))) == []


@pytest.mark.serial
def test_a_blink_of_each_goes_to_the_ledger_and_onto_the_page(tmp_path):
    scenario = brief(setting("lateral").scenario)
    rows = (
        gathered(setting("intermediate").hurried(), tmp_path),
        by_both(scenario),
        with_image(scenario, "discrete"),
        as_printed("SI", "zone", "discrete", 2, air=True),
    )
    assert all(row.holds for row in rows)
    assert rows[0].crossed == (0.0, 0.0)
    assert rows[2].moved > 0.0
    assert rows[3].taken == 2
    kept = decode(encode(rows))
    assert kept == rows
    found = with_claims(kept)
    page = groovescenario.scenarios(found) + groovescenariopaper.paper(found)
    for words in ("(a) intermediate", "Ensembles", "Mirror images", "both models", "N/m², m", "2 of 2"):
        assert words in page
    assert groovescenario.scenarios(()) == groovescenariopaper.paper(()) == ""


STEPPED = GrooveSteps(
    title="two fibres",
    model="discrete",
    steps=(1e-6, 5e-7, 2.5e-7),
    t=(1e-4, 2e-4, 3e-4),
    halved=(4e-8, 1.6e-6, 8e-5),
    quartered=(2e-8, 8e-7, 6e-5),
    nudged=(1e-12, 1e-9, 1e-7),
    noise=1e-6,
    rebound=(0.3, 0.5, 0.7),
)


def test_paths_are_trusted_until_they_differ_by_the_noise_and_must_near_one_another_until_then():
    assert STEPPED.trusted == 1
    assert STEPPED.order == pytest.approx(1.0)
    assert STEPPED.holds
    for lost in (replace(STEPPED, quartered=(2e-8, 1e-6, 6e-5)), replace(STEPPED, quartered=(2e-5, 3e-5, 6e-5))):
        assert not lost.holds
        assert "0.9 asked" in sentence(lost)
    words = stepped(STEPPED)
    assert "Until 0.20 ms" in words
    assert "by 100 times as much" in words
    assert "0.50 in steps of 0.5 µs" in words
    assert "A penalty gives all of it back" in words
    assert "would leave 0.30" in stepped(replace(STEPPED, damping=0.5))


@pytest.mark.parametrize("model", MODELS)
def test_where_contact_is_damped_a_strike_gives_back_what_its_ratio_says(model):
    found = in_shorter_steps(replace(DAMPED, fibres=1, elements=4, dt=2e-7, t_end=4e-6, output=1e-6), model)
    assert found.damping == pytest.approx(1.0)
    assert found.rebound[0] < found.rebound[1] < found.rebound[2] < restitution(1.0)
    assert found.rebound[2] == pytest.approx(restitution(1.0), rel=0.06)


@pytest.mark.parametrize("model", MODELS)
def test_before_anything_is_struck_paths_near_one_another_and_a_strike_gives_back_more_in_shorter_steps(model):
    found = in_shorter_steps(replace(LATERAL, fibres=1, elements=4, dt=4e-6, t_end=4e-4), model)
    assert found.holds
    assert found.trusted == len(found.t) - 1
    assert found.nudged[-1] < 0.1 * NUDGE
    assert found.rebound[0] < found.rebound[1] < found.rebound[2] < 1.0
    assert decode(encode((found,))) == (found,)


def test_a_report_leaves_to_whole_bundles_what_few_small_ones_tell_nothing_of():
    whole, family, everything = (
        {u.parameters[1] for u in groovescenariotrials.units(asked, quick=False) if u.parameters[0] == "ensemble"}
        for asked in ((ACCEPTANCE,), (SCENARIOS,), selected(()))
    )
    assert whole == {one.name for one in SETTINGS}
    assert everything == {"lateral", "intermediate", "pinned", "still"}
    assert everything == family
    assert len(list(groovescenariotrials.units((f"{SCENARIOS}:half-steps",), quick=False))) == 1
