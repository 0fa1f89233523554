"""Pictures of contact: what is drawn is what was felt, on labelled axes, beside the surfaces that were touched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

import dolfinrod as dr
from dolfinrod.output.contactpanels import CAPTION, ZONES
from dolfinrod.output.ledger import LINES
from tests.output.results import LYING, MU, N_S, apart, flight, lain

pytestmark = pytest.mark.serial

TOUCHING_LEDGER = ("contact", "friction", "wall work")


@pytest.fixture(scope="module")
def figure() -> Figure:
    return lain().plot()


def curves(axes, n: int) -> list[np.ndarray]:
    """Ordinates of the lines of n points."""
    return [np.asarray(line.get_ydata()) for line in axes.lines if len(line.get_xdata()) == n]


def with_floor(result: dr.Result, surface: dr.Plane) -> dr.Result:
    """The same beside another floor."""
    floor, wall = result.scene.contacts
    return replace(result, scene=replace(result.scene, contacts=[replace(floor, surface=surface), wall]))


def test_every_panel_is_labelled_and_nothing_is_cut_off(figure):
    figure.draw_without_rendering()
    assert len(figure.axes) == 1 + 3 + 2 * 2 + 2
    *_, loads, gaps, _, _, forces, lengths = figure.axes
    assert (loads.get_xlabel(), loads.get_ylabel()) == ("arc length s [m]", "line load [kN/m]")
    assert (gaps.get_xlabel(), gaps.get_ylabel()) == ("arc length s [m]", "gap g [mm]")
    assert (forces.get_xlabel(), forces.get_ylabel()) == ("pseudo-time t [1]", "force F [N]")
    assert (lengths.get_xlabel(), lengths.get_ylabel()) == ("pseudo-time t [1]", "length in contact [m]")
    assert loads.get_title() == "Contact 0, plane: loads along the rods, t = 1"
    for axes in figure.axes:
        assert axes.get_title()
        assert axes.get_legend().get_texts()
    assert CAPTION in figure._suptitle.get_text()
    corners = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert (corners >= 0.0).all()
    assert (corners <= 1.0).all()


def test_curves_are_what_the_rods_felt(figure):
    result = lain()
    *_, loads, gaps, _, _, forces, lengths = figure.axes
    drawn = iter(curves(loads, N_S))
    for rod in result.contacts[0].rods:
        expected = (rod.pressure[-1], MU * rod.pressure[-1], np.abs(rod.traction[-1, :, 0]))
        for values in expected:
            np.testing.assert_allclose(next(drawn), 1e-3 * values, rtol=1e-12)
    for rod, values in zip(result.contacts[0].rods, curves(gaps, N_S), strict=True):
        np.testing.assert_allclose(values, 1e3 * rod.gap[-1], rtol=1e-12)
    expected = np.concatenate([contact.force.T for contact in result.contacts])
    np.testing.assert_allclose(curves(forces, 3), expected, rtol=1e-12)
    np.testing.assert_allclose(curves(lengths, 3), [contact.length for contact in result.contacts], rtol=1e-12)


def test_zones_end_half_way_between_neighbours_of_different_state(figure):
    result, loads = lain(), figure.axes[-6]
    shaded = [(patch.get_facecolor()[:3], patch.get_xy()[:, 0]) for patch in loads.patches]
    for rod in result.contacts[0].rods:
        for state, (_, color) in ZONES.items():
            inside = sum(
                ((x.min() < rod.s) & (rod.s < x.max())).astype(int)
                for found, x in shaded[: len(shaded) // 2]
                if found == to_rgba(color)[:3]
            )
            np.testing.assert_array_equal(inside, rod.state[-1] == state)
        shaded = shaded[len(shaded) // 2 :] + shaded[: len(shaded) // 2]
    names = [text.get_text() for text in loads.get_legend().get_texts()]
    assert names[3:] == ["sticks", "slides", "rod 0", "rod 1"]


def test_gaps_much_larger_than_what_presses_are_drawn_logarithmically():
    result = lain()
    (first, second), wall = result.contacts[0].rods, result.contacts[1]
    far = dr.ContactHistory((replace(first, gap=first.gap + 1e3 * (first.pressure == 0.0)), second))
    gaps = replace(result, contacts=(far, wall)).plot().axes[-5]
    assert gaps.get_yscale() == "symlog"
    assert gaps.get_ylabel() == "gap g [mm]\n(logarithmic far off)"


def test_rods_that_touch_nothing_are_drawn():
    *_, loads, _, _, _, forces, lengths = apart().plot().axes
    assert [axes.get_ylim() for axes in (loads, forces, lengths)] == [(-1.0, 1.0)] * 3
    assert not loads.patches


def test_more_contacts_than_fit_are_summed_up_only():
    result = lain()
    many = replace(result, scene=replace(LYING, contacts=LYING.contacts[:1] * 9), contacts=result.contacts[:1] * 9)
    figure = many.plot()
    assert len(figure.axes) == 1 + 3 + 4 * 2 + 2
    assert len(curves(figure.axes[-1], 3)) == 9


def outlines(axes) -> list[np.ndarray]:
    """Lines along which surfaces were cut."""
    return [path.vertices for found in axes.collections for path in found.get_paths() if not len(found.get_facecolor())]


def test_surfaces_are_cut_where_they_are_in_the_end(figure):
    shape = figure.axes[0]
    floor, wall = outlines(shape)
    np.testing.assert_allclose(floor[:, 1], -0.01, atol=1e-9)
    np.testing.assert_allclose(wall[:, 0], 0.1, atol=1e-9)  # its velocity times t = 1
    assert "surface" in [text.get_text() for text in shape.get_legend().get_texts()]


def test_a_surface_that_does_not_cut_the_plane_in_view_is_left_out():
    below = dr.Plane((0.0, 0.0, -0.01), (0, 0, 1))
    shape = with_floor(lain(), below).plot().axes[0]
    assert len(outlines(shape)) == 1


def test_surfaces_in_space_are_pale_pieces():
    result = lain()
    sag = np.linspace(0.0, 0.3, N_S) ** 2
    first = replace(result.rods[0], r=result.rods[0].r + sag[:, None] * np.array([0.0, 0.0, 1.0]))
    shape = replace(result, rods=(first, result.rods[1])).plot().axes[0]
    assert shape.name == "3d"
    assert len(shape.collections) == 2
    assert "surface" in [text.get_text() for text in shape.get_legend().get_texts()]


def test_energies_of_contact_have_names_and_colours_of_their_own():
    result = flight()
    more = {name: 1e-3 * (i + 1) * result.t**2 for i, name in enumerate(TOUCHING_LEDGER)}
    ledger = replace(result, energy=result.energy | more).plot().axes[-1]
    drawn = {line.get_label(): line for line in ledger.lines}
    assert {name: drawn[name].get_linestyle() for name in more} == {"contact": "-", "friction": "--", "wall work": "--"}
    colors = [color for color, _ in LINES.values()]
    assert len(set(colors)) == len(colors)
