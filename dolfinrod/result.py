"""What a solve leaves behind: arrays and records, the same from either model."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from dolfinrod.deformation import RodHistory
from dolfinrod.meetings import MeetingHistory, Meetings
from dolfinrod.scene import Dynamic
from dolfinrod.touching import ContactHistory, Touching

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from dolfinrod.scene import Scene

__all__ = [
    "ContactHistory",
    "Formulation",
    "MeetingHistory",
    "Meetings",
    "NotConverged",
    "Result",
    "RodHistory",
    "Statistics",
    "StepLog",
    "Touching",
]


@dataclass(frozen=True)
class StepLog:
    """One accepted step.

    Args:
        t: Pseudo-time (load factor), or time [s] of a motion.
        iterations: Newton iterations of the accepted attempt.
        cuts: Failed attempts before it.
        residual: Norm of the residual in units of EI/L² and EI/L.
        energy: Strain energy [J].
        stable: Whether the equilibrium is stable; None where not judged.
        unstable_directions: Independent motions that lower the energy; None where they are not counted.
    """

    t: float
    iterations: int
    cuts: int
    residual: float
    energy: float
    stable: bool | None = None
    unstable_directions: int | None = None


@dataclass(frozen=True)
class Statistics:
    """What the solve cost.

    Args:
        dofs: Unknowns in the linear system.
        load_steps: Accepted load steps.
        newton_iterations: All Newton iterations, those of failed attempts included.
        factorizations: Matrix factorisations.
        seconds_compile: Time spent on making or loading compiled forms [s].
        seconds_setup: Mesh, spaces and solver objects [s].
        seconds_solve: Load stepping, from first to last iteration [s].
        seconds_stability: Judging which equilibria are stable [s].
    """

    dofs: int
    load_steps: int
    newton_iterations: int
    factorizations: int
    seconds_compile: float = 0.0
    seconds_setup: float = 0.0
    seconds_solve: float = 0.0
    seconds_stability: float = 0.0


@dataclass(frozen=True)
class Formulation:
    """What entered the equations, so that a user sees it and a test asserts it.

    Args:
        model: "continuum" or "discrete".
        kinematics: "planar" or "spatial".
        unknowns: Name of each unknown field and its number of dofs.
        terms: Names of the terms in the balance, each present because the scene lists it.
        notes: Choices a user should know of (ignored stiffnesses, stand-in values).
    """

    model: str
    kinematics: str
    unknowns: dict[str, int]
    terms: tuple[str, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Result:
    """Everything a solve found, complete on every MPI rank.

    The ledger of a motion in time closes: the changes of `kinetic`, `strain` and `potential` since the start add up to
    `load work` + `support work` + `drag` + `damping` + `numerical`. These five are works done on the rods since the
    start, so that what damping takes is negative. A dead load counts in `potential` or in `load work`, never in both;
    `numerical` is what the time stepping itself adds or takes. Scenes with contacts store energy in `contact`, too, and
    have the works `friction` and `wall work`, of moving walls. Statics keeps `strain` alone.

    Args:
        scene: The scene that was solved.
        t: Stored pseudo-times, or times [s] of a motion, the initial state first, shape (n_t,).
        rods: One history per rod.
        converged: False in the record that `NotConverged` carries.
        log: One row per accepted step.
        energy: Ledger at the stored times, name → shape (n_t,) [J].
        statistics: Cost.
        formulation: What was in the form.
        state: The last state as the model keeps it, to start from.
        contacts: Where the rods touched surfaces, one a wall of the scene.
        meetings: Where rods touched rods, one a contact of rods in the scene.
    """

    scene: Scene
    t: NDArray[np.float64]
    rods: tuple[RodHistory, ...]
    converged: bool
    log: tuple[StepLog, ...]
    energy: dict[str, NDArray[np.float64]]
    statistics: Statistics
    formulation: Formulation
    state: dict[str, NDArray[np.float64]] = field(default_factory=dict, repr=False)
    contacts: tuple[ContactHistory, ...] = ()
    meetings: tuple[MeetingHistory, ...] = ()

    @property
    def tip(self) -> NDArray[np.float64]:
        """End of the first rod at the last stored state, shape (3,) [m]."""
        return self.rods[0].r[-1, -1]

    def write(self, folder: str | Path) -> None:
        """Leave everything in a folder, replacing what an earlier result left there.

        Tables (`rod-0.csv`, …; of contacts `contact-0-rod-0.csv`, …, among rods `meeting-0.csv`, …), series for
        ParaView (`rods.pvd`; what the rods touch: `surfaces.pvd`, `meetings.pvd`), the scene (`scene.toml`), the record
        (`result.json`) and the state (`state.npz`). Every rank may write: each file appears complete, and ranks write
        the same.

        Args:
            folder: Made where it does not exist.

        Raises:
            OSError: It cannot be written.
        """
        from dolfinrod.output import write

        write(self, Path(folder))

    @classmethod
    def load(cls, folder: str | Path, *, scene: Scene | None = None) -> Result:
        """Read back what `write` left, to the same doubles; a later solve can `start` from it.

        Args:
            folder: Where it was written.
            scene: What was solved, where a scene with functions could not be written; None: the scene of the folder.

        Returns:
            The result.

        Raises:
            SceneError: A file that is missing, damaged, foreign, or does not go with the others.
        """
        from dolfinrod.output import load

        return load(Path(folder), scene=scene)

    def plot(self, path: str | Path | None = None) -> Figure:
        """Picture of the deformed rods, the resultants along them, the way of their tips and, in time, the ledger.

        Of rods that may touch surfaces also pressures, tractions and gaps along them, and the contact forces; of rods
        that may touch one another forces and numbers of spots.

        Args:
            path: Where to save it, in the format its ending names; None: nowhere.

        Returns:
            The figure, known to no window.
        """
        from dolfinrod.output.figures import plot

        return plot(self, path)


class NotConverged(RuntimeError):  # noqa: N818 (binding public name)
    """A step that could not be taken; nothing that converged before it is lost.

    Attributes:
        result: The last converged `Result` (`converged` is False: the end was not reached).
        t: Pseudo-time or time of the last converged state.
        step: Size of the step that failed last.
        reason: Why the nonlinear solver stopped, in words.
        advice: What to try.
    """

    def __init__(self, *, result: Result, t: float, step: float, reason: str, advice: str) -> None:
        moving = isinstance(result.scene.motion, Dynamic)
        sought, unit = ("next state", " s") if moving else ("equilibrium", "")
        tried = f"beyond t = {t:.6g}{unit} (last step tried {step:.3g}{unit})"
        super().__init__(f"no {sought} found {tried}: {reason}. {advice}")
        self.result = result
        self.t = t
        self.step = step
        self.reason = reason
        self.advice = advice
