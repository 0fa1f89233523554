"""Rods along meshes of line cells: any order and orientation, and words for whatever is no open polyline."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import meshio
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from dolfinrod.scene import Rod, SceneError, toml
from dolfinrod.scene.mesh import polyline
from tests.scenes import COMPLETE, GENERAL

pytestmark = pytest.mark.serial

X = np.linspace(0.0, 1.0, 7)
CURVE = np.stack([X, X**2, np.sin(3 * X)], axis=1)
IN_ORDER = np.stack([np.arange(6), np.arange(1, 7)], axis=1)
# Name of a file, and how meshio writes it; Gmsh's other version and ways of packing numbers are formats of their own.
FORMATS = {
    "packed.vtu": {},
    "plain.vtu": {"compression": None},
    "text.vtu": {"binary": False},
    "curve.xdmf": {},
    "text.xdmf": {"data_format": "XML"},
    "binary.msh": {"file_format": "gmsh"},
    "text.msh": {"file_format": "gmsh", "binary": False},
    "old.msh": {"file_format": "gmsh22", "binary": False},
    "old-binary.msh": {"file_format": "gmsh22"},
    "curve.vtk": {},
    "curve.inp": {},
    "curve.med": {},
}


def written(path: Path, points: ArrayLike, cells: ArrayLike, kind: str = "line", **options: object) -> Path:
    """A file with one block of cells."""
    meshio.write(path, meshio.Mesh(points, [(kind, cells)]), **options)
    return path


@pytest.mark.parametrize("name", FORMATS)
def test_a_rod_from_a_file_is_the_rod_through_its_points(tmp_path, name, capfd):
    shuffled = IN_ORDER[[3, 0, 5, 1, 4, 2]]
    file = written(tmp_path / name, CURVE, shuffled, **FORMATS[name])
    capfd.readouterr()
    rod = Rod.from_mesh(file, GENERAL, d2=(0, 1, 1), pretwist=0.3)
    if name == "text.vtu":  # meshio writes twelve digits
        np.testing.assert_allclose(rod.shape.points, CURVE, rtol=1e-11)
    else:
        assert rod == Rod.through(CURVE, GENERAL, d2=(0, 1, 1), pretwist=0.3)
    assert capfd.readouterr() == ("", "")


@settings(max_examples=40)
@given(st.randoms(use_true_random=False), st.integers(2, 9), st.booleans(), st.booleans())
def test_order_numbering_orientation_and_other_cells_do_not_matter(random, n, quadratic, one_way):
    points = CURVE[0] + np.arange(2 * n - 1)[:, None] * [1.0, 0.5, -0.25]
    number = random.sample(range(2 * n + 5), 2 * n - 1)  # some points belong to no cell
    everywhere = np.full((2 * n + 5, 3), 99.0)
    everywhere[number] = points
    cells = [(number[2 * k], number[2 * k + 2], number[2 * k + 1]) for k in range(n - 1)]
    random.shuffle(cells)
    if not one_way:
        cells = [(b, a, m) if random.random() < 0.5 else (a, b, m) for a, b, m in cells]
    kind = "line3" if quadratic else "line"
    lines = np.array(cells)[:, : 3 if quadratic else 2]
    with TemporaryDirectory() as folder:
        blocks = [("vertex", [[0]]), (kind, lines), ("triangle", [[0, 1, 2]])]
        meshio.write(f"{folder}/curve.vtu", meshio.Mesh(everywhere, blocks))
        found = polyline(f"{folder}/curve.vtu")
    expected = points if quadratic else points[::2]
    backwards = number.index(cells[0][0]) > number.index(cells[0][1])
    np.testing.assert_array_equal(found, expected[::-1] if backwards else expected)
    assert not (one_way and backwards)


@pytest.mark.parametrize(
    ("unit", "metres"), [("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("inch", 0.0254), ("km", 1e3)]
)
def test_coordinates_are_in_the_unit_that_is_named(tmp_path, unit, metres):
    file = written(tmp_path / "curve.vtu", [[0, 0, 0], [1, 0, 0], [3, 7, 0]], [[0, 1], [1, 2]])
    points = polyline(file, unit=unit)
    np.testing.assert_allclose(points[2], [3 * metres, 7 * metres, 0.0], rtol=3e-16)
    if unit in ("mm", "um"):  # correctly rounded, as text with a unit is
        assert points[2].tolist() == [float(f"{k}e{-3 if unit == 'mm' else -6}") for k in (3, 7, 0)]


def test_points_of_a_plane_lie_at_z_zero(tmp_path):
    file = written(tmp_path / "plane.xdmf", CURVE[:, :2], IN_ORDER)
    np.testing.assert_array_equal(polyline(file), CURVE * [1, 1, 0])


@pytest.mark.parametrize("form", ["gmsh", "gmsh22"])
def test_a_physical_group_of_gmsh_chooses_among_several_pieces(tmp_path, form):
    # Two wires, each a physical group, as Gmsh's own text formats have them.
    head = {"gmsh": "4.1 0 8", "gmsh22": "2.2 0 8"}[form]
    names = '$PhysicalNames\n2\n1 1 "warp"\n1 2 "weft"\n$EndPhysicalNames\n'
    body = {
        "gmsh": "$Entities\n0 2 0 0\n1 0 0 0 2 0 0 1 1 0\n2 0 1 0 2 1 0 1 2 0\n$EndEntities\n"
        "$Nodes\n2 5 1 5\n1 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n2 0 0\n1 2 0 2\n4\n5\n0 1 0\n2 1 0\n$EndNodes\n"
        "$Elements\n2 3 1 3\n1 1 1 2\n1 1 2\n2 2 3\n1 2 1 1\n3 4 5\n$EndElements\n",
        "gmsh22": "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 2 1 0\n$EndNodes\n"
        "$Elements\n3\n1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n3 1 2 2 2 4 5\n$EndElements\n",
    }[form]
    file = tmp_path / "wires.msh"
    file.write_text(f"$MeshFormat\n{head}\n$EndMeshFormat\n{names}{body}", encoding="ascii")
    np.testing.assert_array_equal(polyline(file, group="warp"), [[0, 0, 0], [1, 0, 0], [2, 0, 0]])
    np.testing.assert_array_equal(polyline(file, group="weft"), [[0, 1, 0], [2, 1, 0]])
    with pytest.raises(SceneError, match=r"^Rod.file must be one polyline, got pieces that share no point"):
        polyline(file)
    with pytest.raises(SceneError, match=r"^Rod.group must be a group of .*wires.msh \(warp, weft\), got 'west'$"):
        polyline(file, group="west")


def test_a_scene_file_names_a_mesh_beside_it_and_is_written_back_exactly(tmp_path, monkeypatch):
    (tmp_path / "scenes").mkdir()
    written(tmp_path / "scenes" / "curve.vtu", 40 * CURVE, IN_ORDER)
    straight = 'straight = { length = "40 mm", start = ["0 mm", "0 mm", "0 mm"], direction = [1, 0, 0] }'
    assert straight in COMPLETE
    text = COMPLETE.replace(straight, 'from_mesh = { file = "curve.vtu", unit = "mm", pretwist = "1 rad/m" }')
    (tmp_path / "scenes" / "scene.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    scene, _ = toml.load("scenes/scene.toml")
    assert scene.rods[0] == Rod.from_mesh("scenes/curve.vtu", scene.rods[0].section, unit="mm", pretwist=1.0)
    assert toml.loads(toml.dumps(scene))[0] == scene
    with pytest.raises(SceneError, match=r"^rods\[0\].from_mesh.file must be the path of a mesh, found no file"):
        toml.loads(text)
    assert toml.loads(text, folder="scenes")[0] == scene


Spoil = Callable[[Path], object]


def mesh(points: ArrayLike, cells: ArrayLike, kind: str = "line", name: str = "bad.vtu") -> Spoil:
    return lambda folder: written(folder / name, np.array(points, dtype=float), cells, kind)


def raw(content: bytes, name: str) -> Spoil:
    def put(folder: Path) -> Path:
        (folder / name).write_bytes(content)
        return folder / name

    return put


def pieces(folder: Path) -> Path:
    """A VTU file of two pieces, of which meshio would keep the last."""
    text = written(folder / "one.vtu", CURVE, IN_ORDER).read_text(encoding="utf-8")
    start, stop = text.index("<Piece"), text.index("</Piece>") + len("</Piece>")
    return raw((text[:stop] + text[start:stop] + text[stop:]).encode(), "bad.vtu")(folder)


def pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.vtu")
    return folder / "pipe.vtu"


def endless_tag(folder: Path) -> Path:
    """A Gmsh file with a node number for which meshio would make a table of 80 GB."""
    text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2 1 2\n1 1 0 2\n1\n9999999999\n0 0 0\n1 0 0\n$EndNodes\n"
    elements = "$Elements\n1 1 1 1\n1 1 1 1\n1 1 2\n$EndElements\n"
    return raw((text + elements).encode(), "bad.msh")(folder)


SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
LINK = [[0, 1]]
BAD: dict[str, tuple[Spoil, str]] = {
    "missing": (lambda folder: folder / "none.vtu", "Rod.file must be the path of a mesh, found no file .*none.vtu"),
    "folder": (lambda folder: folder, "Rod.file must be the path of a mesh, found no file"),
    "pipe": (pipe, "found no file .*pipe.vtu"),
    "no path": (lambda _: 3, "Rod.file must be the path of a mesh, got 3"),
    "no ending": (raw(b"", "curve"), r"must be a mesh that meshio reads, got .*curve \(ReadError: Could not deduce"),
    "strange ending": (raw(b"", "curve.stp"), "must be a mesh that meshio reads, got .*curve.stp"),
    "format without end": (raw(b"", "curve.ply"), "must be in a format such as .vtu, .msh or .xdmf, got .*curve.ply"),
    **{
        f"{what} {ending}": (
            raw(content, f"bad.{ending}"),
            rf"must be a mesh that meshio reads, got .*bad.{ending} \(\w+",
        )
        for what, content in {
            "empty": b"",
            "rubbish": bytes(range(256)) * 9,
            "words": b"once upon a time\n" * 9,
        }.items()
        for ending in ("vtu", "msh", "xdmf", "vtk", "med")
    },
    "pieces": (pieces, "must be a mesh of one piece, got several in .*bad.vtu"),
    "endless": (endless_tag, r"must be a mesh that meshio reads, got .*bad.msh \(\w*MemoryError"),
    "triangles": (mesh(SQUARE, [[0, 1, 2]], "triangle"), "must have line cells, got triangle in .*bad.vtu"),
    "one point": (mesh([[0, 0, 0]], [[0]], "vertex"), "must have line cells, got vertex"),
    "loop": (mesh(SQUARE, [[0, 1], [1, 2], [2, 3], [3, 0]]), r"closed loop through point 0 at \(0, 0, 0\) in"),
    "branch": (
        mesh(SQUARE, [[0, 1], [1, 2], [3, 1]]),
        r"must not branch, got 3 line cells that meet in point 1 at \(1, 0, 0\) in .*bad.vtu",
    ),
    "pieces apart": (
        mesh(SQUARE, [[0, 1], [3, 2]]),
        r"one polyline, got pieces that share no point: one through point 0 at \(0, 0, 0\), another through point 2 at",
    ),
    "loop apart": (
        mesh([*SQUARE, [5, 0, 0], [6, 0, 0]], [[0, 1], [1, 2], [2, 0], [4, 5]]),
        "one through point 4 .*, another through point 0 at",
    ),
    "twice": (
        mesh(SQUARE, [[0, 1], [1, 2], [2, 1]]),
        r"each cell once, got 2 cells between point 1 at \(1, 0, 0\) and point 2 at \(1, 1, 0\)",
    ),
    "no length": (mesh(SQUARE, [[0, 1], [1, 1]]), r"must have cells of some length, got one of none at point 1"),
    "two points, one place": (mesh([[1, 0, 0], [1, 0, 0]], LINK), "must have cells of some length, got one of none"),
    "nan": (mesh([[0, 0, 0], [0, np.nan, 0]], LINK), r"finite coordinates, got point 1 at \(0, nan, 0\)"),
    "inf": (mesh([[0, 0, 0], [0, 0, np.inf]], LINK), r"finite coordinates, got point 1 at \(0, 0, inf\)"),
    "stray": (mesh(SQUARE, [[0, 9]]), "must hold the points of its cells, got a cell with point 9 of 4"),
    "back on the spot": (mesh([[0, 0, 0], [1, 0, 0], [0, 0, 0]], [[0, 1], [1, 2]]), "turn back on the spot"),
}


@pytest.mark.parametrize("bad", BAD)
def test_a_file_that_is_no_open_polyline_is_answered_in_words(tmp_path, bad, capfd):
    spoil, words = BAD[bad]
    file = spoil(tmp_path)
    capfd.readouterr()
    with pytest.raises(SceneError, match=words):
        Rod.from_mesh(file, GENERAL)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"unit": "N"}, "Rod.unit must be a quantity in m, got '1 N'"),
        ({"unit": "mmm"}, "Rod.unit must be a quantity in m, got '1 mmm': there is no unit 'mmm'"),
        ({"unit": "9**9**9"}, "Rod.unit must be a unit of length, such as mm, got '9"),
        ({"unit": None}, "Rod.unit must be a unit of length, such as mm, got None"),
        ({"group": "warp"}, r"Rod.group must be a group of .*curve.vtu \(it has none\), got 'warp'"),
        ({"group": ["warp"]}, r"Rod.group must be a group of .*got \['warp'\]"),
        ({"d2": (0, 0)}, "Rod.d2 must have 3 entries"),
        ({"pretwist": float("nan")}, "Rod.pretwist must be a finite number"),
    ],
)
def test_wrong_options_are_answered(tmp_path, options, words):
    file = written(tmp_path / "curve.vtu", CURVE, IN_ORDER)
    with pytest.raises(SceneError, match=f"^{words}".replace("**", r"\*\*")):
        Rod.from_mesh(file, GENERAL, **options)


def damaged(data: st.DataObject, whole: bytes) -> bytes:
    """Bytes with a part missing, overwritten or put in."""
    i, j = sorted((data.draw(st.integers(0, len(whole))), data.draw(st.integers(0, len(whole)))))
    return whole[:i] + data.draw(st.binary(max_size=6)) + whole[j if data.draw(st.booleans()) else i :]


@settings(max_examples=60)
@given(data=st.data())
def test_a_damaged_file_is_read_or_answered(tmp_path_factory, data):
    name = data.draw(st.sampled_from(sorted(FORMATS)))
    folder = tmp_path_factory.mktemp("damaged")
    file = written(folder / name, CURVE, IN_ORDER, **FORMATS[name])
    file.write_bytes(damaged(data, file.read_bytes()))
    with suppress(SceneError):
        points = polyline(file)
        assert np.isfinite(points).all()
        assert points.shape[1] == 3
