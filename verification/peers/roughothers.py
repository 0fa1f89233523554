"""Other people's solvers on rough surfaces: who has friction of rods with them, and why the rest do not take part."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from verification.peers.contest import Contender, Measured, Taker, contest
from verification.peers.conversation import ask
from verification.peers.environment import ABSENT, Environment

if TYPE_CHECKING:
    from verification.peers.rough import RoughProblem

__all__ = ["ROUGH_OTHERS", "RoughOther", "rough_others_measured"]

PLANE, CAPSTAN = "plane", "capstan"
# Seconds after which a motion is not repeated any more.
BUDGET = 1.0


@dataclass(frozen=True)
class RoughOther:
    """Somebody else's solver.

    Args:
        taker: For the table.
        module: Adapter in this package.
        package: As it is installed.
        sweeps: Elements and steps a second, one pair a setting, by what is posed; the quick run takes the first.
        without: Why it does not take part, by what is posed.
    """

    taker: Taker
    module: str = ""
    package: str = ""
    sweeps: Mapping[str, tuple[tuple[int, int], ...]] = field(default_factory=dict)
    without: Mapping[str, str] = field(default_factory=dict)


def unable(name: str, plane: str, capstan: str) -> RoughOther:
    """Somebody who does not take part, with the reasons."""
    return RoughOther(Taker(name, False, True, "–", "–", "sheared"), without={PLANE: plane, CAPSTAN: capstan})


PAIRS = "its contact elements join nodes or a beam and a node; no rough plane or drum for a beam"
ROUGH_OTHERS = (
    RoughOther(
        Taker("PyElastica", False, False, "position Verlet, explicit", "staggered Cosserat rod", "sheared", exact=True),
        "elasticarough",
        "pyelastica",
        {PLANE: ((4, 10000), (4, 2000), (4, 40000)), CAPSTAN: ((16, 4000), (8, 4000), (32, 8000))},
    ),
    RoughOther(
        Taker("MuJoCo", False, True, "implicit in velocity, soft contacts", "cable: chain of rigid bodies", "rigid"),
        "mujocorough",
        "mujoco",
        {PLANE: ((4, 1000), (4, 200), (4, 4000), (4, 16000)), CAPSTAN: ((8, 1000), (16, 1000), (32, 1000))},
    ),
    unable(
        "EXUDYN",
        "no friction between a beam and a plane",
        "friction of plane cables with discs (ObjectContactFrictionCircleCable2D) is not posed here",
    ),
    unable("OpenSees", PAIRS, PAIRS),
    unable("xara", PAIRS, PAIRS),
)


def rough_others_measured(
    other: RoughOther, problem: RoughProblem, environment: Environment | None, *, quick: bool
) -> Contender:
    """One solver on one problem.

    Args:
        other: Who.
        problem: What.
        environment: Where it lives; None: nowhere.
        quick: Only the first setting.

    Returns:
        Its attempts, or why there are none.
    """
    absent = ABSENT if environment is None else other.without.get(problem.pose, "")
    if environment is None or absent:
        return Contender(problem.name, other.taker, (), absent)
    sweep = other.sweeps[problem.pose][: 1 if quick else None]
    words = [(f"{n}", f"1/{steps} s") for n, steps in sweep]
    return contest(problem.name, other.taker, words, lambda k: measured(other, problem, environment, *sweep[k]))


def measured(other: RoughOther, problem: RoughProblem, environment: Environment, elements: int, steps: int) -> Measured:
    """One setting.

    Raises:
        Refused: It gave no answer.
    """
    question = {
        "module": f"verification.peers.{other.module}",
        "package": other.package,
        "pose": problem.pose,
        "problem": problem.told,
        "settings": [{"elements": elements, "step": 1.0 / steps}],
        "repeats": 2,
        "budget": BUDGET,
    }
    answer = ask(environment.python, question)
    off = problem.off(answer.tip)
    return Measured(
        error=float(off.max()),
        final=float(off[-1]),
        solve=answer.solve,
        setup=answer.setup,
        once=answer.loading + max(0.0, answer.first - answer.solve),
        steps=round(steps * problem.times[-1]),
        version=f"{other.package} {answer.version}",
    )
