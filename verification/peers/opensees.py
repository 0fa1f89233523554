"""OpenSees: two-node beam columns with corotational transformation in space, Newmark's average acceleration.

elasticBeamColumn with geomTransf Corotational (stretches, no shear), consistent mass, Newton's method; OpenSees'
documentation, "Elastic Beam Column Element", "Corotational Transformation" and "Newmark Method".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from openseespy import opensees as ops

__all__ = ["POSED"]

# Largest displacement or rotation of an iteration at which it ends [m, rad], and the iterations allowed.
TOLERANCE, ITERATIONS = 1e-9, 20


def hung(problem: dict[str, Any], n: int, mass: str) -> None:
    """A rod pinned at one end and held from twisting there, with its weight on it."""
    length = problem["length"]
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i in range(n + 1):
        ops.node(i + 1, i * length / n, 0.0, 0.0)
    ops.fix(1, 1, 1, 1, 1, 1, 0)
    ops.geomTransf("Corotational", 1, 0.0, 0.0, 1.0)
    # Area, E, G, J, I_y, I_z: a section of area 1 has E = EA.
    I = problem["EI"] / problem["EA"]
    section = (1.0, problem["EA"], problem["EA"], problem["GJ"] / problem["EA"], I, I)
    inertia = ("-mass", problem["rhoA"], *(("-cMass",) if mass == "consistent" else ()))
    for i in range(n):
        ops.element("elasticBeamColumn", i + 1, i + 1, i + 2, *section, 1, *inertia)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    # Weight of the elements at their ends; no moments: they fall as h².
    for i in range(n + 1):
        share = 0.5 if i in (0, n) else 1.0
        ops.load(i + 1, 0.0, -share * problem["rhoA"] * problem["g"] * length / n, 0.0, 0.0, 0.0, 0.0)


def swing(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod pinned at one end, released from the horizontal."""
    n, length = settings["elements"], problem["length"]
    hung(problem, n, settings["mass"])
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", TOLERANCE, ITERATIONS)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")

    def solve() -> list[list[float]]:
        tip: list[list[float]] = []
        done = 0
        for until in problem["times"]:
            steps = round(until / settings["step"])
            if ops.analyze(steps - done, settings["step"]) != 0:
                raise ArithmeticError(f"Newton's method failed at t = {ops.getTime():g} s")
            done = steps
            x, y, z = (float(ops.nodeDisp(n + 1, k)) for k in (1, 2, 3))
            tip.append([length + x, y, z])
        return tip

    return solve


POSED = {"swing": swing}
