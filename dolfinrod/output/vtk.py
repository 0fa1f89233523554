"""A result for ParaView: one VTU file a stored time, and a collection that plays them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from dolfinrod.result import Result

    Array = NDArray[np.float64]

__all__ = ["write_collection", "write_series"]

COLLECTION = "rods.pvd"
TOUCHING = ("gap", "pressure", "traction", "slip", "state")


def write_series(result: Result, folder: Path) -> None:
    """Write `rods.pvd` and `rods-0000.vtu`, `rods-0001.vtu`, …: all rods at one stored time in each.

    Point data: arc length `s`, `displacement` from the stress-free shape, section frame `d1`, `d2`, `d3`, strains
    `gamma`, `kappa`, resultants `n`, `m` in the section frame, `force` and `moment` in space, of a motion `v` and
    `omega` in space too, all in SI units. Of the first contact `contact_0_gap`, `contact_0_pressure`,
    `contact_0_traction`, `contact_0_slip` and `contact_0_state`, and so on; rods that it does not concern have no gap,
    nan, and zeros. Cell data: `rod`, counted from 0.

    Args:
        result: What was found.
        folder: Where the files are made.
    """
    # It takes a fifth of a second to load.
    import meshio

    counts = [len(rod.s) for rod in result.rods]
    first = np.cumsum([0, *counts[:-1]])
    nodes = [start + np.arange(n - 1) for start, n in zip(first, counts, strict=True)]
    cells = [("line", np.stack([np.concatenate(nodes), np.concatenate(nodes) + 1], axis=1))]
    rods = [np.repeat(np.arange(len(counts)), [n - 1 for n in counts])]
    stress_free = [rod.centerline(history.s) for rod, history in zip(result.scene.rods, result.rods, strict=True)]
    names = [f"rods-{i:04d}.vtu" for i in range(len(result.t))]
    for i, name in enumerate(names):
        points = np.concatenate([rod.r[i] for rod in result.rods])
        data = {"displacement": points - np.concatenate(stress_free), **_at_nodes(result, i), **_touched(result, i)}
        mesh = meshio.Mesh(points, cells, point_data=data, cell_data={"rod": list(rods)})
        meshio.write(folder / name, mesh)
    write_collection(folder / COLLECTION, result.t, [[name] for name in names])


def _at_nodes(result: Result, i: int) -> dict[str, Array]:
    """Quantities of all rods at stored time i, node after node."""
    parts = []
    for rod in result.rods:
        R = rod.frames[i]
        part = {"s": rod.s} | {f"d{k + 1}": R[:, :, k] for k in range(3)}
        part |= {name: getattr(rod, name)[i] for name in ("gamma", "kappa", "n", "m")}
        part |= {"force": np.einsum("sij,sj->si", R, rod.n[i]), "moment": np.einsum("sij,sj->si", R, rod.m[i])}
        part |= {name: values[i] for name in ("v", "omega") if (values := getattr(rod, name)) is not None}
        parts.append(part)
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def _touched(result: Result, i: int) -> dict[str, NDArray[Any]]:
    """What each contact does at stored time i, node after node of all rods."""
    data: dict[str, NDArray[Any]] = {}
    for k, contact in enumerate(result.contacts):
        for name in TOUCHING:
            parts = [
                _untouched(name, len(rod.s)) if touching is None else getattr(touching, name)[i]
                for rod, touching in zip(result.rods, contact.rods, strict=True)
            ]
            data[f"contact_{k}_{name}"] = np.concatenate(parts)
    return data


def _untouched(name: str, n: int) -> NDArray[Any]:
    """The same of a rod that a contact does not concern."""
    if name == "gap":
        return np.full(n, np.nan)
    return np.zeros((n, 3)) if name == "traction" else np.zeros(n, dtype=np.int8 if name == "state" else np.float64)


def write_collection(path: Path, t: Array, shown: list[list[str]]) -> None:
    """Write a list of files with their pseudo-times or times.

    Args:
        path: File to write.
        t: Stored times.
        shown: Names of the files at each of them.
    """
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for time, names in zip(t, shown, strict=True):
        for part, name in enumerate(names):
            ElementTree.SubElement(collection, "DataSet", timestep=repr(float(time)), part=str(part), file=name)
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
