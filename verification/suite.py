"""Everything that is verified, as one record."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from verification.bundles import BundleRanks, BundleStudy
from verification.cases import CASES
from verification.checks import Check, digit_checks, order_checks
from verification.contact import ContactStudy
from verification.contactmaps import ContactCell
from verification.crosscheck import CrossCheck, crosschecks
from verification.drift import DriftStudy
from verification.explicitlimit import ExplicitLimit
from verification.frequency import FrequencyStudy
from verification.groovebench import GrooveSweep
from verification.grooveprofile import SideBySide
from verification.groovescenarioclaims import Gathered, with_claims
from verification.growth import Cost
from verification.hard import HardRow, Share, shares
from verification.hardcontact import ContactRow
from verification.hardmotion import MotionRow
from verification.laws import LawRow
from verification.machine import Machine
from verification.maps import Cell
from verification.motion import MotionStudy
from verification.onestep import OneStep
from verification.pace import Pace, PaperFibre
from verification.peers.contest import Contender
from verification.plan import headlines
from verification.ranks import RankRow
from verification.reach import Reach, reaches
from verification.rigid import TopStudy
from verification.robustness import OneStepLoads, Steps
from verification.scaling import EnsembleScaling, Scaling
from verification.speed import Speed
from verification.stability import Bracket, EigenStudy
from verification.statement import Statement, statement
from verification.twist import TwistStudy
from verification.workoff import Spent
from verification.workprecision import Study

if TYPE_CHECKING:
    from verification.shape import Shape

__all__ = ["Missed", "Report", "report"]

Trial = Bracket | EigenStudy | HardRow | OneStep | OneStepLoads | Share | Steps
Moved = BundleRanks | BundleStudy | DriftStudy | Cost | FrequencyStudy | MotionStudy | PaperFibre | RankRow | TopStudy
Shared = EnsembleScaling | Scaling
Touched = ContactCell | ContactRow | ContactStudy | GrooveSweep | SideBySide | Gathered
Missed = Trial | Moved | Shared | Touched | Cell | Check | CrossCheck | ExplicitLimit | LawRow | MotionRow | TwistStudy
# Fields of the report that are the rows of a topic, as they come.
AS_FOUND = {
    "one_step": "one step",
    "speeds": "speed",
    "laws": "law",
    "critical": "critical",
    "brackets": "bracket",
    "largest": "largest",
    "fewest": "fewest",
    "shapes": "shape",
    "limits": "explicit limit",
    "maps": "map",
    "motions": "hard motion",
    "bundles": "bundle",
    "ranks": "ranks",
    "costs": "cost",
    "tops": "rigid",
    "touching": "contact",
    "grooves": "groove",
    "beside": "side by side",
    "contact_maps": "contact map",
    "hard_contacts": "hard contact",
    "twists": "twist",
    "meetings": "meeting",
}


@dataclass(frozen=True)
class Report:
    """All that was found.

    Args:
        machine: On which.
        quick: Whether few meshes, degrees and repetitions were asked for.
        statements: The cases, as posed.
        headlines: Names of those studied in depth, one a family.
        checks: Errors, orders and digits against limits.
        one_step: Whole loads at once.
        speeds: Times against limits.
        studies: Every case by every model that poses it, on meshes from coarse to fine.
        crosschecks: Both models against each other.
        laws: Violations against bounds.
        critical: Critical loads and frequencies against references.
        brackets: Verdicts below and above critical loads.
        hard: What solvers stumble over.
        shares: Of the hard cases converged, where all of a model were asked for.
        largest: Loads taken at once.
        fewest: Load steps taken by default.
        reaches: Quickest measured runs to given errors.
        shapes: To draw.
        limits: Longest stable steps of an explicit scheme.
        maps: Outcome over step, length of the elements and rise of the load.
        motions: What schemes in time stumble over.
        moved: Motions in ever smaller steps.
        frequencies: Read off small vibrations in time.
        drifts: What a free rod keeps.
        fibres: The paper's fibre in its own steps.
        paces: Milliseconds a step.
        bundles: What more and more fibres cost, on one rank and on two, and how much quicker ranks are.
        ranks: Kinds of scenes on one rank and on two.
        costs: Of iterations, also on finer and finer meshes, and of whole processes.
        tops: Rigid bodies by each rotation integrator.
        touching: Rods on rigid surfaces on finer and finer levels.
        grooves: The fibre in the groove over steps, elements and penalty.
        beside: Both models on it, side by side.
        contact_maps: Outcome over step, penalty and length of the elements.
        hard_contacts: What contact stumbles over.
        twists: How twist is measured.
        meetings: Rods on rods on finer and finer levels.
        scenarios: Bundles in the groove: ensembles and what they show, models, mirror images, the paper's readings.
        contenders: Other people's solvers and our models on one problem.
        jobs: Units that were done at once; with more than one, times are noisier.
        spent: What the suite itself took.
    """

    machine: Machine
    quick: bool
    statements: tuple[Statement, ...]
    headlines: tuple[str, ...]
    checks: tuple[Check, ...]
    one_step: tuple[OneStep, ...]
    speeds: tuple[Speed, ...]
    studies: tuple[Study, ...]
    crosschecks: tuple[CrossCheck, ...]
    laws: tuple[LawRow, ...]
    critical: tuple[EigenStudy, ...]
    brackets: tuple[Bracket, ...]
    hard: tuple[HardRow, ...]
    shares: tuple[Share, ...]
    largest: tuple[OneStepLoads, ...]
    fewest: tuple[Steps, ...]
    reaches: tuple[Reach, ...]
    shapes: tuple[Shape, ...] = field(default=(), repr=False)
    limits: tuple[ExplicitLimit, ...] = ()
    maps: tuple[Cell, ...] = ()
    motions: tuple[MotionRow, ...] = ()
    moved: tuple[MotionStudy, ...] = ()
    frequencies: tuple[FrequencyStudy, ...] = ()
    drifts: tuple[DriftStudy, ...] = ()
    fibres: tuple[PaperFibre, ...] = ()
    paces: tuple[Pace, ...] = ()
    bundles: tuple[BundleStudy | BundleRanks | Shared, ...] = ()
    ranks: tuple[RankRow, ...] = ()
    costs: tuple[Cost, ...] = ()
    contenders: tuple[Contender, ...] = ()
    jobs: int = 1
    spent: tuple[Spent, ...] = ()
    tops: tuple[TopStudy, ...] = ()
    touching: tuple[ContactStudy, ...] = ()
    grooves: tuple[GrooveSweep, ...] = ()
    beside: tuple[SideBySide, ...] = ()
    contact_maps: tuple[ContactCell, ...] = ()
    hard_contacts: tuple[ContactRow, ...] = ()
    twists: tuple[TwistStudy, ...] = ()
    meetings: tuple[ContactStudy, ...] = ()
    scenarios: tuple[Gathered, ...] = ()

    def compile_ms(self, model: str) -> float | None:
        """What a model spent on making or loading its forms when it was first used [ms]."""
        timings = [r.timing for s in self.studies if s.model == model for r in s.records]
        return max((t.compile for t in timings if t is not None), default=None)

    @property
    def deep(self) -> tuple[Study, ...]:
        """Studies of headline cases."""
        return tuple(s for s in self.studies if s.case in self.headlines)

    @property
    def missed(self) -> tuple[Missed, ...]:
        """Numbers beyond their limits, of those that do not depend on the machine."""
        missed: list[Missed] = [row for row in self.checks if row.missed]
        kinds = (self.one_step, self.crosschecks, self.laws, self.critical, self.brackets)
        for rows in (*kinds, self.hard, self.shares, self.largest, self.limits, self.maps, self.motions):
            missed += [row for row in rows if not row.holds]
        moved: tuple[Moved, ...] = (*self.moved, *self.frequencies, *self.drifts, *self.fibres, *self.tops)
        missed += [row for row in (*moved, *self.bundles, *self.ranks, *self.costs, *self.scenarios) if not row.holds]
        touched: tuple[Touched, ...] = (*self.touching, *self.grooves, *self.beside, *self.contact_maps)
        missed += [row for row in (*touched, *self.hard_contacts, *self.meetings, *self.twists) if not row.holds]
        missed += [row for row in self.fewest if row.missed]
        return tuple(missed)


def report(rows: dict[str, Any], names: Iterable[str], machine: Machine, *, quick: bool) -> Report:
    """Put rows together.

    Args:
        rows: By topic, as `work_off` returns them.
        names: Of the cases and families asked for.
        machine: On which they were found.
        quick: How.

    Returns:
        The report.
    """
    asked = set(names)
    studies: tuple[Study, ...] = rows.get("study", ())
    deep = [s for s in studies if s.case in headlines()]
    found: tuple[HardRow, ...] = rows.get("hard", ())
    return Report(
        machine=machine,
        quick=quick,
        statements=tuple(statement(case) for case in CASES if asked & {case.name, case.family}),
        headlines=headlines(),
        checks=(*rows.get("limit", ()), *order_checks(deep), *digit_checks(studies)),
        studies=studies,
        crosschecks=crosschecks(studies, {case.name: case.length for case in CASES}),
        hard=found,
        shares=shares(found),
        reaches=reaches(studies),
        **{field: rows.get(topic, ()) for field, topic in AS_FOUND.items()},
        moved=rows.get("motion", ()),
        frequencies=rows.get("frequency", ()),
        drifts=rows.get("drift", ()),
        fibres=rows.get("paper fibre", ()),
        paces=rows.get("pace", ()),
        contenders=rows.get("peer", ()),
        scenarios=with_claims(rows.get("groove scenario", ())),
    )
