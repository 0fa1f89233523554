"""Loops over points of rods, compiled by Numba where they are called first: who has no such points does not wait."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, update_wrapper
from hashlib import sha256
from pathlib import Path
from types import FunctionType
from typing import Any, TypeVar, cast

__all__ = ["compiled"]

# As arrays do: x/0 is infinite or no number, and an iteration that goes astray says so itself.
DIVISION = "numpy"

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


def compiled(function: Kernel) -> Kernel:
    """The same function as a kernel; it may call others of these, and use numbers of its own module.

    Args:
        function: Of numbers and arrays.

    Returns:
        What is compiled at its first call, once a machine.
    """
    return cast(Kernel, _Compiled(cast(FunctionType, function)))


class _Compiled:
    """A function that is compiled when it is needed, after those that it calls."""

    def __init__(self, function: FunctionType) -> None:
        self._function = function
        update_wrapper(self, function)

    def __call__(self, *args: Any) -> Any:
        try:
            return self._kernel(*args)
        except SystemError as error:
            # Ctrl-C while Numba makes arrays of an answer: Python finds the interruption beside it, once or more often.
            first: BaseException = error
            while first.__cause__ is not None:
                first = first.__cause__
            if isinstance(first, KeyboardInterrupt):
                raise first from None
            raise

    @cached_property
    def _called(self) -> dict[str, _Compiled]:
        known = self._function.__globals__
        return {
            name: known[name] for name in self._function.__code__.co_names if isinstance(known.get(name), _Compiled)
        }

    @cached_property
    def _sources(self) -> frozenset[Path]:
        own = Path(self._function.__code__.co_filename)
        return frozenset({own, Path(__file__)}).union(*(one._sources for one in self._called.values()))

    def _built(self) -> FunctionType:
        own = self._function
        inner = {name: one._inner for name, one in self._called.items()}
        return FunctionType(own.__code__, {**own.__globals__, **inner}, own.__name__)

    @cached_property
    def _inner(self) -> Callable[..., Any]:
        """What others call: part of what is kept of them."""
        from numba import njit

        return cast(Callable[..., Any], njit(error_model=DIVISION)(self._built()))

    @cached_property
    def _kernel(self) -> Callable[..., Any]:
        from numba import njit

        function, own = self._built(), self._function
        # Numba keeps what it compiled by this name and renews it with the module alone, not with those that it calls.
        stamp = sha256(b"".join(path.read_bytes() for path in sorted(self._sources))).hexdigest()[:16]
        function.__qualname__, function.__module__ = f"{own.__qualname__}_{stamp}", own.__module__
        return cast(Callable[..., Any], njit(cache=True, error_model=DIVISION)(function))
