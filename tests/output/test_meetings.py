"""Rods that touch rods are told: spots come back to the same doubles, ParaView and pictures show them."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dolfinrod as dr
from dolfinrod.output import contents, summary
from tests.output.results import PILED, flight, identical, meetings_of, met, piled, rows

pytestmark = pytest.mark.serial


@settings(max_examples=10)
@given(met())
def test_any_meetings_come_back_to_the_same_doubles(result):
    with TemporaryDirectory() as folder:
        result.write(folder)
        assert identical(dr.Result.load(folder, scene=result.scene), result)


@settings(max_examples=20)
@given(meetings_of((0, 1)))
def test_the_force_on_one_rod_is_opposite_to_that_on_the_other(found):
    history = dr.MeetingHistory((found,))
    np.testing.assert_array_equal(history.force(0, 0, 1), -history.force(0, 1, 0))
    np.testing.assert_array_equal(history.force(0, 0, 0), 0.0)


def turned(found: dr.Meetings) -> dr.Meetings:
    """The same with the rods of each row named the other way."""
    other = {"rod_a": found.rod_b, "s_a": found.s_b, "rod_b": found.rod_a, "s_b": found.s_a}
    return replace(found, **other, force=-found.force, normal=-found.normal, traction=-found.traction)


def test_spots_do_not_depend_on_which_rod_is_named_first():
    found = piled().meetings[0].times[-1]
    np.testing.assert_array_equal(found.spots, [0, 0, 0, 1, 1, 1])
    both = {
        field.name: np.concatenate([getattr(one, field.name) for one in (found, turned(found))])
        for field in fields(dr.Meetings)
    }
    halved = dr.Meetings(**both | {"force": 0.5 * both["force"]})
    np.testing.assert_array_equal(halved.spots, np.tile(found.spots, 2))
    once, twice = (dr.MeetingHistory((one,)) for one in (found, halved))
    assert once.n_spots(0) == twice.n_spots(0) == 2
    assert once.total(0) == pytest.approx(twice.total(0), rel=1e-14)
    np.testing.assert_allclose(once.force(0, 1, 0), twice.force(0, 1, 0), rtol=1e-14)


@settings(max_examples=20)
@given(st.permutations(range(6)))
def test_spots_are_the_same_in_any_order_of_the_rows(order):
    found = piled().meetings[0].times[-1]
    mixed = dr.Meetings(**{field.name: getattr(found, field.name)[order] for field in fields(dr.Meetings)})
    np.testing.assert_array_equal(mixed.spots, found.spots[order])


def test_where_nothing_touches_there_is_no_spot_and_no_force():
    history = dr.MeetingHistory((rows(0),))
    assert (history.n_spots(0), history.total(0)) == (0, 0.0)
    np.testing.assert_array_equal(history.force(0, 0, 1), 0.0)


def test_the_record_sums_up_each_contact_among_rods(tmp_path):
    result = piled()
    result.write(tmp_path)
    assert identical(dr.Result.load(tmp_path), result)
    record = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    both, alone = record["meetings"]
    assert (both["law"], both["friction"], both["rods"]) == (
        "Penalty(eps_N=1000000.0, g_0=5e-05, damping=0.0)",
        "Coulomb(mu=0.3, eps_T=None, at='surface')",
        None,
    )
    assert (alone["friction"], alone["rods"]) == (None, [1])
    assert (both["spots"], alone["spots"]) == ([0.0, 2.0, 2.0], [0.0] * 3)
    np.testing.assert_allclose(both["length"], [0.0, 4e-3, 4e-3], rtol=1e-14)
    assert both["force"][-1] == pytest.approx(2.0 * (np.hypot(1.0, 0.1) + np.hypot(1.0, 0.3)), rel=1e-14)
    table = np.genfromtxt(tmp_path / "meeting-0.csv", delimiter=",", names=True, deletechars="")
    np.testing.assert_array_equal(table["t"], np.repeat([0.5, 1.0], 6))
    np.testing.assert_array_equal(table["forcey_[N]"][6:], result.meetings[0].times[2].force[:, 1])
    assert {"meeting-0.csv", "meeting-1.csv", "meetings.pvd", "meetings-0002.vtu"} <= set(record["files"])


def test_a_result_without_contacts_among_rods_leaves_no_trace_of_any(tmp_path):
    piled().write(tmp_path)
    flight().write(tmp_path)
    assert not [path.name for path in tmp_path.iterdir() if path.name.startswith("meeting")]
    assert "meetings" not in json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    assert dr.Result.load(tmp_path).meetings == ()


def recorded(change):
    """Damages what the record says of contacts among rods."""

    def damage(folder: Path) -> None:
        path = folder / "result.json"
        record = json.loads(path.read_text(encoding="utf-8"))
        record["meetings"] = change(record["meetings"])
        path.write_text(json.dumps(record), encoding="utf-8")

    return damage


def column(i: int, value: float):
    """Puts a number into the second row of the first table, whose columns are t, rod a, s_a, rod b, s_b, …, state."""

    def damage(folder: Path) -> None:
        path = folder / "meeting-0.csv"
        header, body = path.read_text(encoding="utf-8").split("\n", 1)
        table = np.genfromtxt(body.splitlines(), delimiter=",")
        table[1, i] = value
        np.savetxt(path, table, "%.17g", ",", header=header, comments="")

    return damage


def entry(**changes: object):
    """Replaces entries of the first contact among rods in the record."""
    return recorded(lambda told: [told[0] | changes, told[1]])


DAMAGES = {
    "no table": (lambda folder: (folder / "meeting-1.csv").unlink(), "meeting-1.csv cannot be read: No such"),
    "table empty": (lambda folder: (folder / "meeting-0.csv").write_bytes(b""), r"meeting-0.csv must begin with the l"),
    "table with nan": (column(5, np.nan), "meeting-0.csv must hold finite numbers only"),
    "other times": (column(0, 0.75), "meeting-0.csv must go through the times of result.json, got others"),
    "times in disorder": (column(0, 1.0), "meeting-0.csv must go through the times of result.json, got others"),
    "no such rod": (column(1, 2.0), "meeting-0.csv must name rods 0, 1 only, got others"),
    "half a rod": (column(3, 0.5), "meeting-0.csv must name rods 0, 1 only, got others"),
    "before the start": (column(2, -0.1), "meeting-0.csv must have arc lengths on the rods, got some beyond"),
    "beyond the end": (column(4, 1.1), "meeting-0.csv must have arc lengths on the rods, got some beyond"),
    "unknown state": (column(-1, 3.0), "meeting-0.csv must have states 0 open, 1 sticking or 2 sliding only"),
    "other forces": (column(10, 0.1), r"meetings\[0\] must have the force of the tables meeting-0.csv, got another"),
    "record cut": (recorded(lambda told: told[:1]), "must have the 2 contacts among rods of the scene, got 1"),
    "record no list": (recorded(len), "must have another kind of value for 'meetings', got 2"),
    "entry no table": (recorded(lambda told: [told[0], 1]), r"meetings\[1\] must be a table, got 1"),
    "no length": (entry(length="1 mm"), r"meetings\[0\] must have another kind of value for 'length'"),
    "other spots": (entry(spots=[0.0, 2.0, 1.0]), r"meetings\[0\] must have the spots of the tables meeting-0.csv"),
}


@pytest.mark.parametrize("name", DAMAGES)
def test_damaged_files_are_named(name, tmp_path):
    damage, message = DAMAGES[name]
    piled().write(tmp_path)
    damage(tmp_path)
    with pytest.raises(dr.SceneError, match=message):
        dr.Result.load(tmp_path)


def test_a_contact_that_names_some_rods_has_rows_of_these_only(tmp_path):
    result = piled()
    foreign = replace(result, meetings=result.meetings[::-1])
    swapped = [PILED.contacts[3], *PILED.contacts[1:3], PILED.contacts[0]]
    replace(foreign, scene=replace(PILED, contacts=swapped)).write(tmp_path)
    with pytest.raises(dr.SceneError, match=r"meeting-1.csv must name rods 1 only, got others"):
        dr.Result.load(tmp_path, scene=PILED)


def test_paraview_gets_the_spots_as_points(tmp_path):
    result = piled()
    result.write(tmp_path)
    sets = ElementTree.parse(tmp_path / "meetings.pvd").getroot().findall("./Collection/DataSet")
    assert [(float(one.get("timestep")), one.get("file")) for one in sets] == [
        (t, f"meetings-{i:04d}.vtu") for i, t in enumerate(result.t)
    ]
    nothing = ElementTree.parse(tmp_path / "meetings-0000.vtu").getroot().find("./UnstructuredGrid/Piece")
    assert (nothing.get("NumberOfPoints"), nothing.get("NumberOfCells")) == ("0", "0")
    mesh, found = meshio.read(tmp_path / "meetings-0002.vtu"), result.meetings[0].times[2]
    np.testing.assert_array_equal(mesh.points, found.point)
    assert [(block.type, len(block.data)) for block in mesh.cells] == [("vertex", 6)]
    for name in ("force", "gap", "state", "normal", "traction", "rod_a", "s_b"):
        np.testing.assert_array_equal(mesh.point_data[name], getattr(found, name))
    np.testing.assert_array_equal(mesh.point_data["contact"], 0)


def test_summary_tells_what_each_contact_among_rods_carries():
    lines = summary("continuum", piled()).splitlines()
    floor, wall, both, alone = lines[2:6]
    assert floor.startswith("  contact 0, plane: 0.4625 m")
    assert wall.startswith("  contact 1, plane")
    forces = 2.0 * (np.hypot(1.0, 0.1) + np.hypot(1.0, 0.3))
    told = f"2 spots, 0.004 m in contact, forces of {forces:.6g} N in all, gap down to -1e-05 m"
    assert both == f"  contact 0 of rods with rods: {told}"
    assert alone == "  contact 1 of rods with rods: 0 spots, 0 m in contact, forces of 0 N in all"


def test_contents_of_a_scene_name_its_contacts_among_rods():
    lines = [line for line in contents(PILED) if line.startswith("contacts[")]
    assert [line.split("(")[0] for line in lines] == [
        f"contacts[{i}]: {name}" for i, name in enumerate(("RodContact", "Contact", "Contact", "RodContact"))
    ]


def curves(axes) -> list[np.ndarray]:
    """Ordinates of the lines over the stored times."""
    return [np.asarray(line.get_ydata()) for line in axes.lines if len(line.get_xdata()) == 3]


def among_rods_only(result: dr.Result) -> dr.Result:
    """The same without surfaces."""
    scene = replace(PILED, contacts=PILED.meetings)
    return replace(result, scene=scene, contacts=())


def test_forces_and_spots_are_drawn_over_time():
    result = among_rods_only(piled())
    figure = result.plot()
    figure.draw_without_rendering()
    assert len(figure.axes) == 1 + 3 + 2
    *_, forces, spots = figure.axes
    both, alone = result.meetings
    totals = [[meeting.total(i) for i in range(3)] for meeting in (both, alone)]
    rubbed = [[np.linalg.norm(one.traction, axis=1).sum() for one in meeting.times] for meeting in (both, alone)]
    np.testing.assert_allclose(curves(forces), [*totals, *rubbed], rtol=1e-12)
    np.testing.assert_array_equal(curves(spots), [[0, 2, 2], [0, 0, 0], [0, 1, 1], [0, 0, 0]])
    assert (forces.get_xlabel(), forces.get_ylabel()) == ("pseudo-time t [1]", "force F [N]")
    assert spots.get_ylabel() == "number of spots [1]"
    assert [text.get_text() for text in spots.get_legend().get_texts()] == ["all", "slides", "contact 0", "contact 1"]
    for axes in (forces, spots):
        assert axes.get_title()
    corners = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert (corners >= 0.0).all()
    assert (corners <= 1.0).all()


def test_spots_are_marked_on_the_shapes_in_the_end():
    result = among_rods_only(piled())
    shape = result.plot().axes[0]
    (marks,) = [line for line in shape.lines if line.get_linestyle() == "None"]
    np.testing.assert_allclose(marks.get_xdata(), result.meetings[0].times[-1].point[:, 0], rtol=1e-14)
    assert "rods touch" in [text.get_text() for text in shape.get_legend().get_texts()]


def test_rods_that_touch_nothing_are_drawn_below_what_surfaces_do():
    result = piled()
    apart = replace(result, meetings=(dr.MeetingHistory((rows(0),) * 3),) * 2)
    axes = apart.plot().axes
    assert len(axes) == 1 + 3 + 2 * 2 + 2 + 2
    assert [panel.get_ylim() for panel in axes[-2:]] == [(-1.0, 1.0)] * 2
    assert axes[-4].get_title() == "Contact forces on the rods, in space"
