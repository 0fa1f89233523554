"""One of our models on one problem in a process that does nothing else, as a user's script would.

python -m verification.peers.alone PROBLEM MODEL MESH STEPS
"""

from __future__ import annotations

import subprocess
import sys
import time

from verification.peers.environment import ROOT

__all__ = ["cold", "main"]


def main(problem: str, own: int, mesh: int, steps: int) -> None:
    """Solve once.

    Args:
        problem: Its name.
        own: Number of our model.
        mesh: Number of its mesh.
        steps: Of the load.
    """
    from verification.peers.rodours import ROD_OURS, posed
    from verification.peers.rods import RODS

    chosen = next(p for p in RODS if p.name == problem)
    model, n = ROD_OURS[own].meshes[mesh]
    model.solve(posed(chosen, ROD_OURS[own].taker.assumes, steps), n)


def cold(problem: str, own: int, mesh: int, steps: int) -> float | None:
    """Seconds of such a process, compiled forms at hand; None where it fails [s]."""
    words = (problem, f"{own}", f"{mesh}", f"{steps}")
    command = [sys.executable, "-m", "verification.peers.alone", *words]
    started = time.perf_counter()
    ended = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    return time.perf_counter() - started if ended.returncode == 0 else None


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
