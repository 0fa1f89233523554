"""A bundle on the ranks that mpirun started: where it ends, time of its steps, of what ranks tell one another; JSON.

python -m verification.scalingrun ELEMENTS DEGREE FIBRES STEPS
"""

from __future__ import annotations

import json
import sys
from time import perf_counter
from typing import TYPE_CHECKING, Any

from mpi4py import MPI

import numpy as np

from dolfinrod.continuum import solve
from dolfinrod.continuum.everywhere import Everywhere
from dolfinrod.scene import Spatial
from verification.bundles import Bundle
from verification.bundlescene import bundle

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result

__all__ = ["main"]

# Messages by which a latency and a rate are measured, and how often each is sent.
SMALL, LARGE, TIMES = 8, 1 << 20, 20


class Talk:
    """What ranks tell one another about nodes: how often, how much, and how long it takes with the waiting.

    Attributes:
        calls: Exchanges.
        size: Of all that they carried [bytes].
        seconds: By the clock [s].
    """

    def __init__(self) -> None:
        self.calls, self.size, self.seconds = 0, 0, 0.0

    def listen(self, method: str) -> None:
        """Count the calls of a method of `Everywhere` from now on."""
        setattr(Everywhere, method, self._timed(getattr(Everywhere, method)))

    def _timed(self, call: Callable[..., Any]) -> Callable[..., Any]:
        def timed(*args: Any) -> Any:
            began = perf_counter()
            table = call(*args)
            self.seconds += perf_counter() - began
            self.calls += 1
            self.size += table.nbytes
            return table

        return timed


def main(elements: int, degree: int, fibres: int, steps: int) -> None:
    """Solve twice, the first for buffers and kernels alone, and print on the first rank."""
    comm = MPI.COMM_WORLD
    who = Bundle("continuum", elements, degree)
    solved(who, fibres, 1)
    talk = Talk()
    for method in ("gathered", "summed"):
        talk.listen(method)
    comm.Barrier()
    began = perf_counter()
    result = solved(who, fibres, steps)
    seconds = comm.allreduce(perf_counter() - began, MPI.MAX)
    # Who waits least waits for nobody: what is left is the exchange itself.
    told = {
        "steps": result.statistics.load_steps,
        "x": [rod.r[-1].tolist() for rod in result.rods],
        "seconds": seconds,
        "talk": comm.allreduce(talk.seconds, MPI.MIN),
        "calls": talk.calls,
        "size": talk.size,
        "latency": exchanged(comm, SMALL),
        "rate": LARGE / exchanged(comm, LARGE),
    }
    if comm.rank == 0:
        sys.stdout.write(json.dumps(told) + "\n")


def solved(who: Bundle, fibres: int, steps: int) -> Result:
    """The bundle, so many steps."""
    return solve(bundle(fibres, steps), elements=who.elements, degree=who.degree, kinematics=Spatial())


def exchanged(comm: MPI.Intracomm, size: int) -> float:
    """Least time of a sum over all ranks [s]."""
    values, least = np.zeros(size // 8), float("inf")
    for _ in range(TIMES):
        comm.Barrier()
        began = perf_counter()
        comm.Allreduce(MPI.IN_PLACE, values)
        least = min(least, perf_counter() - began)
    return float(comm.allreduce(least, MPI.MAX))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:5]))
