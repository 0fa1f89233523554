"""What an iteration costs and where its time goes, in a process of its own; says it as a line of JSON.

python -m verification.limitrun MODEL ELEMENTS DEGREE REPEATS SPANS

MODEL is "planar" or "spatial" of the continuum, or "discrete". SPANS are those of a beam over as many supports; 0: the
rod is a cantilever. Times are those of the processor.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from time import process_time
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg import solve_banded

from dolfinrod.scene import Clamp, LineForce, Pin, Planar, Spatial
from verification.bundlerun import Watch, memory
from verification.case import UPRIGHT
from verification.cases import elastica

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene

    Array = NDArray[np.float64]

__all__ = ["Iterations", "against_banded", "main"]

# Methods by what they do in an iteration; the last one is the iteration, and what is not in the others.
CONTINUUM = (
    ("assembly", "dolfinrod.continuum.backend", "BoundForm", "add_matrix add_vector"),
    ("factors", "dolfinrod.continuum.banded", "BandedLU", "setUp apply"),
    ("python", "dolfinrod.continuum.newton", "Newton", "_residual _tangent _limit _test"),
    ("petsc", "dolfinrod.continuum.newton", "Newton", "_run"),
)
DISCRETE = (
    ("assembly", "discrete.corotation", "ChordElement", "respond"),
    ("assembly", "discrete.assembly", "BandedSystem", "_fill"),
    ("factors", "discrete.assembly", "BandedSystem", "solve"),
    ("python", "discrete.equilibrium", "Equilibrium", "_iterate"),
)
# Of solve_banded; the least counts.
REPEATS = 20


class Iterations:
    """Seconds that iterations spend, by what they are spent on; nothing between them counts.

    Args:
        parts: As above.

    Attributes:
        seconds: By name, of all iterations so far [s].
    """

    def __init__(self, parts: tuple[tuple[str, str, str, str], ...]) -> None:
        self._watch = Watch()
        for part in parts:
            self._watch.time(*part)
        self.seconds = dict.fromkeys(self._watch.seconds, 0.0)
        _, module, kind, method = parts[-1]
        owner = getattr(import_module(module), kind)
        setattr(owner, method, self._counted(getattr(owner, method)))

    def _counted(self, call: Callable[..., Any]) -> Callable[..., Any]:
        def counted(*args: Any) -> Any:
            before = dict(self._watch.seconds)
            try:
                return call(*args)
            finally:
                for name, seconds in self._watch.seconds.items():
                    self.seconds[name] += seconds - before[name]

        return counted


class System:
    """The last linear system of a solve as a band.

    Attributes:
        band: Diagonals from the uppermost to the lowest, shape (2 half + 1, n).
        half: Half the bandwidth.
    """

    band: Array
    half: int

    def keep_continuum(self) -> None:
        """Keep what PETSc has LAPACK factorise from now on."""
        kind = import_module("dolfinrod.continuum.banded").BandedLU
        right = kind.setUp

        def kept(factors: Any, pc: Any) -> None:
            pointers, columns, values = pc.getOperators()[1].getValuesCSR()
            place = np.argsort(factors._band.order)
            rows = place[np.repeat(np.arange(len(place)), np.diff(pointers))]
            self._fill(rows[values != 0.0], place[columns][values != 0.0], values[values != 0.0])
            right(factors, pc)

        kind.setUp = kept

    def keep_discrete(self) -> None:
        """Keep what the discrete model has LAPACK factorise."""
        kind = import_module("discrete.assembly").BandedSystem
        right = kind._fill

        def kept(system: Any, tangent: Array) -> None:
            right(system, tangent)
            self.half = (len(system._band) - 1) // 3
            self.band = system._band[self.half :].copy()

        kind._fill = kept

    def _fill(self, rows: NDArray[np.int64], columns: NDArray[np.int64], values: Array) -> None:
        self.half = int(np.abs(rows - columns).max())
        self.band = np.zeros((2 * self.half + 1, rows.max() + 1))
        self.band[self.half + rows - columns, columns] = values


def against_banded(system: System) -> float:
    """Seconds that `scipy.linalg.solve_banded` takes for a system."""
    right, seconds = np.ones(system.band.shape[1]), []
    for _ in range(REPEATS):
        began = process_time()
        solve_banded((system.half, system.half), system.band, right)
        seconds.append(process_time() - began)
    return min(seconds)


def posed(scene: Scene, spans: int) -> Scene:
    """A cantilever as it is, or as a beam over supports, each span of which sags under 10 EI/L² of its own length."""
    if spans == 0:
        return scene
    pins = [Pin(at=k / spans) for k in range(1, spans + 1)]
    return replace(scene, supports=[Clamp(at="start"), *pins], loads=[LineForce((0.0, -10.0 * spans**3, 0.0))])


def main(model: str, elements: int, degree: int, repeats: int, spans: int) -> None:
    """Solve, and print."""
    discrete = model == "discrete"
    solve = import_module("discrete" if discrete else "dolfinrod.continuum").solve
    case = elastica.shear_rigid(10.0, 200.0) if discrete else elastica.slender(10.0, 200.0)
    options: dict[str, Any] = {"elements": elements}
    if not discrete:
        options |= {"degree": degree, "kinematics": Planar() if model == "planar" else Spatial()}
    scene, system = posed(case.scene(UPRIGHT), spans), System()
    found: list[dict[str, float]] = []
    iterations, before = Iterations(DISCRETE if discrete else CONTINUUM), memory()
    for _ in range(repeats + (repeats > 1)):
        began = dict(iterations.seconds)
        statistics = solve(scene, **options).statistics
        spent = {name: seconds - began[name] for name, seconds in iterations.seconds.items()}
        found.append({name: 1e3 * s / statistics.newton_iterations for name, s in spent.items()})
    quickest = min(found, key=lambda parts: sum(parts.values()))
    told: dict[str, Any] = {
        "unknowns": statistics.dofs,
        "iterations": statistics.newton_iterations,
        "memory": memory() - before,
        "petsc": 0.0,
        **quickest,
    }
    if repeats > 1:
        (system.keep_discrete if discrete else system.keep_continuum)()
        solve(scene, **options)
        told |= {"half": system.half, "banded": 1e3 * against_banded(system)}
    sys.stdout.write(json.dumps(told) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
