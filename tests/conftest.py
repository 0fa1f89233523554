"""What every test shares: the same examples, one voice and an orderly end on any number of ranks."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import hypothesis
import pytest

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm

TESTS = Path(__file__).parent


def world() -> Intracomm | None:
    """World communicator where mpi4py is loaded (`python -m mpi4py` loads it), else None: no test must load it."""
    if "mpi4py" not in sys.modules:
        return None
    from mpi4py import MPI

    return MPI.COMM_WORLD


def speaks() -> bool:
    """Whether this rank reports passing tests: one does, and every rank reports its failures."""
    comm = world()
    return comm is None or comm.rank == 0


def pytest_configure(config: pytest.Config) -> None:
    """Deterministic examples, since ranks that drew different ones would wait for each other for ever."""
    hypothesis.settings.register_profile("same on every rank", derandomize=True, deadline=None)
    hypothesis.settings.load_profile("same on every rank")
    if not speaks():
        config.option.verbose = -2


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Scenes and the discrete model know nothing of ranks: on several, each would only do the same work again."""
    for item in items:
        if item.path.is_relative_to(TESTS / "scene") or item.path.is_relative_to(TESTS / "discrete"):
            item.add_marker(pytest.mark.serial)


def pytest_unconfigure() -> None:
    """Leave together: a rank that exits with failures ends the others, whose report would be cut."""
    comm = world()
    if comm is not None:
        comm.barrier()


@pytest.hookimpl(tryfirst=True)
def pytest_report_teststatus(report: pytest.TestReport) -> tuple[str, str, str] | None:
    """Nothing to print for what passes on a silent rank."""
    if speaks() or report.failed:
        return None
    return report.outcome, "", ""


@pytest.fixture(autouse=True, scope="module")
def collective_teardown() -> Iterator[None]:
    """Free PETSc objects together: their destructors are collective, Python's garbage collector is not."""
    comm = world()
    if comm is None or comm.size == 1:
        yield
        return
    gc.disable()
    yield
    gc.collect()
    comm.barrier()


@pytest.fixture
def shared_path(tmp_path: Path) -> Path:
    """Temporary folder of the test, the same one (rank 0's) on every rank."""
    comm = world()
    return tmp_path if comm is None else comm.bcast(tmp_path, root=0)
