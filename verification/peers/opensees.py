"""OpenSees: two-node beam columns with corotational transformation, in space and in the plane.

elasticBeamColumn with geomTransf Corotational (stretches, no shear), Newton's method; statics by load control, motion
by Newmark's average acceleration with consistent mass; OpenSees' documentation, "Elastic Beam Column Element",
"Corotational Transformation", "LoadControl" and "Newmark Method".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from openseespy import opensees as ops

from verification.peers.rodshape import equal, nodes

__all__ = ["POSED"]

# Largest displacement or rotation of an iteration at which it ends, over the length, and the iterations allowed.
TOLERANCE, ITERATIONS = 1e-9, 20
STATIC_TOLERANCE, STATIC_ITERATIONS = 1e-11, 40


def divided(problem: dict[str, Any], n: int, dimensions: int, options: tuple[Any, ...] = ()) -> None:
    """Nodes and equal elements of a rod in the x-y plane, in two or three dimensions."""
    ops.wipe()
    ops.model("basic", "-ndm", dimensions, "-ndf", 3 * (dimensions - 1))
    places = nodes(problem["length"], problem.get("angle", 0.0), equal(n))
    for i, (x, y, _) in enumerate(places):
        ops.node(i + 1, *(x, y, 0.0)[:dimensions])
    ops.geomTransf("Corotational", 1, *((0.0, 0.0, 1.0) if dimensions == 3 else ()))
    # Area, E, G, J, I_y, I_z: a section of area 1 has E = EA.
    E = problem["EA"]
    I = problem["EI"] / E
    section = (1.0, E, E, problem["GJ"] / E, I, I) if dimensions == 3 else (1.0, E, I)
    for i in range(n):
        ops.element("elasticBeamColumn", i + 1, i + 1, i + 2, *section, 1, *options)


def solver(tolerance: float, iterations: int) -> None:
    """Newton's method on a banded matrix."""
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", tolerance, iterations)
    ops.algorithm("Newton")


def end(problem: dict[str, Any], n: int, dimensions: int) -> list[float]:
    """Where the tip is."""
    ((x, y, _),) = nodes(problem["length"], problem.get("angle", 0.0), (1.0,))
    moved = [float(ops.nodeDisp(n + 1, k + 1)) for k in range(dimensions)] + [0.0]
    return [x + moved[0], y + moved[1], moved[2]]


def rod(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A clamped rod under a force and a moment at its end, in equal load steps."""
    n, dimensions = settings["elements"], settings["dimensions"]
    divided(problem, n, dimensions)
    ops.fix(1, *[1] * (3 * (dimensions - 1)))
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    force, moment = problem["force"], problem["moment"]
    ops.load(n + 1, *((*force, *moment) if dimensions == 3 else (*force[:2], moment[2])))
    solver(STATIC_TOLERANCE * problem["length"], STATIC_ITERATIONS)
    ops.integrator("LoadControl", 1.0 / settings["steps"])
    ops.analysis("Static")

    def solve() -> list[list[float]]:
        if ops.analyze(settings["steps"]) != 0:
            raise ArithmeticError(f"Newton's method failed at {ops.getTime():g} of the load")
        return [end(problem, n, dimensions)]

    return solve


def swing(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod pinned at one end, held from twisting there, and released from the horizontal."""
    n, dimensions, length = settings["elements"], settings["dimensions"], problem["length"]
    consistent = ("-cMass",) if settings["mass"] == "consistent" else ()
    divided(problem, n, dimensions, ("-mass", problem["rhoA"], *consistent))
    ops.fix(1, *((1, 1, 1, 1, 1, 0) if dimensions == 3 else (1, 1, 0)))
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    # Weight of the elements at their ends; no moments: they fall as h².
    for i in range(n + 1):
        share = 0.5 if i in (0, n) else 1.0
        weight = -share * problem["rhoA"] * problem["g"] * length / n
        ops.load(i + 1, *((0.0, weight, 0.0, 0.0, 0.0, 0.0) if dimensions == 3 else (0.0, weight, 0.0)))
    solver(TOLERANCE * length, ITERATIONS)
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
            tip.append(end(problem, n, dimensions))
        return tip

    return solve


POSED = {"rod": rod, "swing": swing}
