"""A bundle of fibres in a pneumatic groove: all that the paper gives and all that it leaves open, as one record."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from dolfinrod.groove.air import LineSink
from dolfinrod.groove.bundle import Bundle
from dolfinrod.groove.core import AnyCore, FixedCore, RollingCore
from dolfinrod.groove.ends import MOST_FIBRES, Ends
from dolfinrod.groove.flow import check, flowing
from dolfinrod.groove.limits import known, limited, whole
from dolfinrod.groove.pressing import Pressing
from dolfinrod.groove.roller import refuse_straight, unrolled
from dolfinrod.groove.sections import KINDS, CrossSection
from dolfinrod.scene import (
    Air,
    Contact,
    Coulomb,
    CreepingCoulomb,
    Dynamic,
    Penalty,
    RodContact,
    Scene,
    SceneError,
    SmoothPenalty,
    WallMotion,
)
from dolfinrod.scene.errors import quoted
from dolfinrod.scene.quantity import assign

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from dolfinrod.result import Result, StepLog

    Array = NDArray[np.float64]

__all__ = ["MODELS", "Scenario"]

MODELS = ("continuum", "discrete")
# Elements of degree 3 resolve as much as so many of the paper's.
COARSER, DEGREE = 4, 3
PARTS: dict[str, tuple[type, ...]] = {
    "groove": (CrossSection, type(None)),
    "bundle": (Bundle,),
    "ends": (Ends,),
    "core": (FixedCore, RollingCore, type(None)),
    "air": (LineSink, type(None)),
    "pressing": (Pressing, type(None)),
    "law": (Penalty, SmoothPenalty),
    "wall_friction": (Coulomb, CreepingCoulomb, type(None)),
    "fibre_friction": (Coulomb, CreepingCoulomb, type(None)),
    "fibres_touch": (bool,),
    "mirrored": (bool,),
}


@dataclass(frozen=True)
class Scenario:
    """Fibres that air and walls gather in a groove, X along the machine, Y out of the roller, Z across.

    Marks say where a value comes from: [P] the paper (Lyu, Cheng & Xu, CMES 127(2), 2021), [L] the literature, [C]
    computed from these, [I] our own assumption. The paper gives no section of the groove, no air, no ends of the
    fibres, no core and no contact between fibres: all that is [I] is a model of ours, to be varied, not the paper's.

    Args:
        kind: "lateral", "intermediate" or "lateral_steep" [P: the first two; I: their sections].
        fibres: How many, 1 to 200; 5 [P, Fig. 7].
        seed: Of the noise, 0 to 2³² − 1.
        groove: The section; None: that of the kind [I].
        bundle: The fibres as they enter [P, I].
        ends: What holds them at A and B [I].
        core: A cylinder in the middle: at rest [P, as "central cylinder"; its size I], rolling [I], or None.
        air: The flow, of air at 20 °C; None: none, as in the equations of the paper [L, I].
        pressing: What of the suction presses fibres onto the walls, in addition; None: nothing [I], as in the paper.
        roller: Radius of the roller around which the groove goes, 5e-3 to 1 m; None: it is unrolled and straight [I]; a
            roller of 50 mm has 0.025 m. Then there is no core, no tail, no speed, and fibres are free at B.
        law: How walls, core and fibres push back; Penalty.tight() [I], the paper's numbers in `paper`.
        wall_friction: Of fibres and a rolling core on the groove; Coulomb(0.64) [P], 0.1 to 0.9 make sense.
        fibre_friction: Of fibres on fibres and on the core; Coulomb(0.3) [I], no source for ramie was found.
        fibres_touch: Whether fibres touch fibres; the paper has no such contact.
        mirrored: Whether left is right: groove, fibres with their noise, core and air.
        t_end: Time that is followed, 1e-6 to 10 s; 6 ms [I], fibres gather in less than one.
        dt: Time step, 1e-9 to 1e-3 s; 1e-6 [P, unit I].
        output: Time between stored states, from dt on; 0.1 ms [I].
        rest: Speed below which fibres have gathered, which ends the time, 1e-6 to 100 m/s; 0.3 [I]; None: they are
            followed until t_end, as they are where ends move.
        elements: Of a fibre in the discrete model, 2 to 10 000; 80 of 0.5 mm [P, I: the paper has 200 of 0.5 mm in
            40 mm]. The continuum model takes a quarter as many of degree 3.

    Raises:
        SceneError: A value that is none of these.
    """

    kind: str = "lateral"
    fibres: int = 5
    seed: int = 0
    groove: CrossSection | None = None
    bundle: Bundle = field(default_factory=Bundle)
    ends: Ends = field(default_factory=Ends)
    core: AnyCore | None = field(default_factory=FixedCore)
    air: LineSink | None = field(default_factory=LineSink)
    pressing: Pressing | None = None
    roller: float | None = None
    law: Penalty | SmoothPenalty = field(default_factory=Penalty.tight)
    wall_friction: Coulomb | CreepingCoulomb | None = field(default_factory=lambda: Coulomb(0.64))
    fibre_friction: Coulomb | CreepingCoulomb | None = field(default_factory=lambda: Coulomb(0.3))
    fibres_touch: bool = True
    mirrored: bool = False
    t_end: float = 6e-3
    dt: float = 1e-6
    output: float = 1e-4
    rest: float | None = 0.3
    elements: int = 80

    def __post_init__(self) -> None:
        for name, kinds in PARTS.items():
            if not isinstance(getattr(self, name), kinds):
                listed = ", ".join("None" if kind is type(None) else kind.__name__ for kind in kinds)
                given = quoted(getattr(self, name))
                raise SceneError(f"must be one of {listed}, got {given}", field=f"Scenario.{name}")
        dt = limited(self.dt, "Scenario.dt", "s", 1e-9, 1e-3)
        assign(
            self,
            kind=known(self.kind, "Scenario.kind", KINDS),
            roller=None if self.roller is None else limited(self.roller, "Scenario.roller", "m", 5e-3, 1.0),
            fibres=whole(self.fibres, "Scenario.fibres", 1, MOST_FIBRES),
            seed=whole(self.seed, "Scenario.seed", 0, 2**32 - 1),
            t_end=limited(self.t_end, "Scenario.t_end", "s", 1e-6, 10.0),
            dt=dt,
            output=limited(self.output, "Scenario.output", "s", dt, 10.0),
            rest=None if self.rest is None else limited(self.rest, "Scenario.rest", "m/s", 1e-6, 100.0),
            elements=whole(self.elements, "Scenario.elements", 2, 10_000),
        )
        self.ends.check(self.fibres)
        check(self)
        refuse_straight(self)
        if isinstance(self.core, FixedCore):
            self.section.seat(self.core.radius)

    @classmethod
    def paper(cls, reading: str = "SI", mesh: str = "zone", kind: str = "lateral") -> Scenario:
        """What the paper prints, with nothing added that it does not name: see `dolfinrod.groove.paper`."""
        from dolfinrod.groove.paper import as_printed

        return as_printed(reading, mesh, kind)

    @property
    def section(self) -> CrossSection:
        """Of the groove."""
        return CrossSection.of(self.kind) if self.groove is None else self.groove

    def unrolled(self, r: Array) -> Array:
        """Points in space as those of the straight groove, X along it, Y out of it, Z across, shape (n, 3) [m]."""
        return r if self.roller is None else unrolled(r, self.roller)

    def scene(self) -> Scene:
        """The scenario as a problem that either model solves: fibres first, a rolling core last."""
        starts = self.bundle.starts(self.fibres, self.seed, self.kind)
        if self.mirrored:
            starts[:, 1] *= -1.0
        rods, core, advance = self.bundle.rods(starts, self.roller), self.core, self.ends.speed * self.t_end
        supports, rest = self.ends.supports(self.fibres, self.bundle, self.t_end), self.rest
        if self.ends.speed:
            rest = None
        if isinstance(core, RollingCore):
            rods += (core.rod(self.section, self.kind, self.bundle, self.law.g_0, mirrored=self.mirrored),)
            supports += core.supports(self.fibres, self.bundle, advance)
        return Scene(
            rods=rods,
            supports=supports,
            loads=self.ends.loads(self.fibres, self.bundle.length / self.roller if self.roller else 0.0),
            contacts=self._contacts(),
            air=None if self.air is None else Air(flowing(self, self.air)),
            motion=Dynamic(self.t_end, self.dt, output=min(self.output, self.t_end), rest=rest),
            velocities=self.ends.velocities(),
        )

    def run(
        self,
        model: str = "continuum",
        *,
        elements: int | None = None,
        progress: Callable[[StepLog, float], None] | None = None,
        checkpoint: str | os.PathLike[str] | None = None,
    ) -> Result:
        """Solve it, on this process alone.

        Args:
            model: "continuum" or "discrete".
            elements: Of a fibre, of degree 3 in the continuum model; None: what the scenario says.
            progress: Called with each accepted step and t_end.
            checkpoint: File that the run is kept in and goes on from.

        Returns:
            The states at the output times.

        Raises:
            SceneError: It cannot be posed or solved as given.
            NotConverged: A step could not be taken.
        """
        known(model, "model", MODELS)
        coarser = COARSER if model == "continuum" else 1
        each = max(1, self.elements // coarser) if elements is None else whole(elements, "elements", 1, 10_000)
        # A rigid cylinder is straight in a single element.
        counts = [each] * self.fibres + [1] * isinstance(self.core, RollingCore)
        if model == "discrete":
            from discrete import solve as solve_discrete

            return solve_discrete(self.scene(), elements=counts, progress=progress, checkpoint=checkpoint)
        from mpi4py import MPI

        from dolfinrod.continuum import solve

        alone = MPI.COMM_SELF
        return solve(self.scene(), elements=counts, degree=DEGREE, comm=alone, progress=progress, checkpoint=checkpoint)

    def _contacts(self) -> tuple[Contact | RodContact, ...]:
        """Walls, then a core at rest, then fibres with one another and with a core that rolls."""
        motion = WallMotion(velocity=(self.ends.speed, 0.0, 0.0)) if self.ends.speed else None
        found: list[Contact | RodContact] = [
            Contact(face, self.law, self.wall_friction)
            for face in self.section.surfaces(motion, mirrored=self.mirrored, roller=self.roller)
        ]
        if isinstance(self.core, FixedCore):
            cylinder = self.core.surface(self.section, motion, mirrored=self.mirrored)
            found.append(Contact(cylinder, self.law, self.fibre_friction))
        if self.fibres_touch and (self.fibres > 1 or isinstance(self.core, RollingCore)):
            if isinstance(self.fibre_friction, CreepingCoulomb):
                raise SceneError("must be Coulomb or None where fibres touch", field="Scenario.fibre_friction")
            found.append(RodContact(self.law, self.fibre_friction))
        return tuple(found)
