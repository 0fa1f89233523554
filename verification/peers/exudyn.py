"""EXUDYN: cable elements of the absolute nodal coordinate formulation in motion, implicit time integration.

ObjectANCFCable and ObjectANCFCable2D (two nodes, position and slope, no shear, no twist, no rotary inertia), by the
implicit trapezoidal rule or the generalised-α method; EXUDYN's manual, "ObjectANCFCable" and "Implicit trapezoidal
rule solver".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import exudyn
from exudyn.beams import GenerateBeamElementsAlongLine
from exudyn.itemInterface import ObjectANCFCable, ObjectANCFCable2D, SensorNode

__all__ = ["POSED"]

RULES = {
    "trapezoidal": exudyn.DynamicSolverType.TrapezoidalIndex2,
    "generalised alpha": exudyn.DynamicSolverType.GeneralizedAlpha,
}
CABLES = {
    2: (ObjectANCFCable2D, [True, True, False, False]),
    3: (ObjectANCFCable, [True, True, True, False, False, False]),
}


def swing(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod pinned at one end, released from the horizontal."""
    system = exudyn.SystemContainer()
    mbs = system.AddSystem()
    # In the plane, a node has two positions and two slopes.
    kind, held = CABLES[settings["dimensions"]]
    cable = kind(massPerLength=problem["rhoA"], bendingStiffness=problem["EI"], axialStiffness=problem["EA"])
    made = GenerateBeamElementsAlongLine(
        mbs,
        [0.0, 0.0, 0.0],
        [problem["length"], 0.0, 0.0],
        settings["elements"],
        beamTemplate=cable,
        gravity=[0.0, -problem["g"], 0.0],
        groundConstraintsStart=held,
    )
    times = problem["times"]
    sensor = mbs.AddSensor(
        SensorNode(
            nodeNumber=made["nodes"][-1],
            storeInternal=True,
            writeToFile=False,
            outputVariableType=exudyn.OutputVariableType.Position,
        )
    )
    mbs.Assemble()
    options = exudyn.SimulationSettings()
    options.timeIntegration.endTime = times[-1]
    options.timeIntegration.numberOfSteps = round(times[-1] / settings["step"])
    options.solutionSettings.sensorsWritePeriod = times[0]
    options.solutionSettings.writeSolutionToFile = False
    options.displayStatistics = False
    options.timeIntegration.verboseMode = 0
    options.linearSolverType = exudyn.LinearSolverType.EigenSparse

    def solve() -> list[list[float]]:
        mbs.SolveDynamic(options, solverType=RULES[settings["rule"]])
        return [[float(c) for c in row[1:]] for row in mbs.GetSensorStoredData(sensor)[1:]]

    return solve


POSED = {"swing": swing}
