"""Bundles in the groove as ensembles: the same scenario with other seeds, by `dolfinrod.groove.ensemble`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from dolfinrod.groove import Scenario, ensemble, variant
from dolfinrod.scene import Penalty

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["SEEDS", "SETTINGS", "GrooveEnsemble", "Setting", "gathered", "setting", "small"]

# Bundles of an ensemble, and of those that ask for no statistics.
SEEDS, FEW = 10, 3
# Of small bundles: fibres, elements by which theirs are longer, and the time they take to lie in the groove [s].
SMALL, COARSER, GATHERED = 3, 4, 1.5e-3
# Not fewer are judged.
QUICK_SEEDS = 2
LATERAL, INTERMEDIATE = Scenario("lateral"), Scenario("intermediate")
# As loose as fibres can be: no air, no friction, and a tension of 2 mN.
STILL = replace(
    LATERAL, air=None, wall_friction=None, fibre_friction=None, ends=replace(LATERAL.ends, tension=2e-3), t_end=1e-3
)
TWICE = Penalty(2.0 * LATERAL.law.eps_N, LATERAL.law.g_0)
DAMPED = variant(LATERAL, "damped")


@dataclass(frozen=True)
class Setting:
    """An ensemble to be solved.

    Args:
        name: By which claims know it.
        words: What it is, for people.
        scenario: But for its seed.
        seeds: How many.
        quick: Whether a quick run has it.
        tells: Whether a few small bundles tell anything of it, so that a report has them.
    """

    name: str
    words: str
    scenario: Scenario = field(repr=False)
    seeds: int = SEEDS
    quick: bool = False
    tells: bool = True

    def small(self) -> Setting:
        """The same for a report, which is to take less than half an hour."""
        return replace(self, scenario=small(self.scenario), seeds=min(self.seeds, FEW))

    def hurried(self) -> Setting:
        """The same for a quick run: a blink of two fibres and few elements, which shows that it runs, no more."""
        brief = replace(self.scenario, fibres=2, elements=12, t_end=2e-5, output=1e-5)
        return replace(self, scenario=brief, seeds=QUICK_SEEDS)


SETTINGS = (
    Setting("lateral", "lateral", LATERAL, quick=True),
    Setting("intermediate", "intermediate", INTERMEDIATE, quick=True),
    Setting("mirrored", "lateral, its mirror image", variant(LATERAL, "mirrored"), tells=False),
    Setting("L0", "lateral, friction without a moment (L0)", variant(LATERAL, "L0"), tells=False),
    Setting("L2", "lateral, core free to roll (L2)", variant(LATERAL, "L2"), tells=False),
    Setting("L2-mirrored", "L2, its mirror image", variant(variant(LATERAL, "L2"), "mirrored"), tells=False),
    Setting("pinned", "lateral, held sideways at B", variant(LATERAL, "pinned"), FEW),
    Setting("still", "lateral, no air, no friction, 2 mN", STILL, FEW),
    Setting(
        "half-elements",
        "lateral, elements half as long",
        replace(LATERAL, elements=2 * LATERAL.elements),
        tells=False,
    ),
    Setting("half-steps", "lateral, steps half as long", replace(LATERAL, dt=0.5 * LATERAL.dt), tells=False),
    Setting("twice-penalty", "lateral, penalty twice as large", replace(LATERAL, law=TWICE), tells=False),
    Setting("damped", "lateral, contact damped critically", DAMPED, tells=False),
    Setting(
        "damped-intermediate", "intermediate, contact damped critically", variant(INTERMEDIATE, "damped"), tells=False
    ),
    Setting(
        "damped-half-steps",
        "lateral, contact damped critically, steps half as long",
        replace(DAMPED, dt=0.5 * LATERAL.dt),
        tells=False,
    ),
    Setting("damped-L2", "lateral, core free to roll (L2), damped critically", variant(DAMPED, "L2"), tells=False),
)


@dataclass(frozen=True)
class GrooveEnsemble:
    """What an ensemble came to, one value a finished run.

    Args:
        name: Of the setting.
        title: What it is.
        model: That solved it.
        seeds: How many were asked for.
        crossed: Twist by crossings [turns/m].
        paired: Twist by windings of pairs, angles at the ends included [turns/m].
        wound: Pairs that wind by 0.4 turns or more, either way.
        most: Largest winding of a pair, either way [turns].
        edge: 1 where the edge fibre has crossed its neighbour ("5 crosses 4"), else 0.
        width: Of the bundle [m].
        begun: Its width at first [m].
        seconds: On the processor, of all runs [s].
        failed: Why runs ended early, in words.
    """

    name: str
    title: str
    model: str
    seeds: int
    crossed: tuple[float, ...]
    paired: tuple[float, ...]
    wound: tuple[float, ...]
    most: tuple[float, ...]
    edge: tuple[float, ...]
    width: tuple[float, ...]
    begun: float
    seconds: float
    failed: tuple[str, ...]

    @property
    def holds(self) -> bool:
        """All runs came to their ends."""
        return not self.failed

    @property
    def words(self) -> str:
        """For a list of misses."""
        return f"Bundles in the groove: {self.title}: {len(self.failed)} of {self.seeds} runs failed, {self.failed[0]}"


def small(scenario: Scenario) -> Scenario:
    """Fewer fibres on longer elements, until they lie in the groove."""
    elements, t_end = scenario.elements // COARSER, min(scenario.t_end, GATHERED)
    return replace(scenario, fibres=SMALL, elements=elements, t_end=t_end)


def setting(name: str) -> Setting:
    """The setting of that name."""
    return next(one for one in SETTINGS if one.name == name)


def gathered(one: Setting, folder: Path, model: str = "discrete") -> GrooveEnsemble:
    """Solve an ensemble.

    Args:
        one: What.
        folder: Where runs that have ended are kept, and found again.
        model: By which model.

    Returns:
        Its values; runs that failed are told, and the others count.
    """
    from mpi4py import MPI

    found = ensemble(one.scenario, folder=folder, seeds=range(one.seeds), model=model, comm=MPI.COMM_SELF)
    return GrooveEnsemble(
        name=one.name,
        title=one.words,
        model=model,
        seeds=one.seeds,
        crossed=found.values("T_crossed"),
        paired=found.values("T_pair"),
        wound=found.values("wound"),
        most=tuple(_most(run.winding) for run in found.finished),
        edge=found.values("edge_crosses"),
        width=found.values("width"),
        begun=(one.scenario.fibres - 1) * one.scenario.bundle.pitch + 2.0 * one.scenario.bundle.radius,
        seconds=sum(run.seconds for run in found.runs),
        failed=tuple(f"seed {run.seed} at {1e3 * run.t:.3g} ms: {run.failed}" for run in found.failed),
    )


def _most(winding: Sequence[Sequence[float]]) -> float:
    return max((abs(turns) for row in winding for turns in row), default=0.0)
