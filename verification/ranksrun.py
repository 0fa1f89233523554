"""One kind of scene, twice in a process: the first makes forms and buffers, the second is timed; said as JSON.

python -m verification.ranksrun KIND
"""

from __future__ import annotations

import json
import sys
from time import perf_counter

from mpi4py import MPI

from verification.rankscenes import KINDS

__all__ = ["main"]


def main(name: str) -> None:
    """Solve, and print on the first rank."""
    (kind,) = (k for k in KINDS if k.name == name)
    kind.found()
    MPI.COMM_WORLD.Barrier()
    began = perf_counter()
    found = kind.found()
    seconds = MPI.COMM_WORLD.allreduce(perf_counter() - began, MPI.MAX)
    if MPI.COMM_WORLD.rank == 0:
        sys.stdout.write(json.dumps({"found": found.tolist(), "seconds": seconds}) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
