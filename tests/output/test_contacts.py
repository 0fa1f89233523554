"""What is touched is told: contacts come back to the same doubles, ParaView gets them with the surfaces themselves."""

from __future__ import annotations

import json
from dataclasses import replace
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
from dolfinrod.output.patches import patch
from dolfinrod.scene.surfaces import SURFACES
from tests.output.results import LYING, N_S, apart, flight, identical, lain, touched
from tests.scenes import poses

pytestmark = pytest.mark.serial

FIELDS = ("gap", "pressure", "traction", "slip", "state")


@settings(max_examples=10)
@given(touched())
def test_any_contacts_come_back_to_the_same_doubles(result):
    with TemporaryDirectory() as folder:
        result.write(folder)
        assert identical(dr.Result.load(folder, scene=result.scene), result)


def test_the_record_sums_up_each_contact(tmp_path):
    result = lain()
    result.write(tmp_path)
    floor, wall = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))["contacts"]
    assert (floor["surface"], floor["law"]) == ("Plane", "Penalty(eps_N=1000000.0, g_0=5e-05, damping=0.0)")
    assert (floor["friction"], wall["friction"]) == ("Coulomb(mu=0.3, eps_T=None, at='surface')", None)
    for told, contact in ((floor, result.contacts[0]), (wall, result.contacts[1])):
        np.testing.assert_array_equal(told["length"], contact.length)
        np.testing.assert_array_equal(told["force"], contact.force)
    table = np.genfromtxt(tmp_path / "contact-1-rod-1.csv", delimiter=",", names=True, deletechars="")
    np.testing.assert_array_equal(table["pressure_[N/m]"], result.contacts[1].rods[1].pressure.ravel())
    np.testing.assert_array_equal(table["normalx"], result.contacts[1].rods[1].normal[..., 0].ravel())
    assert not (tmp_path / "contact-1-rod-0.csv").exists()


def test_a_result_without_contacts_leaves_no_trace_of_any(tmp_path):
    lain().write(tmp_path)
    flight().write(tmp_path)
    assert not [path.name for path in tmp_path.iterdir() if path.name.startswith(("contact", "surface"))]
    assert "contacts" not in json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    assert not [name for name in meshio.read(tmp_path / "rods-0000.vtu").point_data if "contact" in name]
    assert dr.Result.load(tmp_path).contacts == ()


def recorded(change):
    """Damages what the record says of contacts."""

    def damage(folder: Path) -> None:
        path = folder / "result.json"
        record = json.loads(path.read_text(encoding="utf-8"))
        record["contacts"] = change(record["contacts"])
        path.write_text(json.dumps(record), encoding="utf-8")

    return damage


def tabled(change):
    """Damages the table of rod 1 on the floor, whose columns are t, s, share, …, state."""

    def damage(folder: Path) -> None:
        path = folder / "contact-0-rod-1.csv"
        header, body = path.read_text(encoding="utf-8").split("\n", 1)
        table = change(np.genfromtxt(body.splitlines(), delimiter=","))
        np.savetxt(path, table, "%.17g", ",", header=header, comments="")

    return damage


def column(i: int, row: int, value: float):
    """Puts a number into a table."""

    def change(table: np.ndarray) -> np.ndarray:
        table[row, i] = value
        return table

    return tabled(change)


def entry(**changes: object):
    """Replaces entries of the first contact in the record."""
    return recorded(lambda told: [told[0] | changes, told[1]])


def put(content: bytes):
    return lambda folder: (folder / "contact-0-rod-1.csv").write_bytes(content)


DAMAGES = {
    "no table": (lambda folder: (folder / "contact-1-rod-1.csv").unlink(), "contact-1-rod-1.csv cannot be read: No su"),
    "table empty": (put(b""), r"contact-0-rod-1.csv must begin with the line t,s \[m\],share"),
    "table foreign": (put(b"a,b\n1,2\n"), "contact-0-rod-1.csv must begin with the line .*, got 'a,b'"),
    "table binary": (put(b"\xff\xfe\x00"), "contact-0-rod-1.csv must be text in UTF-8"),
    "table with nan": (column(3, 5, np.nan), "contact-0-rod-1.csv must hold finite numbers only"),
    "other times": (column(0, 5, 0.3), "contact-0-rod-1.csv must go through the same nodes at each time"),
    "other nodes": (tabled(lambda table: table[::2]), "contact-0-rod-1.csv must "),
    "fewer nodes": (
        tabled(lambda table: table.reshape(3, N_S, -1)[:, :-1].reshape(3 * (N_S - 1), -1)),
        "contact-0-rod-1.csv must be of the 41 nodes of rod-1.csv, got 40 others",
    ),
    "shares vary": (column(2, 5, 0.3), "contact-0-rod-1.csv must have the same shares at each time"),
    "unknown state": (column(-1, 5, 3.0), "contact-0-rod-1.csv must have states 0 open, 1 sticking or 2 sliding only"),
    "half a state": (column(-1, 5, 0.5), "contact-0-rod-1.csv must have states 0 open"),
    "other pressure": (
        column(4, 2 * N_S + 20, 200.0),
        r"contacts\[0\] must have the force of the tables contact-0-rod",
    ),
    "lost contact": (recorded(lambda told: told[:1]), "result.json must have the 2 contacts of the scene, got 1"),
    "no list": (recorded(lambda told: told[0]), "another kind of value for 'contacts', got {'surface"),
    "no record of one": (recorded(lambda told: [told[0], 3]), r"contacts\[1\] must be a table, got 3"),
    "no force": (
        recorded(lambda told: [{"length": told[0]["length"]}, told[1]]),
        r"contacts\[0\] must have an entry 'f",
    ),
    "another length": (entry(length=[0.0, 0.0, 0.1]), r"contacts\[0\] must have the length of the tables contact-0"),
    "too few lengths": (entry(length=[0.0]), r"contacts\[0\] must have the length of the tables contact-0"),
    "words for lengths": (entry(length="long"), r"contacts\[0\] must have another kind of value for 'length'"),
    "ragged force": (
        entry(force=[[0.0], [], [1.0, 2.0]]),
        r"contacts\[0\] must have the force of the tables contact-0",
    ),
    "huge force": (entry(force=[[10**400, 0, 0]] * 3), r"contacts\[0\] must have the force of the tables contact-0"),
    "force not finite": (entry(force=[[np.nan] * 3] * 3), r"contacts\[0\] must have the force of the tables contact-0"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_contacts_are_answered_with_the_file_and_what_is_wrong(tmp_path, damage):
    spoil, words = DAMAGES[damage]
    lain().write(tmp_path)
    spoil(tmp_path)
    with pytest.raises(dr.SceneError, match=words) as answer:
        dr.Result.load(tmp_path, scene=LYING)
    assert "\n" not in str(answer.value)


@pytest.mark.parametrize(("name", "value"), [("length", [0.0]), ("force", [[0.0]] * 3)])
def test_a_record_of_nothing_needs_as_many_numbers_as_any(tmp_path, name, value):
    apart().write(tmp_path)
    entry(**{name: value})(tmp_path)
    with pytest.raises(dr.SceneError, match=rf"contacts\[0\] must have the {name} of the tables"):
        dr.Result.load(tmp_path, scene=LYING)


def test_contacts_of_a_scene_without_any_are_refused(tmp_path):
    lain().write(tmp_path)
    with pytest.raises(dr.SceneError, match="must have the 0 contacts of the scene, got 2"):
        dr.Result.load(tmp_path, scene=replace(LYING, contacts=()))


def test_vtu_holds_what_each_contact_does(tmp_path):
    result = lain()
    result.write(tmp_path)
    for i in range(3):
        data = meshio.read(tmp_path / f"rods-{i:04d}.vtu").point_data
        for name in FIELDS:
            both = np.concatenate([getattr(rod, name)[i] for rod in result.contacts[0].rods])
            np.testing.assert_array_equal(data[f"contact_0_{name}"], both)
            first, second = np.split(data[f"contact_1_{name}"], [N_S])
            np.testing.assert_array_equal(second, getattr(result.contacts[1].rods[1], name)[i])
            assert np.isnan(first).all() if name == "gap" else not first.any()


def test_surfaces_are_written_once_or_where_they_are_at_each_time(tmp_path):
    result = lain()
    result.write(tmp_path)
    sets = ElementTree.parse(tmp_path / "surfaces.pvd").getroot().findall("./Collection/DataSet")
    shown = [(float(entry.get("timestep")), entry.get("part"), entry.get("file")) for entry in sets]
    assert shown[2:4] == [(0.5, "0", "surface-0.vtu"), (0.5, "1", "surface-1-0001.vtu")]
    assert {file for *_, file in shown} == {path.name for path in tmp_path.glob("surface-*.vtu")}
    floor = meshio.read(tmp_path / "surface-0.vtu")
    np.testing.assert_allclose(floor.points[:, 1], -0.01, rtol=1e-15)
    places = np.concatenate([rod.r.reshape(-1, 3) for rod in result.rods])
    for axis in (0, 2):
        assert floor.points[:, axis].min() < places[:, axis].min()
        assert floor.points[:, axis].max() > places[:, axis].max()
    for i in range(3):  # pushed on by 0.1 m over the whole path
        wall = meshio.read(tmp_path / f"surface-1-{i:04d}.vtu")
        np.testing.assert_allclose(wall.points[:, 0], 0.05 * i, rtol=1e-15)
        assert wall.cell_data["contact"][0].tolist() == [1]


SECTION = [(-1.0, 0.1), (-0.3, 0.0), (0.0, -0.4), (0.3, 0.0), (1.0, 0.2)]
X, Y, ORIGIN = (1, 0, 0), (0, 1, 0), (0, 0, 0)


def grooved(kind, pose, *dimensions: float):
    return kind(SECTION, pose.placed(ORIGIN), pose.turned(X), pose.turned(Y), *dimensions)


# How each kind of surface is made somewhere in space; "wide": much larger than the rods.
MADE = {
    "Plane": {"plain": lambda kind, pose: kind(pose.placed(ORIGIN), pose.turned(X))},
    "Cylinder": {
        "outside": lambda kind, pose: kind(pose.placed(ORIGIN), pose.turned(X), 0.3),
        "inside, wide": lambda kind, pose: kind(pose.placed((0, 50, 0)), pose.turned(X), 50.0, "inside"),
    },
    "Groove": {
        "straight": grooved,
        "rounded": lambda kind, pose: grooved(kind, pose, 0.1),
        "around a roller": lambda kind, pose: grooved(kind, pose, 0.1, 1.0),
        "around a wide roller": lambda kind, pose: grooved(kind, pose, 0.1, 60.0),
    },
}
KINDS = [(kind, name) for kind in SURFACES for name in MADE[kind.__name__]]


@pytest.mark.parametrize(("kind", "name"), KINDS)
@settings(max_examples=8)
@given(pose=poses(), size=st.tuples(*[st.floats(0.0, 1.0)] * 3), seed=st.integers(0, 2**32 - 1))
def test_a_patch_lies_on_its_surface_beside_the_rods(kind, name, pose, size, seed):
    surface = MADE[kind.__name__][name](kind, pose)
    places = pose.origin + (np.random.default_rng(seed).uniform(-1, 1, (20, 3)) * np.maximum(size, 0.1)) @ pose.Q.T
    points, cells = patch(surface, np.stack([places.min(axis=0), places.max(axis=0)]))
    np.testing.assert_allclose(surface.closest(points).distance, 0.0, atol=1e-12)
    assert set(cells.ravel()) == set(range(len(points)))
    near = surface.closest(places)
    feet = places - near.distance[:, None] * near.normal
    # Chords of a circle are off it by less than a thousandth of its radius.
    assert (feet >= points.min(axis=0) - 1e-3).all()
    assert (feet <= points.max(axis=0) + 1e-3).all()


def test_summary_tells_what_each_contact_carries():
    _, tip, floor, wall, *_ = summary("continuum", lain()).splitlines()
    assert tip.startswith("  tip")
    assert floor == "  contact 0, plane: 0.4625 m in contact, force (-9.15375, 53.925, 0) N"
    assert wall == "  contact 1, plane: 0.00625 m in contact, force (0.00625, 0, 0) N"


def test_contents_of_a_scene_name_its_contacts():
    lines = [line for line in contents(LYING) if line.startswith("contacts[")]
    assert [line.split("(")[:2] for line in lines] == [[f"contacts[{i}]: Contact", "surface=Plane"] for i in (0, 1)]
    assert "friction=Coulomb(mu=0.3" in lines[0]
