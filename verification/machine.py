"""On what the report was made."""

from __future__ import annotations

import os
import platform
import subprocess
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from dolfinrod.output import versions

__all__ = ["Machine", "this_machine"]

# What the thread count of the linear algebra is read from.
THREADS = "OMP_NUM_THREADS"


@dataclass(frozen=True)
class Machine:
    """Where and when.

    Args:
        processor: As it names itself.
        cores: Seen by this process.
        threads: Value of OMP_NUM_THREADS.
        system: Operating system.
        load: Mean number of busy processes over the last minute, this one included; above 1, times are noisy.
        date: When, in UTC.
        source: Commit of this project, and whether files differ from it; empty where git does not say.
        versions: Of Python and the packages.
    """

    processor: str
    cores: int
    threads: str
    system: str
    load: float
    date: str
    source: str = ""
    versions: dict[str, str] = field(default_factory=dict)


def this_machine() -> Machine:
    """The machine this runs on, now."""
    return Machine(
        processor=_processor(),
        cores=os.cpu_count() or 1,
        threads=os.environ.get(THREADS, "not set"),
        system=f"{_distribution()}, Linux {platform.release()}, {platform.machine()}",
        load=os.getloadavg()[0],
        date=datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        source=_source(),
        versions=versions() | _petsc(),
    )


def _source() -> str:
    """Commit of the project."""
    root = Path(__file__).parents[1]
    try:
        found = subprocess.run(
            ["git", "-C", str(root), "describe", "--always", "--dirty", "--abbrev=12"],
            capture_output=True,
            text=True,
            check=True,
        )
    except (OSError, subprocess.CalledProcessError):
        return ""
    return found.stdout.strip()


def _processor() -> str:
    """Model name of the first core."""
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _distribution() -> str:
    """Name and version of the distribution."""
    return platform.freedesktop_os_release().get("PRETTY_NAME", "Linux")


def _petsc() -> dict[str, str]:
    """Version of the PETSc library, which petsc4py's need not be."""
    from petsc4py import PETSc

    return {"petsc": ".".join(str(part) for part in PETSc.Sys.getVersion())}
