"""xara: geometrically exact frame elements of two to five nodes, in space.

ExactFrame (Simo's and Antman's rod: stretches and shears) with an ElasticFrame section, Newton's method, load control;
motion by Newmark's average acceleration. xara's documentation, "Frame Elements: ExactFrame", "ElasticFrame" and
"Analysis". Nodes within an element lie on its chord: those of more than two nodes suppose a straight reference.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import xara

from verification.peers.rodshape import equal, nodes

__all__ = ["POSED"]

# Largest displacement or rotation of an iteration at which it ends, over the length, and the iterations allowed.
TOLERANCE, ITERATIONS = 1e-10, 40


def divided(problem: dict[str, Any], n: int, order: int, inertia: dict[str, float]) -> Any:
    """Nodes and equal elements of a rod, stress free in the x-y plane."""
    model = xara.Model(ndm=3, ndf=6)
    ends = nodes(problem["length"], problem["angle"], equal(n))
    model.node(1, (0.0, 0.0, 0.0))
    for i, ((x_0, y_0, _), (x_1, y_1, _)) in enumerate(pairwise(ends)):
        for k in range(1, order + 1):
            x, y = x_0 + (x_1 - x_0) * k / order, y_0 + (y_1 - y_0) * k / order
            model.node(i * order + k + 1, (x, y, 0.0))
    # A section of area 1 has E = EA and G = GA.
    E, G = problem["EA"], problem["GA"]
    I = problem["EI"] / E
    model.section("ElasticFrame", 1, E=E, G=G, A=1.0, Ay=1.0, Az=1.0, Iy=I, Iz=I, J=problem["GJ"] / G, **inertia)
    model.geomTransf("Linear", 1, (0.0, 0.0, 1.0))
    for i in range(n):
        # A list: of a tuple nothing moves.
        places = [i * order + k + 1 for k in range(order + 1)]
        model.element("ExactFrame", i + 1, places, section=1, transform=1)
    return model


def solver(model: Any, length: float) -> None:
    """Newton's method on a banded matrix."""
    model.system("BandGeneral")
    model.numberer("RCM")
    model.constraints("Plain")
    model.test("NormDispIncr", TOLERANCE * length, ITERATIONS, 0)
    model.algorithm("Newton")


def rod(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A clamped rod under a force and a moment at its end, in equal load steps."""
    order = settings["nodes"] - 1
    last = settings["elements"] * order + 1
    model = divided(problem, settings["elements"], order, {})
    model.fix(1, (1, 1, 1, 1, 1, 1))
    model.pattern("Plain", 1, "Linear")
    model.load(last, (*problem["force"], *problem["moment"]), pattern=1)
    solver(model, problem["length"])
    model.integrator("LoadControl", 1.0 / settings["steps"])
    model.analysis("Static")
    ((x, y, _),) = nodes(problem["length"], problem["angle"], (1.0,))

    def solve() -> list[list[float]]:
        if model.analyze(settings["steps"]) != 0:
            raise ArithmeticError(f"Newton's method failed at {model.getTime():g} of the load")
        u, v, w = model.nodeDisp(last)[:3]
        return [[x + u, y + v, w]]

    return solve


POSED = {"rod": rod}
