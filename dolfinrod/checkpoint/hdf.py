"""Named arrays of doubles in an HDF5 file that is known to be whole before the HDF5 library looks at it.

HDF5 lets a file begin with a block of the user's. Ours says what the file is, how long, and the SHA-256 of all that
follows: whatever is cut off, overwritten or of another origin is found out by that. Nothing in the file is ever run,
and what HDF5 could look for elsewhere or unfold to any size (links, virtual, compressed, external data) is refused.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import stat
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from dolfinrod.scene import SceneError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    import h5py
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["BLOCK", "read", "seal", "write"]

FORMAT = 1
# The user's block of an HDF5 file has 512 bytes or a power of two times as many.
BLOCK = 512
NAME = b"dolfinrod checkpoint "
HEADER = re.compile(NAME + rb"(\d{1,9})\nsha256 ([0-9a-f]{64})\nbytes (\d{1,18})\n\0*")
ABOUT = "about"
# Far beyond any scene in words, and any number of arrays that a run is kept in.
MOST_ABOUT, MOST_ARRAYS = 1 << 26, 256
AT_ONCE = 1 << 20


def write(path: Path, about: Mapping[str, Any], arrays: Mapping[str, Array]) -> None:
    """Write a file that appears complete or not at all.

    Args:
        path: Where; what was there is replaced.
        about: What JSON can hold.
        arrays: "group/name" → values.

    Raises:
        OSError: It cannot be written.
    """
    # The library takes a tenth of a second to load, and runs that nobody keeps need none.
    import h5py

    # Ranks of a model that knows no ranks all write, the same.
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    draft.unlink(missing_ok=True)
    try:
        with open(draft, "x+b") as file:
            with h5py.File(file, "w", userblock_size=BLOCK) as root:
                text = json.dumps(about, ensure_ascii=False, allow_nan=False).encode()
                root[ABOUT] = np.frombuffer(text, dtype=np.uint8)
                for name, values in arrays.items():
                    root[name] = np.asarray(values, dtype="<f8")
            seal(file)
            file.flush()
            os.fsync(file.fileno())
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def seal(file: BinaryIO) -> None:
    """Say in the user's block of an HDF5 file what follows."""
    file.flush()
    digest, size = _digest(file)
    file.seek(0)
    file.write(b"%s%d\nsha256 %s\nbytes %d\n" % (NAME, FORMAT, digest.encode(), size))


def read(path: Path) -> tuple[Any, dict[str, Array]]:
    """Read back what `write` wrote.

    Args:
        path: Of any file.

    Returns:
        What it is about, and its arrays.

    Raises:
        SceneError: Not such a file, or not whole.
        OSError: It cannot be opened.
    """
    import h5py

    # Opened without waiting for somebody to write, as a pipe would.
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK)) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise SceneError("must be a file, got a device or a pipe")
        size = _check(file)
        try:
            with h5py.File(file, "r") as root:
                return _about(root), dict(_arrays(root, size))
        except (OSError, RuntimeError, KeyError, TypeError, ValueError) as error:
            if isinstance(error, SceneError):
                raise
            raise SceneError(f"must be a checkpoint, but HDF5 cannot read it: {error}") from None


def _digest(file: BinaryIO) -> tuple[str, int]:
    """SHA-256 of what follows the user's block, and how many bytes it has."""
    file.seek(BLOCK)
    found, size = hashlib.sha256(), 0
    while portion := file.read(AT_ONCE):
        found.update(portion)
        size += len(portion)
    return found.hexdigest(), size


def _check(file: BinaryIO) -> int:
    """Length of a file that is what its first block says."""
    block = file.read(BLOCK)
    if not block.startswith(NAME):
        raise SceneError("must be a checkpoint of dolfinrod, got another kind of file")
    said = HEADER.fullmatch(block)
    if said is None:
        raise SceneError("must be a whole checkpoint, got a damaged one")
    if int(said[1]) != FORMAT:
        raise SceneError(f"must be a checkpoint of format {FORMAT}, got {int(said[1])}: another version wrote it")
    size = os.fstat(file.fileno()).st_size - BLOCK
    if size != int(said[3]):
        raise SceneError(f"must be a whole checkpoint, got {size + BLOCK} of {int(said[3]) + BLOCK} bytes")
    if _digest(file) != (said[2].decode(), size):
        raise SceneError("must be a whole checkpoint, got a damaged one: its check sum is another")
    return size


def _about(root: h5py.File) -> Any:
    """What the file says of itself."""
    data = _values(root, ABOUT, np.dtype(np.uint8), MOST_ABOUT)
    try:
        return json.loads(data.tobytes().decode())
    except (ValueError, RecursionError) as error:
        raise SceneError(f"must be a checkpoint, but what it says of itself is no JSON: {error}") from None


def _arrays(root: h5py.File, size: int) -> Iterator[tuple[str, Array]]:
    """All arrays, which together are no larger than the file."""
    left, count = size, 0
    for group in root:
        if group == ABOUT:
            continue
        for name in _group(root, group):
            values = _values(root[group], name, np.dtype("<f8"), left)
            left, count = left - values.nbytes, count + 1
            if count > MOST_ARRAYS:
                raise SceneError(f"must be a checkpoint of at most {MOST_ARRAYS} arrays")
            if not np.isfinite(values).all():
                raise SceneError(f"must hold finite doubles only, got others in {group}/{name}")
            yield f"{group}/{name}", values


def _group(root: h5py.File, name: str) -> h5py.Group:
    """A group of the file itself."""
    import h5py

    found = root[name] if isinstance(root.get(name, getlink=True), h5py.HardLink) else None
    if not isinstance(found, h5py.Group):
        raise SceneError(f"must hold groups of arrays only, got something else in {name}")
    return found


def _values(parent: h5py.Group, name: str, dtype: np.dtype[Any], most: int) -> NDArray[Any]:
    """An array that lies in the file as it is."""
    import h5py

    found = parent[name] if isinstance(parent.get(name, getlink=True), h5py.HardLink) else None
    if not isinstance(found, h5py.Dataset) or found.dtype != dtype or found.shape is None:
        raise SceneError(f"must hold plain arrays of {dtype} only, got something else in {name}")
    laid_out = found.id.get_create_plist()
    plain = laid_out.get_layout() == h5py.h5d.CONTIGUOUS and laid_out.get_external_count() == 0
    if not plain or found.nbytes > most or found.id.get_storage_size() != found.nbytes:
        raise SceneError(f"must hold plain arrays only, no larger than the file, got something else in {name}")
    values: NDArray[Any] = found[()]
    return np.asarray(values)
