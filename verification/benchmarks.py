"""Problems of which the fewest load steps count, with their limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dolfinrod.scene import Clamp, PointForce, Scene, Section
from verification.case import Case, Pose
from verification.cases import bend45, elastica, follower, helix, rollup
from verification.references import Reference

__all__ = ["BENCHMARKS", "Benchmark"]

# Post-buckling of the peers' table: EI = L = 1, EA = 10⁴ without shear, P = 1.5 π²/4 and 10⁻³ P across.
POSTBUCKLED = (0.3632844440, 0.7885710075, 0.0)


@dataclass(frozen=True)
class Benchmark:
    """A problem and its limits.

    Args:
        case: With a reference.
        elements: Of the continuum model.
        discrete: Elements of the discrete one.
        peer: Name of the problem in the peers' table; empty: they were not tried on it.
        most_steps: Allowed to the continuum model; None: no limit.
        most_iterations: Allowed in total, failed attempts included.
    """

    case: Case
    elements: int
    discrete: int
    peer: str = ""
    most_steps: int | None = None
    most_iterations: int | None = None


def postbuckled() -> Case:
    """Column at 1.5 P_cr under a lateral load of 10⁻³ P; the path ends on the buckled branch."""

    def scene(pose: Pose) -> Scene:
        P = 1.5 * np.pi**2 / 4
        section = Section(EA=1e4, GJ=1.0 / 1.3, EI=1.0, rigid={"shear"})
        load = PointForce(pose.vector(-P, 1e-3 * P), at="end")
        return Scene(rods=[elastica.straight(section, pose)], supports=[Clamp(at="start")], loads=[load])

    return Case(
        name="postbuckled",
        title="Column at 1.5 P_cr, lateral load 10⁻³ P",
        family="postbuckling",
        scene=scene,
        reference=Reference(
            id="P4",
            value=POSTBUCKLED,
            method="as measured for the peers; three of their solvers agree",
            source="design/peers.md, problem P4, EA = 10⁴, GA infinite",
            digits_trusted=9,
            agreement=1e-9,
        ),
        length=1.0,
    )


BENCHMARKS = (
    Benchmark(elastica.inextensible(10.0), 16, 40, "P1", most_steps=1),
    Benchmark(rollup.rolled(1.0), 16, 40, "P2a", most_steps=1),
    Benchmark(rollup.rolled(2.0), 16, 40, "P2b", most_steps=1),
    Benchmark(rollup.rolled(5.0), 40, 100, most_steps=1),
    Benchmark(rollup.rolled(10.0), 80, 200, most_steps=3, most_iterations=60),
    Benchmark(bend45.bend(600.0), 16, 40, "P3", most_steps=1),
    Benchmark(bend45.bend(600.0, kirchhoff=True), 16, 40, "P3", most_steps=1),
    Benchmark(postbuckled(), 16, 40, "P4"),
    Benchmark(elastica.shear_rigid(10.0, 2000.0), 16, 40, "P6", most_steps=1),
    Benchmark(follower.inextensible(20.0), 16, 40, most_steps=1),
    Benchmark(helix.wound(1.0), 80, 400, most_steps=40, most_iterations=300),
    Benchmark(helix.wound(1.0, kirchhoff=True), 80, 400, most_steps=40, most_iterations=300),
)
