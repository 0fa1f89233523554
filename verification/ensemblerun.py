"""An ensemble on the ranks that mpirun started: its time by the clock and that of each run, as JSON.

python -m verification.ensemblerun RUNS STEPS
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from tempfile import TemporaryDirectory
from time import perf_counter

from mpi4py import MPI

from dolfinrod.groove import Scenario, ensemble
from dolfinrod.groove.precompile import BLINK

__all__ = ["main"]

# Of a bundle: small enough for a report, long enough that processes do not count.
FIBRES, ELEMENTS = 3, 20


def main(runs: int, steps: int) -> None:
    """Solve, and print on the first rank."""
    comm = MPI.COMM_WORLD
    # Kernels are loaded before the clock runs.
    BLINK.run("discrete")
    brief = replace(Scenario(), fibres=FIBRES, elements=ELEMENTS, t_end=1e-6 * steps, output=1e-6 * steps)
    with TemporaryDirectory() as own:
        folder = comm.bcast(own)
        comm.Barrier()
        began = perf_counter()
        found = ensemble(brief, folder=folder, seeds=range(runs), comm=comm)
        seconds = comm.allreduce(perf_counter() - began, MPI.MAX)
        comm.Barrier()
    if comm.rank == 0:
        sys.stdout.write(json.dumps({"seconds": seconds, "each": [run.seconds for run in found.runs]}) + "\n")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
