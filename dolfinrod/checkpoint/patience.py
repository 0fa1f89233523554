"""Ctrl-C that waits: inside a library that calls back into Python it would leave things half done."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["patient"]


@contextmanager
def patient() -> Iterator[None]:
    """Whoever interrupts meanwhile is heard at the end."""
    former = signal.getsignal(signal.SIGINT)
    # Only the main thread hears of signals, and only where Python handles them.
    if not callable(former) or threading.current_thread() is not threading.main_thread():
        yield
        return
    came = False

    def wait(*_: object) -> None:
        nonlocal came
        came = True

    signal.signal(signal.SIGINT, wait)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, former)
    if came:
        signal.raise_signal(signal.SIGINT)
