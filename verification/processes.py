"""Programs of the suite in processes of their own, on one rank or more: what one says as its last line of JSON."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

__all__ = ["said"]

# For ranks in containers, and for more of them than cores.
ALLOWED = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}
COLOURS = re.compile(r"\x1b\[[0-9;]*m")
# Longest run that is waited for [s].
PATIENCE = 4 * 3600.0


def said(module: str, words: Sequence[str | int], ranks: int = 1) -> dict[str, Any]:
    """Run `python -m module words...`.

    Args:
        module: Such as "verification.bundlerun".
        words: Its arguments.
        ranks: On so many.

    Returns:
        What it says; "failure" where it has nothing to say.
    """
    program = [sys.executable, "-m", module, *map(str, words)]
    root = str(Path(__file__).parents[1])
    env = os.environ | {"PYTHONPATH": os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])}
    if ranks > 1:
        # What an outer mpirun told its ranks is not for these.
        env = {name: value for name, value in env.items() if not name.startswith(("OMPI_", "PMIX_"))} | ALLOWED
        launch = ["mpirun", "--bind-to", "none", "--oversubscribe", "-n", str(ranks)]
        program = [*launch, sys.executable, "-m", "mpi4py", *program[1:]]
    try:
        done = subprocess.run(program, env=env, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return {"failure": f"stopped after {PATIENCE:g} s"}
    if done.returncode != 0:
        return {"failure": (done.stderr.strip().splitlines() or ["no word"])[-1]}
    return _record(done.stdout)


def _record(text: str) -> dict[str, Any]:
    """The last line that is one; mpirun puts codes of colours around what ranks print."""
    lines = [line for line in COLOURS.sub("", text).splitlines() if line.startswith("{")]
    return dict(json.loads(lines[-1])) if lines else {"failure": "no word"}
