"""What is written is the result: every file holds its doubles, and reading back gives the same record."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from hypothesis import given, settings

import discrete
import dolfinrod as dr
from dolfinrod.scene import toml
from tests.conftest import world
from tests.output.results import SCENE, flight, identical, results, shortened
from tests.scenes import GENERAL, cantilever

TWO_STEPS = replace(SCENE, motion=dr.Static(steps=2))
SOLVERS = {
    "continuum": lambda scene, **options: dr.solve(scene, elements=3, degree=2, **options),
    "discrete": lambda scene, **options: discrete.solve(scene, elements=4, **options),
}
both_models = pytest.mark.parametrize("model", SOLVERS)


@pytest.fixture(scope="module")
def solved() -> dr.Result:
    return discrete.solve(TWO_STEPS, elements=4)


@pytest.mark.serial
@settings(max_examples=15)
@given(results())
def test_any_result_comes_back_to_the_same_doubles(result):
    with TemporaryDirectory() as folder:
        result.write(folder)
        assert identical(dr.Result.load(Path(folder)), result)


@both_models
def test_every_rank_may_write_and_a_loaded_result_goes_on_like_the_result_itself(shared_path, model):
    solve = SOLVERS[model]
    result = solve(TWO_STEPS)
    result.write(shared_path / "out")
    loaded = dr.Result.load(shared_path / "out")
    assert identical(replace(loaded, statistics=result.statistics), result)
    assert [path for path in (shared_path / "out").iterdir() if path.name in ("result.json", "rod-0.csv")]
    further = replace(TWO_STEPS, loads=[dr.PointForce((0.0, -0.5, 0.3), "end")], motion=dr.Static(steps=1))
    ends = [solve(further, start=start) for start in (result, loaded)]
    assert identical(ends[0].rods, ends[1].rods)
    assert ends[0].log == ends[1].log
    comm = world()
    if comm is not None:
        comm.barrier()  # nobody leaves while another rank still reads


@pytest.mark.serial
def test_vtu_series_holds_the_arrays_of_all_rods(tmp_path, solved):
    solved.write(tmp_path)
    sets = ElementTree.parse(tmp_path / "rods.pvd").getroot().findall("./Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in sets] == solved.t.tolist()
    for i, entry in enumerate(sets):
        mesh = meshio.read(tmp_path / entry.get("file"))
        n_s = [len(rod.s) for rod in solved.rods]
        np.testing.assert_array_equal(mesh.points, np.concatenate([rod.r[i] for rod in solved.rods]))
        expected = {name: [getattr(rod, name)[i] for rod in solved.rods] for name in ("gamma", "kappa", "n", "m")}
        expected |= {f"d{k + 1}": [rod.frames[i, :, :, k] for rod in solved.rods] for k in range(3)}
        expected |= {"s": [rod.s for rod in solved.rods]}
        for name, parts in expected.items():
            np.testing.assert_array_equal(mesh.point_data[name], np.concatenate(parts))
        (block,) = mesh.cells
        assert block.type == "line"
        rods = mesh.cell_data["rod"][0]
        assert np.bincount(rods).tolist() == [n - 1 for n in n_s]
        np.testing.assert_array_equal(np.diff(block.data, axis=1), 1)
        assert (block.data[rods == 1] >= n_s[0]).all()


@pytest.mark.serial
def test_velocities_are_written_where_there_are_any(tmp_path, solved):
    moving = flight()
    moving.write(tmp_path / "moving")
    assert identical(dr.Result.load(tmp_path / "moving"), moving)
    for i in (0, 9):
        data = meshio.read(tmp_path / "moving" / f"rods-{i:04d}.vtu").point_data
        np.testing.assert_array_equal(data["v"], moving.rods[0].v[i])
        np.testing.assert_array_equal(data["omega"], moving.rods[0].omega[i])
    table = np.genfromtxt(tmp_path / "moving" / "rod-0.csv", delimiter=",", names=True, deletechars="")
    np.testing.assert_array_equal(table["vy_[m/s]"], moving.rods[0].v[..., 1].ravel())
    np.testing.assert_array_equal(table["omegaz_[rad/s]"], 3.0)
    solved.write(tmp_path / "resting")
    assert not {"v", "omega"} & meshio.read(tmp_path / "resting" / "rods-0001.vtu").point_data.keys()
    loaded = dr.Result.load(tmp_path / "resting")
    assert all(rod.v is None and rod.omega is None for rod in loaded.rods)


@pytest.mark.serial
@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (",vx [m/s]", ",ux [m/s]", r"must begin with the line t,s \[m\]"),
        (",omegaz [rad/s]", "", r"must begin with the line t,s \[m\].*omegaz \[rad/s\], got 't,s"),
        (",vx [m/s],vy [m/s],vz [m/s]", "", "must have 29 columns, got 32"),
    ],
)
def test_a_damaged_table_of_velocities_is_answered(tmp_path, old, new, words):
    flight().write(tmp_path)
    text("rod-0.csv", old, new)(tmp_path)
    with pytest.raises(dr.SceneError, match=words):
        dr.Result.load(tmp_path)


@pytest.mark.serial
def test_forces_and_displacements_for_paraview_are_in_space(tmp_path):
    # The tip transmits the dead force that pulls it, whatever way its section has turned.
    force = (0.2, -0.7, 0.4)
    result = discrete.solve(cantilever(dr.Rod.straight(1.0, GENERAL), dr.PointForce(force, "end")), elements=6)
    result.write(tmp_path)
    mesh = meshio.read(tmp_path / "rods-0001.vtu")
    np.testing.assert_allclose(mesh.point_data["force"][-1], force, atol=1e-9)
    np.testing.assert_allclose(mesh.point_data["moment"][-1], 0.0, atol=1e-9)
    np.testing.assert_allclose(mesh.point_data["displacement"][-1], result.tip - [1.0, 0.0, 0.0], atol=1e-14)
    np.testing.assert_array_equal(mesh.point_data["displacement"][0], 0.0)


@pytest.mark.serial
def test_scene_is_a_scene_file_and_versions_are_told(tmp_path, solved):
    solved.write(str(tmp_path / "deep" / "out"))
    assert toml.load(tmp_path / "deep" / "out" / "scene.toml")[0] == solved.scene
    record = json.loads((tmp_path / "deep" / "out" / "result.json").read_text(encoding="utf-8"))
    assert {"dolfinrod", "numpy", "python", "meshio"} <= record["versions"].keys()


@pytest.mark.serial
def test_a_shorter_result_takes_the_place_of_a_longer_one_and_leaves_what_is_not_ours(tmp_path, solved):
    alone = tmp_path / "alone"
    one_rod = discrete.solve(replace(SCENE, rods=SCENE.rods[:1]), elements=4)
    one_rod.write(alone)
    for name in ("notes.txt", "rods-0007.vtu", "rod-9.csv"):
        (tmp_path / name).write_text("mine", encoding="utf-8")
    solved.write(tmp_path)
    one_rod.write(tmp_path)
    left = {path.name for path in tmp_path.iterdir()} - {"alone"}
    assert left == {path.name for path in alone.iterdir()} | {"notes.txt", "rods-0007.vtu", "rod-9.csv"}
    assert identical(dr.Result.load(tmp_path), one_rod)


@pytest.mark.serial
def test_a_record_that_names_strange_files_has_none_of_them_removed(tmp_path, solved):
    (tmp_path / "precious.txt").write_text("mine", encoding="utf-8")
    outside = tmp_path / "out"
    outside.mkdir()
    named = ["../precious.txt", "/etc/hostname", 7, "rods-../x.vtu"]
    for text in (json.dumps({"files": named}), "[" * 99999, "{", "[]", '{"files": 3}'):
        (outside / "result.json").write_text(text, encoding="utf-8")
        solved.write(outside)
    assert (tmp_path / "precious.txt").exists()
    assert identical(dr.Result.load(outside), solved)


@pytest.mark.serial
def test_writing_that_fails_leaves_the_earlier_result(tmp_path, solved):
    solved.write(tmp_path)
    broken = replace(solved, rods=(solved.rods[0], replace(solved.rods[1], n=np.zeros((1, 1, 3)))))
    with pytest.raises(ValueError, match="dimension"):
        broken.write(tmp_path)
    assert identical(dr.Result.load(tmp_path), solved)
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


@pytest.mark.serial
def test_a_scene_with_a_function_is_told_of_and_may_be_handed_in(tmp_path, solved):
    solved.write(tmp_path)
    growing = cantilever(SCENE.rods[0], dr.PointForce((0, 1, 0), "end", history=lambda t: t**2))
    result = discrete.solve(growing, elements=4)
    result.write(tmp_path)
    assert not (tmp_path / "scene.toml").exists()
    with pytest.raises(dr.SceneError, match=r"holds no scene \(loads\[0\].*function.*load the result with scene="):
        dr.Result.load(tmp_path)
    assert identical(dr.Result.load(tmp_path, scene=growing), result)


def json_with(**changes: object):
    """Damages the record: entries replaced, or taken out where None."""

    def damage(folder: Path) -> None:
        path = folder / "result.json"
        record = json.loads(path.read_text(encoding="utf-8")) | changes
        path.write_text(json.dumps({k: v for k, v in record.items() if v is not None}), encoding="utf-8")

    return damage


def text(name: str, old: str, new: str):
    """Damages a file of text."""

    def damage(folder: Path) -> None:
        content = (folder / name).read_text(encoding="utf-8")
        assert old in content
        (folder / name).write_text(content.replace(old, new, 1), encoding="utf-8")

    return damage


def put(name: str, content: bytes):
    """Puts something else in the place of a file."""
    return lambda folder: (folder / name).write_bytes(content)


def cut(name: str):
    """Cuts a file in two."""
    return lambda folder: (folder / name).write_bytes(
        (folder / name).read_bytes()[: (folder / name).stat().st_size // 2]
    )


def gone(name: str):
    return lambda folder: (folder / name).unlink()


def arrays(save=np.savez, **named: np.ndarray):
    """Puts a file of other arrays in the place of the state."""
    return lambda folder: save(folder / "state.npz", **named)


def other_run(folder: Path) -> None:
    """The table of a run with a little more load."""
    scene = replace(TWO_STEPS, loads=[dr.PointForce((0.1, -0.71, 0.3), "end")])
    discrete.solve(scene, elements=4).write(folder / "other")
    shutil.copy(folder / "other" / "rod-0.csv", folder / "rod-0.csv")


STATISTICS = {"dofs": 1, "load_steps": 1, "newton_iterations": 1, "factorizations": 1}
DAMAGES = {
    "no folder": (lambda folder: shutil.rmtree(folder), "result.json cannot be read: No such file"),
    "no record": (gone("result.json"), "result.json cannot be read: No such file"),
    "no table": (gone("rod-1.csv"), "rod-1.csv cannot be read: No such file"),
    "no state": (gone("state.npz"), "state.npz cannot be read: No such file"),
    "no scene": (gone("scene.toml"), "scene.toml cannot be read: No such file"),
    "record cut": (cut("result.json"), "result.json must be JSON: "),
    "record binary": (put("result.json", b"\xff\x00\x80"), "result.json must be JSON: "),
    "record endless": (put("result.json", b"[" * 99999), "result.json must be JSON: "),
    "record foreign": (put("result.json", b'{"a": 1}'), "result.json must be the record of a result"),
    "record a list": (put("result.json", b"[1]"), "result.json must be the record of a result"),
    "later format": (
        json_with(format="dolfinrod result 9"),
        "of format 'dolfinrod result 1', got 'dolfinrod result 9'",
    ),
    "entry missing": (json_with(converged=None), "result.json must have an entry 'converged', got none"),
    "wrong kind": (json_with(converged=1), "another kind of value for 'converged', got 1"),
    "times descend": (json_with(t=[0.0, 0.0, 1.0]), "ascending times for 't'"),
    "no times": (json_with(t=[]), "ascending times for 't'"),
    "huge time": (json_with(t=[10**400]), "must have doubles for 't'"),
    "other times": (json_with(t=[0.0, 0.4, 1.0]), "rod-0.csv must go through the same nodes at each time"),
    "too many times": (json_with(t=[0.0, 0.1, 0.2, 0.3]), "as many rows for each of 4 times, got 15 rows"),
    "energy short": (json_with(energy={"strain": [1.0]}), "an energy 'strain' for each of 3 times, got 1"),
    "log no table": (json_with(log=[3]), r"log\[0\] must have the entries t, iterations"),
    "log unknown": (json_with(log=[{"x": 1}]), r"log\[0\] must have the entries t, iterations"),
    "log incomplete": (json_with(log=[{"t": 1.0}]), r"log\[0\] must have an entry 'iterations'"),
    "statistics text": (json_with(statistics=STATISTICS | {"dofs": "9"}), "statistics must have another kind of value"),
    "other tip": (other_run, "result.json must belong to rod-0.csv, got the tip of another result"),
    "table empty": (put("rod-0.csv", b""), "rod-0.csv must begin with the line t,s"),
    "table foreign": (put("rod-0.csv", b"a,b\n1,2\n"), "must begin with the line t,s .*, got 'a,b'"),
    "table binary": (put("rod-0.csv", b"\xff\xfe\x00"), "rod-0.csv must be text in UTF-8"),
    "table cut": (cut("rod-0.csv"), "rod-0.csv must "),
    "table of words": (text("rod-0.csv", "\n0,", "\nzero,"), "rod-0.csv must be a table of numbers: .*zero"),
    "table with nan": (text("rod-0.csv", "\n0,0,0,", "\n0,0,nan,"), "rod-0.csv must hold finite numbers only"),
    "other scene": (
        text("scene.toml", '"1.0 m"', '"1.1 m"'),
        "rod-0.csv must end at the length of rod 0 .*1.1 m, got 1.0 m",
    ),
    "scene damaged": (text("scene.toml", "[", "[["), "scene.toml: a scene must be a TOML file"),
    "state cut": (cut("state.npz"), "state.npz must be a file of arrays"),
    "state foreign": (put("state.npz", b"\x93NUMPY"), "state.npz must be a file of arrays"),
    "state of objects": (arrays(x=np.array([{}], dtype=object)), "state.npz must be a file of arrays .*[Oo]bject"),
    "state of integers": (arrays(x=np.arange(3)), "state.npz must hold finite doubles only, got others in x"),
    "state not finite": (arrays(x=np.array([np.nan])), "state.npz must hold finite doubles only, got others in x"),
    "state packed": (arrays(np.savez_compressed, x=np.zeros(9)), "state.npz must hold plain arrays only, got x"),
}


@pytest.mark.serial
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_folder_is_answered_with_the_file_and_what_is_wrong(tmp_path, solved, damage):
    spoil, words = DAMAGES[damage]
    solved.write(tmp_path / "out")
    spoil(tmp_path / "out")
    with pytest.raises(dr.SceneError, match=words) as answer:
        dr.Result.load(tmp_path / "out")
    assert "\n" not in str(answer.value)


@pytest.mark.serial
def test_no_cut_of_any_file_goes_unnoticed_or_unanswered(tmp_path, solved):
    shortened(solved, slice(-1, None)).write(tmp_path)
    for name in ("result.json", "rod-0.csv", "state.npz"):
        whole = (tmp_path / name).read_bytes()
        for size in np.linspace(0, len(whole) - 3, 9).astype(int):
            (tmp_path / name).write_bytes(whole[:size])
            with pytest.raises(dr.SceneError, match=name):
                dr.Result.load(tmp_path)
        (tmp_path / name).write_bytes(whole)
    dr.Result.load(tmp_path)
