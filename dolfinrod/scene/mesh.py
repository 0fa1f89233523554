"""A polyline out of a mesh file: line cells, in any order and orientation, chained from end to end."""

from __future__ import annotations

import lzma
import re
import resource
import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any
from warnings import catch_warnings, filterwarnings

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.chain import ChainError, chained
from dolfinrod.scene.errors import SceneError
from dolfinrod.units import UnitError, si

__all__ = ["polyline"]

Array = NDArray[np.float64]
Links = NDArray[np.int64]

# Far beyond any polyline, and read within seconds.
MOST_BYTES = 100_000_000
# Formats whose readers in meshio 5.0 never come to an end where the file is cut short.
ENDLESS = (".dat", ".mdpa", ".ply", ".tec")
# Room for what is read: a damaged number of nodes can ask for all the memory there is.
MOST_MEMORY = 2_000_000_000
KINDS = ("line", "line3")
# meshio takes what it reads on trust, so a damaged file shows as whatever Python, NumPy or a library says of the first
# value that does not fit. SystemExit is meshio's own answer where it gives up.
DAMAGED = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    DeprecationWarning,
    EOFError,
    ImportError,
    LookupError,
    MemoryError,
    NameError,
    OSError,
    RuntimeError,
    StopIteration,
    SyntaxError,
    SystemExit,
    TypeError,
    ValueError,
    lzma.LZMAError,
    struct.error,
    zlib.error,
)


def polyline(file: object, *, unit: object = "m", group: object = None) -> Array:
    """Points of a mesh in the order in which its line cells lead through them, the way its first line cell leads.

    Args:
        file: Of any format that meshio reads, its cells `line` or `line3`; other cells are passed over.
        unit: Unit of length of its coordinates.
        group: Name of the physical group or cell set to read; None: all line cells.

    Returns:
        Points, shape (n_p, 3) [m].

    Raises:
        SceneError: No such file, or not one open polyline.
    """
    if not isinstance(file, str | Path):
        raise SceneError(f"must be the path of a mesh, got {file!r}", field="Rod.file")
    mesh, remarks = _read(Path(file))
    points = _points(mesh, file)
    links = _links(mesh, group, file, remarks)
    try:
        return _in_metres(points[chained(links, points)], unit)
    except ChainError as error:
        raise _refused(file, str(error)) from None


def _refused(file: object, rule: str) -> SceneError:
    return SceneError(f"{rule} in {file}", field="Rod.file")


def _read(path: Path) -> tuple[Any, str]:
    """What meshio makes of a file, and what it remarked on the way."""
    import meshio
    from meshio._exceptions import CorruptionError

    _check(path)
    # Of the two formats of one name only Gmsh's knows line cells, and meshio would try Ansys's first.
    form = "gmsh" if path.suffix.lower() == ".msh" else None
    remarks = StringIO()
    with catch_warnings(), redirect_stdout(remarks), redirect_stderr(remarks), _bounded_memory():
        # NumPy ends an array at the first word that is no number, and only warns.
        filterwarnings("error", message="string or file could not be read", category=DeprecationWarning)
        try:
            return meshio.read(path, form), _one_line(remarks.getvalue())
        except (meshio.ReadError, CorruptionError, *DAMAGED) as error:
            said = remarks.getvalue() if isinstance(error, SystemExit) else f"{type(error).__name__}: {error}"
    raise SceneError(f"must be a mesh that meshio reads, got {path} ({_one_line(said)})", field="Rod.file")


def _check(path: Path) -> None:
    """What can be told without reading the mesh."""
    suffix = path.suffix.lower()
    try:
        if not path.is_file():
            raise SceneError(f"must be the path of a mesh, found no file {path}", field="Rod.file")
        if suffix in ENDLESS:
            raise SceneError(f"must be in a format such as .vtu, .msh or .xdmf, got {path}", field="Rod.file")
        if path.stat().st_size > MOST_BYTES:
            raise _refused(path, f"must be a mesh of at most {MOST_BYTES} bytes, got {path.stat().st_size}")
        if suffix == ".vtu" and path.read_bytes().count(b"<Piece") > 1:
            # meshio 5.0 keeps the cells of the last piece only and says nothing.
            raise _refused(path, "must be a mesh of one piece, got several")
    except OSError as error:
        raise SceneError(f"must be a file that can be read: {error}", field="Rod.file") from None


@contextmanager
def _bounded_memory() -> Iterator[None]:
    """Lets what is asked for beyond `MOST_MEMORY` fail as MemoryError, not by the end of the process."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    room = pages * resource.getpagesize() + MOST_MEMORY
    if soft == resource.RLIM_INFINITY or room < soft:
        resource.setrlimit(resource.RLIMIT_AS, (room, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _one_line(text: str) -> str:
    return " ".join(re.sub(r"\b(?:Error|Warning):", " ", text).split())


def _points(mesh: Any, file: object) -> Array:
    """Points in space, z = 0 where the mesh is plane."""
    try:
        points = np.asarray(mesh.points, dtype=float)
    except (TypeError, ValueError):
        raise _refused(file, "must have numbers for coordinates, got something else") from None
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not len(points):
        raise _refused(file, f"must have points of 2 or 3 coordinates, got an array of shape {points.shape}")
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def _links(mesh: Any, group: object, file: object, remarks: str) -> Links:
    """Pairs of neighbouring nodes, one row a straight piece, in the order of the file, shape (n, 2)."""
    known = _groups(mesh)
    if group is not None and group not in known:
        words = f"must be a group of {file} ({', '.join(known) or 'it has none'}), got {group!r}"
        raise SceneError(words, field="Rod.group")
    found = [np.empty((0, 2), dtype=np.int64)]
    for k, block in enumerate(mesh.cells):
        # The node within a line3 comes last.
        if block.type in KINDS and len(block.data):
            cells = np.asarray(block.data, dtype=np.int64)
            cells = cells if group is None else cells[_members(mesh, group, k)]
            along = cells[:, [0, 2, 1]] if block.type == "line3" else cells
            found.append(np.stack([along[:, :-1], along[:, 1:]], axis=-1).reshape(-1, 2))
    links = np.concatenate(found)
    if not len(links):
        kinds = ", ".join(dict.fromkeys(block.type for block in mesh.cells)) or "no cells"
        where = "" if group is None else f" in the group {group}"
        raise _refused(file, f"must have line cells{where}, got {kinds}{f' ({remarks})' if remarks else ''}")
    return links


def _groups(mesh: Any) -> tuple[str, ...]:
    """Names of cell sets and of Gmsh's physical groups."""
    physical = mesh.field_data if "gmsh:physical" in mesh.cell_data else ()
    return tuple(dict.fromkeys(name for name in (*mesh.cell_sets, *physical) if not name.startswith("gmsh:")))


def _members(mesh: Any, group: object, k: int) -> Any:
    """Which cells of block k are in a group."""
    if group in mesh.cell_sets:
        members = mesh.cell_sets[group][k]
        return np.empty(0, dtype=np.int64) if members is None else np.asarray(members, dtype=np.int64)
    tag, dimension = mesh.field_data[group]
    return (mesh.cell_data["gmsh:physical"][k] == tag) & (dimension == 1)


def _in_metres(points: Array, unit: object) -> Array:
    """Coordinates correctly rounded where a metre holds a whole number of units."""
    try:
        if not isinstance(unit, str) or not unit.isalpha():
            raise UnitError(f"must be a unit of length, such as mm, got {unit!r}")
        metres, per_metre = si(f"1 {unit}", "m"), si("1 m", unit)
    except UnitError as error:
        raise SceneError(str(error), field="Rod.unit") from None
    return points / per_metre if metres < 1.0 else points * metres
