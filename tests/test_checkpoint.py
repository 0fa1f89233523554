"""Runs kept in a file: what interrupts them changes nothing, and no file but their own is gone on from."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from mpi4py import MPI

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import discrete
import dolfinrod as dr
from dolfinrod import cli
from dolfinrod.checkpoint import checkpoint as clock
from dolfinrod.checkpoint.hdf import BLOCK, read, seal
from dolfinrod.checkpoint.patience import patient
from dolfinrod.continuum import backend
from dolfinrod.scene import toml
from tests.scenes import SKEW, Pose

SECTION = dr.Section(EA=1200.0, GA=400.0, GJ=0.8, EI=(1.0, 2.0), rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
SOFTER = dr.Section(EA=1200.0, GA=400.0, GJ=0.8, EI=1.0, rhoA=1.0, rhoI=(3e-2, 1e-2, 2e-2))
ARRAYS = ("r", "frames", "v", "omega", "n", "m")
Solve = Callable[..., dr.Result]


@dataclass(frozen=True)
class Model:
    """A way to solve.

    Args:
        solve: The solver with its options.
        off: Largest difference of a run in two parts, relative to the largest value: that of two iterates, for factors
            and predictions are made anew; in the discrete model its tolerance of 1e-9 in each step.
    """

    solve: Solve
    off: float


PLANAR = Model(partial(dr.solve, elements=2, degree=2, kinematics=dr.Planar()), 1e-10)
SPATIAL = Model(partial(dr.solve, elements=2, degree=2, kinematics=dr.Spatial()), 1e-10)
DISCRETE = Model(partial(discrete.solve, elements=4), 1e-7)
EULER, MIDPOINT = dr.ImplicitEuler(), dr.Midpoint()

MOTIONS = {
    f"{name}, {scheme}, {how}": (model, dr.Dynamic(0.16, **steps, scheme=rule, output=output))
    for name, model in (("planar", PLANAR), ("spatial", SPATIAL), ("discrete", DISCRETE))
    for scheme, rule in (("Euler", EULER), ("midpoint", MIDPOINT))
    for how, steps, output in (("fixed", {"dt": 0.02}, None), ("free", {"tol": 1e-2}, 0.07))
    if model is not DISCRETE or rule is EULER
}


@pytest.fixture(autouse=True)
def written_after_every_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clock, "INTERVAL", 0.0)
    monkeypatch.setattr(clock, "SPARING", 0.0)


@pytest.fixture
def file(shared_path: Path) -> Path:
    """Of one run, the same for all ranks."""
    return shared_path / "run.h5"


def swung(
    motion: dr.Dynamic | dr.Static, pose: Pose = SKEW, *, force: float = 6.0, section: dr.Section = SECTION
) -> dr.Scene:
    """A cantilever that is pushed across for a while."""
    history = ((0.0, 0.0), (0.05, 1.0), (0.11, 1.0), (0.15, 0.0))
    push = dr.PointForce(pose.turned((0.0, force, 0.0)), at="end", history=history)
    return dr.Scene([pose.straight(section)], [dr.Clamp("start")], [push], motion=motion)


def until(t: float) -> Callable[[dr.StepLog, float], None]:
    """Ctrl-C once a time is reached."""

    def stop(step: dr.StepLog, _t_end: float) -> None:
        if step.t >= t * (1.0 - 1e-9):
            raise KeyboardInterrupt

    return stop


def interrupted(solve: Solve, scene: dr.Scene, t: float, **options: object) -> dr.NotConverged:
    """What the user sees who interrupts a run."""
    with pytest.raises(dr.NotConverged, match=r"interrupted by the user.*goes on from there") as caught:
        solve(scene, progress=until(t), **options)
    return caught.value


def never(_step: dr.StepLog, _t_end: float) -> None:
    raise AssertionError("a finished run took a step")


def assert_same(one: dr.Result, other: dr.Result, off: float) -> None:
    """Two records of one motion."""
    assert (len(one.log), one.converged, one.formulation) == (len(other.log), other.converged, other.formulation)
    np.testing.assert_allclose(one.t, other.t, rtol=off)
    for a, b in zip(one.rods, other.rods, strict=True):
        for name in ARRAYS:
            x, y = getattr(a, name), getattr(b, name)
            np.testing.assert_allclose(x, y, rtol=0, atol=off * max(1.0, np.abs(y).max()))
    scale = max(1.0, *(np.abs(values).max() for values in other.energy.values()))
    for name, values in other.energy.items():
        np.testing.assert_allclose(one.energy[name], values, rtol=0, atol=off * scale)


FIXED = dr.Dynamic(0.04, dt=0.02)
SCENE = swung(FIXED)


@pytest.mark.serial
@pytest.mark.parametrize("name", MOTIONS)
def test_an_interrupted_motion_goes_on_to_the_same_answer(name, file):
    model, motion = MOTIONS[name]
    scene, whole = swung(motion), model.solve(swung(motion))
    failure = interrupted(model.solve, scene, 0.09, checkpoint=file)
    reached = failure.result
    assert not reached.converged
    assert reached.t[-1] == reached.log[-1].t == failure.t >= 0.09 * (1.0 - 1e-9)
    assert str(file) in failure.advice
    again = model.solve(scene, checkpoint=file)
    assert_same(again, whole, model.off)
    kept = file.read_bytes()
    assert_same(model.solve(scene, checkpoint=file, progress=never), again, 0.0)
    assert file.read_bytes() == kept


@pytest.mark.serial
@pytest.mark.parametrize("model", [PLANAR, DISCRETE], ids=["continuum", "discrete"])
def test_a_finished_motion_goes_on_to_a_later_end(model, file):
    steady = replace(SCENE.loads[0], history=None)
    longer, shorter = (replace(swung(dr.Dynamic(t_end, dt=0.02)), loads=[steady]) for t_end in (0.2, 0.12))
    model.solve(shorter, checkpoint=file)
    assert_same(model.solve(longer, checkpoint=file), model.solve(longer), model.off)
    with pytest.raises(dr.SceneError, match=r"t_end was 0\.2 and is 0\.12"):
        model.solve(shorter, checkpoint=file)


@pytest.mark.serial
@pytest.mark.parametrize("model", [PLANAR, SPATIAL, DISCRETE], ids=["planar", "spatial", "discrete"])
def test_an_interrupted_equilibrium_goes_on_to_the_same_answer(model, file):
    """Load steps may be others; what is in equilibrium is not."""
    scene, off = swung(dr.Static(steps=5)), 1e-9
    whole = model.solve(scene)
    interrupted(model.solve, scene, 0.6, checkpoint=file)
    again = model.solve(scene, checkpoint=file)
    assert again.log[: len(whole.log)] != ()
    np.testing.assert_allclose(again.t, whole.t)
    np.testing.assert_allclose(again.rods[0].r, whole.rods[0].r, atol=off)
    np.testing.assert_allclose(again.energy["strain"], whole.energy["strain"], atol=off)
    assert [row.stable for row in again.log] == [row.stable for row in whole.log]
    assert (model.solve(scene, checkpoint=file, progress=never).rods[0].r == again.rods[0].r).all()


class Trap:
    """A history f(t) = sin 9t that is interrupted at its nth value."""

    def __init__(self, n: int) -> None:
        self.n = n

    def __call__(self, t: float) -> float:
        self.n -= 1
        if self.n == 0:
            raise KeyboardInterrupt
        return float(np.sin(9.0 * t))


@pytest.mark.serial
@pytest.mark.parametrize("model", [PLANAR, DISCRETE], ids=["continuum", "discrete"])
@pytest.mark.parametrize("n", [3, 8])
def test_ctrl_c_in_the_middle_of_a_step_costs_that_step_only(model, n, tmp_path):
    motion = dr.Dynamic(0.2, dt=0.02, output=0.1)

    def scene(trap: Trap) -> dr.Scene:
        load = dr.PointForce(SKEW.turned((0.0, 3.0, 0.0)), "end", history=trap)
        return dr.Scene([SKEW.straight(SECTION)], [dr.Clamp("start")], [load], motion=motion)

    whole = model.solve(scene(Trap(0)))
    with pytest.raises(dr.NotConverged, match="interrupted by the user") as caught:
        model.solve(scene(Trap(n)), checkpoint=tmp_path / "run.h5")
    reached = caught.value.result
    assert len(reached.t) == len(reached.rods[0].r)
    assert reached.t[-1] == (reached.log[-1].t if reached.log else 0.0)
    assert_same(model.solve(scene(Trap(0)), checkpoint=tmp_path / "run.h5"), whole, model.off)


@pytest.mark.serial
@pytest.mark.parametrize("motion", [dr.Static(), dr.Dynamic(0.04, dt=0.02)], ids=["statics", "dynamics"])
def test_ctrl_c_in_the_middle_of_a_tangent_harms_no_later_solve(motion, monkeypatch):
    """Elements are kept for the next scene, and so is the tangent that was just being put together."""

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    scene = swung(motion)
    whole = SPATIAL.solve(scene)
    monkeypatch.setattr(backend, "add_entries", stop)
    with pytest.raises(dr.NotConverged, match="interrupted by the user"):
        SPATIAL.solve(scene)
    monkeypatch.undo()
    assert (SPATIAL.solve(scene).tip == whole.tip).all()


@pytest.mark.serial
def test_ctrl_c_waits_while_a_file_is_written():
    done = []

    def write() -> None:
        with patient():
            signal.raise_signal(signal.SIGINT)
            done.append("written")

    with pytest.raises(KeyboardInterrupt):
        write()
    assert done == ["written"]


@pytest.mark.parametrize("scheme", [EULER, MIDPOINT], ids=["Euler", "midpoint"])
def test_two_ranks_leave_what_one_goes_on_from(scheme, file):
    """Together, interrupted; then the first rank alone, for a while; then together again."""
    scene = swung(dr.Dynamic(0.2, dt=0.02, scheme=scheme))
    whole = SPATIAL.solve(scene, comm=MPI.COMM_SELF)
    interrupted(SPATIAL.solve, scene, 0.05, checkpoint=file)
    if MPI.COMM_WORLD.rank == 0:
        interrupted(SPATIAL.solve, scene, 0.11, checkpoint=file, comm=MPI.COMM_SELF)
    MPI.COMM_WORLD.barrier()
    assert_same(SPATIAL.solve(scene, checkpoint=file), whole, 1e-10)


KILLED = """
import os, signal, sys
from pathlib import Path
import dolfinrod as dr
from dolfinrod import cli
from dolfinrod.checkpoint import checkpoint as clock
from mpi4py import MPI
from tests.test_checkpoint import SPATIAL, swung
clock.INTERVAL = clock.SPARING = 0.0

def kill(step, _t_end):
    if step.t > 0.09 and MPI.COMM_WORLD.rank == 0:
        os.kill(os.getpid(), signal.SIGKILL)

SPATIAL.solve(swung(dr.Dynamic(0.2, dt=0.02, scheme=dr.Midpoint())), checkpoint=sys.argv[1], progress=kill)
"""


@pytest.mark.slow
@pytest.mark.serial
def test_a_run_on_two_ranks_that_is_killed_goes_on_on_one(tmp_path):
    file, root = tmp_path / "run.h5", Path(__file__).parents[1]
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "PYTHONPATH": str(root)}
    outer = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))}
    command = ["mpirun", "--oversubscribe", "-n", "2", sys.executable, "-m", "mpi4py", "-c", KILLED, str(file)]
    done = subprocess.run(command, env=outer | allowed, cwd=root, capture_output=True, timeout=300, check=False)
    assert done.returncode != 0
    assert file.exists(), done.stderr
    scene = swung(dr.Dynamic(0.2, dt=0.02, scheme=MIDPOINT))
    first = []
    again = SPATIAL.solve(scene, checkpoint=file, progress=lambda step, _: first.append(step.t))
    assert first[0] == pytest.approx(0.11)
    assert_same(again, SPATIAL.solve(scene), 1e-10)


def waved(ω: float) -> dr.Scene:
    """The same under a function of time and in a wind that is a function, which nobody can compare."""
    push = dr.PointForce((0.0, 1.0, 0.0), "end", history=lambda t: np.sin(ω * t))
    wind = dr.Air(field=lambda x, t: 0.0 * x + ω * t)
    rod = dr.Rod.straight(1.0, dr.Section.circle(diameter=0.1, E=1e5, G=4e4, density=100.0))
    return dr.Scene([rod], [dr.Clamp("start")], [push], motion=FIXED, air=wind)


@pytest.mark.serial
@pytest.mark.parametrize(
    ("first", "then", "options", "words"),
    [
        (SCENE, swung(FIXED, force=7.0), {}, r"loads\[0\]\.force was \(.*\) and is \("),
        (SCENE, swung(FIXED, section=SOFTER), {}, r"rods\[0\]\.section\.EI was \(1\.0, 2\.0\) and is \(1\.0, 1\.0\)"),
        (SCENE, replace(SCENE, loads=()), {}, r"loads was 1 of them and is \(\)"),
        (SCENE, replace(SCENE, motion=dr.Dynamic(0.04, dt=0.01)), {}, r"motion\.dt was 0\.02 and is 0\.01"),
        (SCENE, replace(SCENE, motion=dr.Static(t_end=0.04)), {}, "motion was Dynamic and is Static"),
        (SCENE, SCENE, {"elements": 3}, r"elements was \(4,\) and is \(3,\)"),
        (SCENE, SCENE, {"rotation": "added"}, "rotation was 'exponential' and is 'added'"),
        (waved(1.0), waved(2.0), {}, r"loads\[0\]\.history had other values"),
    ],
    ids=["load", "section", "fewer loads", "step", "statics", "elements", "option", "function"],
)
def test_a_file_of_another_run_is_refused_by_name(first, then, options, words, tmp_path):
    file = tmp_path / "run.h5"
    DISCRETE.solve(first, checkpoint=file)
    kept = file.read_bytes()
    with pytest.raises(dr.SceneError, match=f"^checkpoint {file} must be of this scene and model, but {words}"):
        DISCRETE.solve(then, checkpoint=file, **options)
    assert file.read_bytes() == kept


@pytest.mark.serial
def test_a_file_of_the_other_model_mesh_or_plane_is_refused(tmp_path):
    file = tmp_path / "run.h5"
    PLANAR.solve(SCENE, checkpoint=file)
    for solve, options, words in (
        (discrete.solve, {}, "model was 'continuum' and is 'discrete'"),
        (PLANAR.solve, {"degree": 3}, "degree was 2 and is 3"),
        (SPATIAL.solve, {}, r"kinematics was Planar\(.*\) and is Spatial\(\)"),
        (PLANAR.solve, {"start": PLANAR.solve(SCENE)}, "start had other values"),
    ):
        with pytest.raises(dr.SceneError, match=words):
            solve(SCENE, checkpoint=file, **options)


@pytest.mark.serial
def test_equal_functions_are_the_same_run(tmp_path):
    once = DISCRETE.solve(waved(1.0), checkpoint=tmp_path / "run.h5")
    again = DISCRETE.solve(waved(1.0), checkpoint=tmp_path / "run.h5", progress=never)
    assert_same(again, once, 0.0)


@pytest.fixture(scope="module")
def whole_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of the discrete model."""
    file = tmp_path_factory.mktemp("whole") / "run.h5"
    DISCRETE.solve(SCENE, checkpoint=file)
    return file


def forged(whole: Path, change: Callable[[h5py.File], None]) -> bytes:
    """The file after a change that its check sum knows of."""
    path = whole.with_name("forged.h5")
    path.write_bytes(whole.read_bytes())
    with h5py.File(path, "r+") as root:
        change(root)
    with open(path, "r+b") as file:
        file.truncate(max(path.stat().st_size, BLOCK))
        file.write(b"\0" * BLOCK)
        seal(file)
    return path.read_bytes()


def instead(name: str, **how: object) -> Callable[[h5py.File], None]:
    """Another array under the name of one."""

    def change(root: h5py.File) -> None:
        del root[name]
        root.create_dataset(name, **how)

    return change


def linked(name: str, link: object) -> Callable[[h5py.File], None]:
    """A link to somewhere under the name of an array or group."""

    def change(root: h5py.File) -> None:
        del root[name]
        root[name] = link

    return change


FORGERIES: dict[str, tuple[Callable[[h5py.File], None], str]] = {
    "soft link": (linked("state/x", h5py.SoftLink("/state/v")), "plain arrays of float64 only"),
    "link to a file": (linked("state/x", h5py.ExternalLink("/etc/passwd", "/x")), "plain arrays of float64 only"),
    "linked group": (linked("state", h5py.SoftLink("/stored")), "groups of arrays only"),
    "group in a group": (lambda root: root.create_group("state/more"), "plain arrays of float64 only"),
    "array without a group": (lambda root: root.create_dataset("x", data=1.0), "groups of arrays only"),
    "words": (instead("state/x", data=["__import__('os')"] * 3, dtype=h5py.string_dtype()), "plain arrays of float64"),
    "references": (instead("state/x", shape=(3,), dtype=h5py.ref_dtype), "plain arrays of float64"),
    "single precision": (instead("state/x", data=np.zeros((5, 3), "f4")), "plain arrays of float64"),
    "packed": (instead("state/x", shape=(1 << 40,), dtype="f8", chunks=(1 << 16,), compression=9), "plain arrays only"),
    "not there": (instead("state/x", shape=(1 << 40,), dtype="f8"), "plain arrays only"),
    "elsewhere": (
        instead("state/x", shape=(5, 3), dtype="f8", external=[("/etc/passwd", 0, 120)]),
        "plain arrays only",
    ),
    "infinite": (instead("state/x", data=np.full((5, 3), np.inf)), "finite doubles only, got others in state/x"),
    "missing": (lambda root: root.pop("state/x"), r"an array state/x of shape \(5, 3\), got none"),
    "another shape": (instead("state/x", data=np.zeros((4, 3))), r"got one of shape \(4, 3\)"),
    "no number of things": (instead("work/iterations", data=-1.5), "a number of things in work/iterations, got -1.5"),
    "times in disorder": (instead("stored/t", data=np.array([0.0, 0.02, 0.01])), "ascending times"),
    "steps in disorder": (instead("log/t", data=np.array([0.02, 0.02])), "ascending times"),
    "no JSON": (instead("about", data=np.frombuffer(b"{", np.uint8)), "is no JSON"),
    "says nothing": (instead("about", data=np.frombuffer(b"[]", np.uint8)), "must say of what scene it is"),
}


@pytest.mark.serial
@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_file_is_refused(name, whole_file, tmp_path):
    change, words = FORGERIES[name]
    file = tmp_path / "run.h5"
    file.write_bytes(forged(whole_file, change))
    with pytest.raises(dr.SceneError, match=words):
        DISCRETE.solve(SCENE, checkpoint=file)


def foreign() -> bytes:
    """HDF5 of somebody else."""
    with h5py.File("x", "w", driver="core", backing_store=False) as root:
        root["state/x"] = np.zeros(3)
        root.flush()
        return bytes(root.id.get_file_image())


DAMAGES: dict[str, tuple[Callable[[bytes], bytes], str]] = {
    "empty": (lambda _: b"", "another kind of file"),
    "text": (lambda _: b"Dear Sir or Madam,\n" * 100, "another kind of file"),
    "HDF5 of others": (lambda _: foreign(), "another kind of file"),
    "no first block": (lambda whole: whole[BLOCK:], "another kind of file"),
    "cut in the first block": (lambda whole: whole[:300], "got 300 of .* bytes|damaged"),
    "cut": (lambda whole: whole[:-1000], "got .* of .* bytes"),
    "longer": (lambda whole: whole + b"\0", "got .* of .* bytes"),
    "one bit": (lambda whole: whole[:-1] + bytes([whole[-1] ^ 1]), "its check sum is another"),
    "of tomorrow": (lambda whole: whole.replace(b"checkpoint 1", b"checkpoint 2", 1), "format 1, got 2"),
}


@pytest.mark.serial
@pytest.mark.parametrize("name", DAMAGES)
def test_a_damaged_file_is_refused(name, whole_file, tmp_path):
    change, words = DAMAGES[name]
    file = tmp_path / "run.h5"
    file.write_bytes(change(whole_file.read_bytes()))
    with pytest.raises(dr.SceneError, match=f"^checkpoint {file} must be .*({words})"):
        DISCRETE.solve(SCENE, checkpoint=file)


@pytest.mark.serial
@given(places=st.lists(st.tuples(st.floats(0, 1, exclude_max=True), st.integers(1, 255)), min_size=1, max_size=5))
def test_damage_anywhere_is_found_out(places, whole_file):
    data = bytearray(whole_file.read_bytes())
    whole = bytes(data)
    for place, flip in places:
        data[int(place * len(data))] ^= flip
    path = whole_file.with_name("damaged.h5")
    path.write_bytes(data)
    if bytes(data) == whole:
        return
    with pytest.raises(dr.SceneError):
        read(path)


@pytest.mark.serial
@pytest.mark.parametrize(
    ("name", "words"),
    [
        (".", "must be a file, got a folder"),
        ("absent/run.h5", "absent is no folder with permission to write"),
        ("run\0.h5", "embedded null byte"),
        (3, "checkpoint must be the path of a file, or None, got 3"),
    ],
)
@pytest.mark.parametrize("solve", [PLANAR.solve, DISCRETE.solve], ids=["continuum", "discrete"])
def test_what_is_no_place_for_a_file_is_refused_before_the_run(solve, name, words, tmp_path):
    with pytest.raises(dr.SceneError, match=words):
        solve(SCENE, checkpoint=tmp_path / name if isinstance(name, str) else name, progress=never)


@pytest.mark.serial
def test_a_pipe_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(dr.SceneError, match="must be a file, got a device or a pipe"):
        DISCRETE.solve(SCENE, checkpoint=tmp_path / "pipe")


@pytest.mark.serial
def test_a_run_outlives_a_file_that_cannot_be_written(tmp_path, monkeypatch):
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(clock, "write", full)
    with pytest.warns(RuntimeWarning, match="could not be written: No space left on device"):
        assert DISCRETE.solve(SCENE, checkpoint=tmp_path / "run.h5").converged


@pytest.mark.serial
def test_nothing_but_the_file_is_left_and_increments_have_none(tmp_path):
    DISCRETE.solve(SCENE, checkpoint=tmp_path / "run.h5")
    assert [path.name for path in tmp_path.iterdir()] == ["run.h5"]
    with h5py.File(tmp_path / "run.h5", "r") as root:
        assert "numpy" in bytes(root["about"][()]).decode()
    with pytest.raises(dr.SceneError, match="checkpoint must be None where equilibrium is False"):
        DISCRETE.solve(replace(SCENE, motion=dr.Static()), equilibrium=False, checkpoint=tmp_path / "other.h5")


@pytest.mark.serial
@pytest.mark.parametrize(("model", "steps"), [(PLANAR, {"dt": 0.02}), (SPATIAL, {"tol": 1e-2})], ids=["fixed", "free"])
def test_a_motion_goes_on_from_a_result(model, steps, tmp_path):
    """Also one that was written and read, with other outputs and to a later end; the ledger goes on too."""
    whole = model.solve(swung(dr.Dynamic(0.2, **steps, scheme=MIDPOINT)))
    reached = interrupted(model.solve, whole.scene, 0.09).result
    reached.write(tmp_path)
    loaded = dr.Result.load(tmp_path)
    longer = replace(whole.scene, motion=dr.Dynamic(0.24, **steps, scheme=MIDPOINT, output=(0.2,)))
    rest, on = model.solve(whole.scene, start=reached), model.solve(longer, start=loaded)
    assert rest.t[0] == on.t[0] == reached.t[-1]
    np.testing.assert_allclose(rest.tip, whole.tip, rtol=0, atol=1e-10)
    for name, values in whole.energy.items():
        np.testing.assert_allclose(rest.energy[name][-1], values[-1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(on.rods[0].r[1, -1], whole.tip, rtol=0, atol=1e-5 if "tol" in steps else 1e-10)
    assert on.t.tolist() == [reached.t[-1], 0.2, 0.24]


@pytest.mark.serial
@pytest.mark.parametrize("model", ["continuum", "discrete"])
def test_the_same_command_goes_on(model, tmp_path, monkeypatch, capsys):
    """Interrupted, what was reached is written; the command once more ends where it had ended without."""
    (tmp_path / "scene.toml").write_text(toml.dumps(SCENE, {"elements": 2}), encoding="utf-8")
    words = ["run", str(tmp_path / "scene.toml"), "--model", model, "--checkpoint", str(tmp_path / "run.h5")]
    monkeypatch.setattr(cli, "ProgressLine", lambda *_, **__: Interrupting(0.02))
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert cli.main([*words, "--out", str(tmp_path / "first")]) == 1
    assert "run.h5 goes on from there" in capsys.readouterr().err
    assert dr.Result.load(tmp_path / "first").t[-1] == pytest.approx(0.02)
    monkeypatch.undo()
    assert cli.main([*words, "--out", str(tmp_path / "then")]) == 0
    assert cli.main([*words[:4], "--out", str(tmp_path / "whole")]) == 0
    then, whole = (dr.Result.load(tmp_path / folder) for folder in ("then", "whole"))
    assert_same(then, whole, 1e-7)
    capsys.readouterr()
    (tmp_path / "run.h5").write_bytes(b"Dear Sir or Madam,")
    assert cli.main(words) == 2
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "run.h5 must be a checkpoint of dolfinrod, got another kind of file" in said.err


class Interrupting:
    """A progress line whose user has had enough at a time."""

    def __init__(self, t: float) -> None:
        self._stop = until(t)

    def __call__(self, step: dr.StepLog, t_end: float) -> None:
        self._stop(step, t_end)

    def clear(self) -> None:
        """Nothing to clear."""


@pytest.mark.serial
def test_two_models_keep_two_files(tmp_path):
    (tmp_path / "scene.toml").write_text(toml.dumps(SCENE, {"elements": 2}), encoding="utf-8")
    words = ["run", str(tmp_path / "scene.toml"), "--model", "both", "--checkpoint", str(tmp_path / "run.h5")]
    assert cli.main(words) == 0
    assert {path.name for path in tmp_path.glob("*.h5")} == {"run-continuum.h5", "run-discrete.h5"}


@pytest.mark.serial
def test_a_start_that_is_no_part_of_the_motion_is_refused():
    result = PLANAR.solve(SCENE)
    grown = replace(SCENE, supports=[dr.Prescribed("start", rotation=SKEW.turned((0, 0, 0.1)), displacement=(0, 0, 0))])
    for scene, start, words in (
        (swung(FIXED, force=7.0), result, "start must be None or a result of this very motion"),
        (replace(SCENE, motion=replace(FIXED, scheme=MIDPOINT)), result, "this very motion"),
        (
            replace(SCENE, motion=dr.Dynamic(0.02, dt=0.02)),
            result,
            r"start must end before t_end = 0\.02 s, got 0\.04 s",
        ),
        (SCENE, DISCRETE.solve(SCENE), "by the continuum model|this very motion"),
        (SCENE, SPATIAL.solve(SCENE), "on the same elements, degree and kinematics"),
        (replace(grown, motion=dr.Dynamic(0.08, dt=0.02)), PLANAR.solve(grown), "this very motion"),
    ):
        with pytest.raises(dr.SceneError, match=words):
            PLANAR.solve(scene, start=start)


@pytest.mark.serial
def test_a_motion_that_fails_says_what_to_try():
    """A jerk that no step resolves."""
    burst = dr.FollowerForce((0.0, 1e15, 0.0), "end")
    scene = dr.Scene([SKEW.straight(SECTION)], [dr.Clamp("start")], [burst], motion=dr.Dynamic(1.0, dt=0.5))
    with pytest.raises(dr.NotConverged, match=r"Try Dynamic\(dt=0\.25\), more elements") as caught:
        PLANAR.solve(scene)
    assert caught.value.result.t[-1] == caught.value.t
