"""Pictures: every axis has its unit, what is drawn is the result, and nothing is cut off."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

import discrete
import dolfinrod as dr
from dolfinrod.output.scale import scale
from dolfinrod.output.view import view
from tests.output.results import LEDGER, flight, shortened
from tests.scenes import FLAT, GENERAL, SKEW, bend, cantilever, poses, rolled_up, tip_loaded

pytestmark = pytest.mark.serial

FIBRE = dr.Section.ramie()
STEPS = dr.Static(steps=5)


def micrometres() -> dr.Scene:
    return cantilever(dr.Rod.straight(20e-6, FIBRE), dr.PointForce((0, 1e-4, 0), "end"))


def two_rods() -> dr.Scene:
    rods = [dr.Rod.straight(0.04, FIBRE), dr.Rod.arc(0.02, 1.5, FIBRE, start=(0, 0.005, 0), towards=(0, 0, 1))]
    return dr.Scene(rods, [dr.Clamp("start")], [dr.PointForce((0, -1e-6, 0), "end")], motion=STEPS)


def nothing_acts() -> dr.Scene:
    return cantilever(dr.Rod.straight(1.0, GENERAL))


SCENES = {
    "elastica": (lambda: tip_loaded(GENERAL, 4.0, FLAT), ["x [m]", "y [m]"], "N", "N m"),
    "bend": (lambda: replace(bend(600.0, pose=FLAT), motion=STEPS), ["x [m]", "y [m]", "z [m]"], "kN", "kN m"),
    "two rods": (two_rods, ["x [mm]", "y [mm]", "z [mm]"], "µN", "nN m"),
    "micrometres": (micrometres, ["x [µm]", "y [µm]"], "mN", "nN m"),
    "nothing": (nothing_acts, ["x [m]", "y [m]"], "N", "N m"),
    "roll-up": (lambda: rolled_up(GENERAL, 0.5, SKEW), None, "N", "N m"),
}


def corners(figure: Figure) -> np.ndarray:
    """Corners of all that was drawn, in fractions of the figure, shape (2, 2)."""
    return figure.get_tightbbox().get_points() / figure.get_size_inches()


@pytest.mark.parametrize("name", SCENES)
def test_axes_have_units_that_fit_and_nothing_is_cut_off(tmp_path, name):
    pose, shape_labels, force, moment = SCENES[name]
    result = discrete.solve(pose(), elements=12)
    figure = result.plot(tmp_path / "result.png")
    assert (tmp_path / "result.png").stat().st_size > 20_000
    shape, n, m, path = figure.axes
    labels = [getattr(shape, f"get_{axis}label")() for axis in "xyz" if hasattr(shape, f"get_{axis}label")]
    if shape_labels is None:  # a plane askew in space is drawn along its own axes
        assert all(label.startswith("along (") for label in labels)
        assert all(label.endswith(" [m]") for label in labels)
    else:
        assert labels == shape_labels
    assert n.get_ylabel() == f"force n [{force}]"
    assert m.get_ylabel() == f"moment m [{moment}]"
    assert path.get_xlabel() == "pseudo-time t [1]"
    for axes in figure.axes:
        assert axes.get_title()
        assert axes.get_legend().get_texts()
    assert (corners(figure) >= 0.0).all()
    assert (corners(figure) <= 1.0).all()


def test_curves_are_the_arrays_of_the_result():
    result = discrete.solve(two_rods(), elements=12)
    shape, n, m, path = result.plot().axes
    for axes, values, factor in ((n, "n", 1e6), (m, "m", 1e9)):
        curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
        expected = [getattr(rod, values)[-1, :, i] for rod in result.rods for i in range(3)]
        for line, component in zip(curves, expected, strict=True):
            np.testing.assert_allclose(line.get_ydata(), factor * component, rtol=1e-12)
    moves = [line.get_ydata() for line in path.lines if len(line.get_xdata()) == len(result.t)]
    np.testing.assert_allclose(moves[:3], 1e3 * (result.rods[0].r[:, -1] - [0.04, 0, 0]).T, atol=1e-9)
    last = [line for line in shape.lines if line.get_linewidth() > 2]
    for rod, line in zip(result.rods, last, strict=True):
        drawn = np.array(line.get_data_3d()).T / 1e3
        np.testing.assert_allclose(drawn[[0, -1]], rod.r[-1, [0, -1]], atol=1e-15)


@pytest.mark.parametrize("spatial", [False, True])
def test_a_length_is_drawn_equally_long_in_every_direction(spatial):
    result = discrete.solve(bend(600.0) if spatial else tip_loaded(GENERAL, 4.0, FLAT), elements=8)
    shape = result.plot().axes[0]
    if spatial:
        limits = np.array([shape.get_xlim(), shape.get_ylim(), shape.get_zlim()])
        per_metre = shape._box_aspect / np.diff(limits, axis=1)[:, 0]
        np.testing.assert_allclose(per_metre, per_metre[0], rtol=1e-12)
    else:
        assert shape.get_aspect() == 1.0


def test_round_off_is_drawn_as_zero():
    # Pure bending: there is a moment, and no force but of round-off.
    result = discrete.solve(rolled_up(GENERAL, 0.5, SKEW), elements=8)
    n = result.plot().axes[1]
    assert n.get_ylim() == (-1.0, 1.0)
    assert all(not np.any(line.get_ydata()) for line in n.lines)


def test_a_motion_is_drawn_over_seconds_with_its_ledger(tmp_path):
    result = flight()
    figure = result.plot(tmp_path / "result.png")
    *_, path, ledger = figure.axes
    assert [axes.get_xlabel() for axes in (path, ledger)] == ["time t [s]"] * 2
    assert ledger.get_ylabel() == "energy E [mJ]"
    drawn = {line.get_label(): line.get_ydata() for line in ledger.lines if len(line.get_xdata()) == len(result.t)}
    assert list(drawn) == list(LEDGER[:-1])  # no loss of the time stepping, no line
    for name, values in drawn.items():
        np.testing.assert_allclose(values, 1e3 * (result.energy[name] - result.energy[name][0]), rtol=1e-12)
    assert "17 stored states from t = 0 to 2 s" in figure._suptitle.get_text()
    assert (corners(figure) >= 0.0).all()
    assert (corners(figure) <= 1.0).all()


def test_a_ledger_on_which_nothing_happens_is_drawn():
    result = flight()
    still = replace(result, energy={name: np.ones_like(result.t) for name in LEDGER})
    ledger = still.plot().axes[-1]
    assert ledger.get_ylim() == (-1.0, 1.0)


def test_one_state_many_states_and_many_rods_are_drawn():
    result = discrete.solve(two_rods(), elements=6)
    assert "the state at t = 1" in shortened(result, slice(-1, None)).plot()._suptitle.get_text()
    crowd = replace(two_rods(), rods=[dr.Rod.straight(0.04, FIBRE, start=(0, 0.01 * k, 0)) for k in range(9)])
    shape, n, *_ = discrete.solve(replace(crowd, motion=dr.Static(steps=30)), elements=6).plot().axes
    assert len(shape.lines) == 9 * (1 + 12)  # stress free, and a dozen of thirty-one states
    assert len(n.get_legend().get_texts()) == 3 + 4
    failed = replace(result, converged=False)
    assert "not converged beyond" in failed.plot()._suptitle.get_text()


@given(st.floats(1e-12, 1e10), st.sampled_from(["N", "N m", "m"]))
def test_a_scaled_number_is_short(largest, unit):
    drawn = scale(largest, unit)
    assert drawn.unit.endswith(unit)
    if unit != "m" or largest < 100.0:
        assert 0.0999 < largest * drawn.factor < 100.001


def test_lengths_stay_in_metres_and_zero_has_the_plain_unit():
    assert scale(12_000.0, "m").unit == "m"
    assert scale(0.0, "N").unit == "N"


@given(poses())
def test_a_plane_is_looked_at_straight_and_its_lengths_kept(pose):
    flat = np.array([[0, 0, 0], [1, 0.2, 0], [2, -1, 0], [0.5, 3, 0]], dtype=float)
    points = pose.origin + flat @ pose.Q.T
    seen = view(points)
    assert len(seen.axes) == 2
    np.testing.assert_allclose(seen.axes @ seen.axes.T, np.eye(2), atol=1e-12)
    np.testing.assert_allclose(
        np.linalg.norm(np.diff(seen.seen(points).T, axis=0), axis=1),
        np.linalg.norm(np.diff(flat, axis=0), axis=1),
        rtol=1e-5,
    )
    beyond = np.vstack([points, pose.origin + pose.Q[:, 2]])
    assert len(view(beyond).axes) == 3


@pytest.mark.parametrize("heavy", ["matplotlib", "meshio", "h5py"])
def test_a_solver_that_writes_nothing_loads_neither_plotting_nor_meshes(heavy):
    code = "import dolfinrod, dolfinrod.output, discrete, sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert heavy not in done.stdout.split()
