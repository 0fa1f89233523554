"""Named arrays in one file, NumPy's .npz: read back without running anything the file may hold."""

from __future__ import annotations

import zipfile
from typing import TYPE_CHECKING

import numpy as np
from numpy.lib import format as npy

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["read_arrays", "write_arrays"]

ENDING = ".npy"


def write_arrays(path: Path, arrays: Mapping[str, Array]) -> None:
    """Write arrays of doubles under their names, not compressed.

    Args:
        path: File to write.
        arrays: Name → values.
    """
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        for name, values in arrays.items():
            with archive.open(name + ENDING, "w", force_zip64=True) as file:
                npy.write_array(file, np.asarray(values), allow_pickle=False)


def read_arrays(path: Path) -> dict[str, Array]:
    """Read back what `write_arrays` wrote.

    Args:
        path: File to read.

    Returns:
        Name → values.

    Raises:
        SceneError: Not such a file.
        OSError: The file cannot be read.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return {info.filename.removesuffix(ENDING): _read(archive, info) for info in archive.infolist()}
    except (zipfile.BadZipFile, ValueError, EOFError, MemoryError, NotImplementedError, RuntimeError) as error:
        if isinstance(error, SceneError):
            raise error.within(str(path)) from None
        raise SceneError(f"must be a file of arrays as NumPy writes it: {error}", field=str(path)) from None


def _read(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> Array:
    """One array of finite doubles; a packed one could unfold beyond all memory."""
    if info.compress_type != zipfile.ZIP_STORED or not info.filename.endswith(ENDING):
        raise SceneError(f"must hold plain arrays only, got {info.filename}", field="state")
    with archive.open(info) as file:
        values = npy.read_array(file, allow_pickle=False)
    if values.dtype != np.float64 or not np.isfinite(values).all():
        raise SceneError(f"must hold finite doubles only, got others in {info.filename}", field="state")
    return values
