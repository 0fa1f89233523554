"""What ropes hold on drums: closed forms against each other, and both models against them."""

from __future__ import annotations

from math import exp, log, pi, radians

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import simpson, solve_ivp

from dolfinrod.scene import Contact, Coulomb, PointForce, Scene, Static
from verification.contacts.ropes import STIFFNESS, TILTED, Loop, Wrap
from verification.contacts.runs import DISCRETE, PLANE, SPACE
from verification.references.capstan import (
    Drum,
    acceleration,
    euler,
    friction_of_polygon,
    heavy,
    polygon,
    thick,
)

pytestmark = pytest.mark.serial

frictions = st.floats(0.01, 2.0)
angles = st.floats(0.1, 10.0)
BOTH = pytest.mark.parametrize(("model", "elements"), [(PLANE, 8), (DISCRETE, 32)], ids=["continuum", "discrete"])


# Lia of shared/reference: Euler 1769.
@pytest.mark.parametrize(
    ("mu", "degrees", "held"), [(0.2, 180.0, 1.8744560875853384), (0.3, 540.0, 16.902024171711545)]
)
def test_rope_holds_what_the_references_say(mu, degrees, held):
    assert euler(mu, radians(degrees)) == pytest.approx(held, rel=1e-14)


# process.md 5.2.
def test_polygons_hold_what_process_md_says():
    assert polygon(0.64, 0.5 * pi, 79) == pytest.approx(2.7329, abs=5e-5)
    assert polygon(0.64, 0.5 * pi, 8) == pytest.approx(2.7453, abs=5e-5)


@given(mu=frictions, angle=angles)
def test_polygons_hold_more_by_the_square_of_their_chords(mu, angle):
    n = int(200 * (1 + mu) * angle)
    more = log(polygon(mu, angle, n)) / (mu * angle) - 1.0
    assert more == pytest.approx((1.0 + mu**2) * (angle / n) ** 2 / 12.0, rel=1e-2)
    assert friction_of_polygon(polygon(mu, angle, n), angle, n) == pytest.approx(mu, rel=1e-9)


@given(mu=frictions, angle=st.floats(0.1, 4.0))
def test_thin_rope_holds_less_by_its_thickness(mu, angle):
    assert thick(mu, angle, 0.0) == pytest.approx(euler(mu, angle), rel=1e-14)
    ε = 1e-6
    lost = 1.0 - log(thick(mu, angle, ε)) / (mu * angle)
    assert lost == pytest.approx(ε * (1.0 + mu**2), rel=1e-3)


@settings(max_examples=20)
@given(mu=frictions, hung=st.floats(0.5, 20.0))
def test_heavy_rope_obeys_the_balance_of_its_pieces(mu, hung):
    found = solve_ivp(lambda φ, T: mu * (T + np.sin(φ)) + np.cos(φ), (0.0, pi), [hung], rtol=1e-11, atol=1e-12)
    assert found.y[0, -1] == pytest.approx(heavy(mu, hung), rel=1e-8)


@settings(max_examples=20)
@given(mu=frictions, angle=angles, part=st.floats(0.05, 0.95))
def test_string_slips_as_its_tension_says(mu, angle, part):
    """The ways are those of the strains; and a loop that is closed loses what its area says."""
    string = Drum(mu, angle, radius=1.3, EA=50.0, light=2.0)
    strong = string.light * (string.limit / string.light) ** part
    φ = np.linspace(0.0, angle, 2001)
    before = np.array([string.further(string.light, x) for x in φ])
    after = np.array([string.further(strong, x) for x in φ])
    moved = simpson(after - before, x=φ) * string.radius / string.EA
    assert string.pulled(strong) - string.raised == pytest.approx(moved, rel=1e-3, abs=1e-6)
    T = np.linspace(string.light, strong, 2001)
    c = string.radius / (mu * string.EA)
    width = string.pulled(strong) - string.back(strong) - c * (np.sqrt(strong) - np.sqrt(T)) ** 2
    width -= c * (np.sqrt(T) - np.sqrt(string.light)) ** 2
    assert simpson(width, x=T) == pytest.approx(string.loss(strong), rel=1e-4, abs=1e-9)


def test_string_beyond_its_limit_is_refused():
    string = Drum(0.3, pi, 1.0, 100.0)
    with pytest.raises(ValueError, match="at most"):
        string.pulled(1.01 * string.limit)


def test_rope_runs_only_beyond_its_limit():
    held = exp(0.3 * pi)
    assert acceleration(0.3, pi, 1.0, 0.99 * held, 1.0) == 0.0
    assert acceleration(0.3, pi, 1.0, 1.01 * held, 1.0) > 0.0


@pytest.mark.parametrize("wrap", [Wrap(0.3, 180.0), Wrap(0.64, 540.0, TILTED)], ids=["level", "helix"])
def test_rope_is_posed_on_its_drum(wrap):
    closest = wrap.drum.closest(wrap.rod.centerline(np.linspace(0.0, wrap.rod.length, 50)))
    assert closest.distance - wrap.epsilon == pytest.approx(np.full(50, -1.0 / STIFFNESS), abs=1e-14)


def test_rope_slides_at_the_limit_of_euler():
    wrap = Wrap(0.3, 180.0)
    before, after = wrap.pulled(PLANE.solve(wrap.scene(), 8)) / wrap.limit
    assert after == pytest.approx(1.0, abs=1e-7)
    assert after == pytest.approx(before, abs=1e-9)


def test_discrete_rope_holds_as_much_as_a_polygon():
    wrap = Wrap(0.3, 180.0)
    held = wrap.pulled(DISCRETE.solve(wrap.scene(), 16))
    assert held == pytest.approx(np.full(2, polygon(0.3, wrap.angle, 16)), rel=1e-5)


@pytest.mark.slow
@BOTH
def test_thick_rope_holds_less(model, elements):
    thin, fat = (Wrap(0.3, 180.0, epsilon=ε) for ε in (1e-6, 1e-3))
    held = [w.pulled(model.solve(w.scene(), 2 * elements))[-1] for w in (thin, fat)]
    assert 1.0 - held[1] / held[0] == pytest.approx(1.0 - fat.limit / thin.limit, rel=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "degrees"), [(0.64, 360.0), (0.3, 540.0)])
def test_turns_beside_each_other_hold_as_much(mu, degrees):
    wrap = Wrap(mu, degrees, TILTED)
    assert wrap.pulled(SPACE.solve(wrap.scene(), 16)) / wrap.limit == pytest.approx(np.ones(2), abs=1e-6)


@pytest.mark.slow
@BOTH
def test_way_back_is_shorter(model, elements):
    loop = Loop(0.3, 180.0, 0.9)
    first, there, back, again = loop.read(model.solve(loop.scene(), 2 * elements))
    string = loop.string
    assert there - back == pytest.approx(string.pulled(loop.strong) - string.back(loop.strong), rel=1e-2)
    assert again == pytest.approx(there, rel=2e-3)
    assert back - first > 0.5 * (there - first)


def led(mu: float, order: str) -> Scene:
    """A rope under T₁ and T₂, both ends raised to T₁ first, or both to T₂."""
    loop = Loop(0.3, 180.0, 0.9)
    scene = loop.scene()
    pull, held = scene.loads
    assert isinstance(pull, PointForce)
    assert isinstance(held, PointForce)
    low = 1.0 / loop.strong
    if order == "further":
        histories = ((0.0, 0.0), (1.0, low), (2.0, 1.0)), ((0.0, 0.0), (1.0, 1.0), (2.0, 1.0))
    else:
        histories = ((0.0, 0.0), (1.0, 1.0), (2.0, 1.0)), ((0.0, 0.0), (1.0, loop.strong), (2.0, 1.0))
    loads = [PointForce(f.force, f.at, history=h) for f, h in zip((pull, held), histories, strict=True)]
    contact = scene.contacts[0]
    return Scene(
        rods=scene.rods,
        loads=loads,
        contacts=[Contact(contact.surface, contact.law, Coulomb(mu))],
        motion=Static(steps=2, t_end=2.0),
    )


@pytest.mark.slow
@BOTH
def test_order_of_loading_matters(model, elements):
    """Tension at a quarter of the way from the light end, which is node 3n/4."""
    loop, n = Loop(0.3, 180.0, 0.9), 2 * elements
    string = loop.string
    found = {}
    for order in ("further", "back"):
        h = model.solve(led(0.3, order), n).rods[0]
        found[order] = float(np.interp(0.75 * h.s[-1], h.s, h.n[-1, :, 0]))
    quarter = 0.25 * string.angle
    assert found["further"] == pytest.approx(string.further(loop.strong, quarter), rel=2e-2)
    assert found["back"] == pytest.approx(string.let_back(loop.strong, quarter), rel=2e-2)
    assert found["back"] > 1.1 * found["further"]


@BOTH
def test_ropes_to_and_fro_take_few_iterations(model, elements):
    """Zones of slip grow, stop and turn: no step goes round in circles."""
    loop = Loop(0.3, 180.0, 0.9)
    result = model.solve(loop.scene(4), elements)
    assert result.statistics.newton_iterations <= 12 * len(result.log)
