"""EXUDYN's beams in equilibrium: cables without shear, in the plane and in space, and geometrically exact beams.

ObjectANCFCable2D, ObjectANCFCable, ObjectBeamGeometricallyExact2D and ObjectBeamGeometricallyExact, by
the static solver in equal load steps; EXUDYN's manual, "Beams" and "Static solver".
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, sin
from typing import Any

import exudyn
from exudyn import itemInterface
from exudyn.beams import GenerateBeamElementsAlongLine

from verification.peers.rodshape import equal, nodes

__all__ = ["POSED"]

# Residual relative to the first and in itself, and iterations of a load step.
RELATIVE, ABSOLUTE, ITERATIONS = 1e-9, 1e-12, 40


def cable(problem: dict[str, Any], kind: Any) -> Any:
    """A cable that bends and stretches."""
    return kind(massPerLength=1.0, bendingStiffness=problem["EI"], axialStiffness=problem["EA"])


def exact(problem: dict[str, Any], order: int) -> Any:
    """A geometrically exact beam in the plane."""
    return itemInterface.ObjectBeamGeometricallyExact2D(
        nodeNumbers=[-1] * (order + 1),
        massPerLength=1.0,
        crossSectionInertia=1.0,
        bendingStiffness=problem["EI"],
        axialStiffness=problem["EA"],
        shearStiffness=problem["GA"],
        includeReferenceRotations=True,
    )


# How each is made for a problem, and which coordinates of its first node are held.
STRAIGHT: dict[str, tuple[Callable[[dict[str, Any]], Any], list[bool]]] = {
    "ANCF2D": (lambda p: cable(p, itemInterface.ObjectANCFCable2D), [True, True, False, True]),
    "ANCF3D": (lambda p: cable(p, itemInterface.ObjectANCFCable), [True, True, True, False, True, True]),
    "GE2D": (lambda p: exact(p, 1), [True, True, True]),
    "GE2D3": (lambda p: exact(p, 2), [True, True, True]),
}


def straight(mbs: Any, problem: dict[str, Any], element: str, n: int) -> int:
    """A straight rod clamped at its start; returns the node at its end."""
    if problem["angle"] != 0.0:
        raise ArithmeticError(f"{element} is a plane or straight element: no rod bends out of its plane")
    template, held = STRAIGHT[element]
    made = GenerateBeamElementsAlongLine(
        mbs,
        [0.0, 0.0, 0.0],
        [problem["length"], 0.0, 0.0],
        n,
        beamTemplate=template(problem),
        groundConstraintsStart=held,
    )
    return int(made["nodes"][-1])


def curved(mbs: Any, problem: dict[str, Any], n: int) -> int:
    """A rod in space of geometrically exact beams; returns the node at its end."""
    stiffness = [problem[name] for name in ("EA", "GA", "GA", "GJ", "EI", "EI")]
    section = exudyn.BeamSection()
    section.massPerLength = 1.0
    section.inertia = [[1.0 if i == j else 0.0 for j in range(3)] for i in range(3)]
    section.stiffnessMatrix = [[k if i == j else 0.0 for j in range(6)] for i, k in enumerate(stiffness)]
    made = []
    for x, y, φ in nodes(problem["length"], problem["angle"], equal(n)):
        turned = [cos(0.5 * φ), 0.0, 0.0, sin(0.5 * φ)]
        made.append(mbs.AddNode(itemInterface.NodeRigidBodyEP(referenceCoordinates=[x, y, 0.0, *turned])))
    for k in range(n):
        beam = itemInterface.ObjectBeamGeometricallyExact(
            nodeNumbers=made[k : k + 2], length=problem["length"] / n, sectionData=section
        )
        mbs.AddObject(beam)
    ground = mbs.AddMarker(itemInterface.MarkerBodyRigid(bodyNumber=mbs.AddObject(itemInterface.ObjectGround())))
    start = mbs.AddMarker(itemInterface.MarkerNodeRigid(nodeNumber=made[0]))
    mbs.AddObject(itemInterface.GenericJoint(markerNumbers=[ground, start]))
    return int(made[-1])


def rod(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A clamped rod under a force and a moment at its end, in equal load steps."""
    system = exudyn.SystemContainer()
    mbs, element, n = system.AddSystem(), settings["element"], settings["elements"]
    tip = curved(mbs, problem, n) if element == "GE3D" else straight(mbs, problem, element, n)
    if any(problem["force"]):
        marker = mbs.AddMarker(itemInterface.MarkerNodePosition(nodeNumber=tip))
        mbs.AddLoad(itemInterface.LoadForceVector(markerNumber=marker, loadVector=problem["force"]))
    if any(problem["moment"]):
        marker = mbs.AddMarker(itemInterface.MarkerNodeRigid(nodeNumber=tip))
        mbs.AddLoad(itemInterface.LoadTorqueVector(markerNumber=marker, loadVector=problem["moment"]))
    mbs.Assemble()
    options = exudyn.SimulationSettings()
    static = options.staticSolver
    static.numberOfLoadSteps, static.adaptiveStep = settings["steps"], False
    static.verboseMode, static.stepInformation, static.newton.maxIterations = 0, 0, ITERATIONS
    static.newton.relativeTolerance, static.newton.absoluteTolerance = RELATIVE, ABSOLUTE
    options.solutionSettings.writeSolutionToFile = False
    options.linearSolverType = exudyn.LinearSolverType.EigenSparse

    def solve() -> list[list[float]]:
        try:
            mbs.SolveStatic(options)
        except exudyn.SolverError as failed:
            raise ArithmeticError(str(failed)) from None
        return [[float(c) for c in mbs.GetNodeOutput(tip, exudyn.OutputVariableType.Position)]]

    return solve


POSED = {"rod": rod}
