"""The text of a file that may be anything: read in bounded time and memory."""

from __future__ import annotations

import os
import select
from pathlib import Path

from dolfinrod.scene.errors import SceneError

__all__ = ["text"]

# Far beyond any scene, and read within seconds: tomllib's time grows with the square of the names in a dotted key.
MOST_BYTES = 4_000_000
AT_ONCE = 1 << 16
# What a pipe may keep a reader waiting [s].
PATIENCE = 3.0


def text(path: str | Path) -> str:
    """A file's text in UTF-8.

    Args:
        path: Of anything that can be opened, a pipe included.

    Returns:
        Its text, without the byte order mark that some editors put first.

    Raises:
        SceneError: Too long, not UTF-8, or nothing comes out of it.
        OSError: It cannot be read.
    """
    data = _bytes(Path(path))
    if len(data) > MOST_BYTES:
        raise SceneError(f"a scene must be a file of at most {MOST_BYTES} bytes")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SceneError(f"a scene must be text in UTF-8: {error}") from None


def _bytes(path: Path) -> bytes:
    """What the file holds, at most one byte beyond the limit and a portion."""
    data = b""
    with open(path, "rb", buffering=0, opener=_at_once) as file:
        ready = select.poll()
        ready.register(file, select.POLLIN)
        while len(data) <= MOST_BYTES:
            if not ready.poll(1000 * PATIENCE):
                raise SceneError(f"a scene must be a file, but nothing came out of this one for {PATIENCE:g} s")
            portion = file.read(AT_ONCE)
            if portion == b"":
                break
            data += portion or b""
    return data


def _at_once(path: str, flags: int) -> int:
    """Open without waiting for somebody to write, as a pipe would."""
    return os.open(path, flags | os.O_NONBLOCK)
