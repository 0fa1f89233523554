"""Other people's solvers: how each is driven, what it assumes, and a small sweep of meshes and steps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

import numpy as np

from verification.peers.contest import Contender, Measured, Taker, contest
from verification.peers.conversation import ask
from verification.peers.environment import ABSENT, Environment
from verification.peers.swing import SWING, solution

__all__ = ["OTHERS", "Other", "others_measured"]

# Seconds after which a motion is not repeated any more.
BUDGET = 2.0


@dataclass(frozen=True)
class Other:
    """Somebody else's solver.

    Args:
        taker: For the table.
        module: Adapter in this package.
        package: As it is installed.
        sweep: Elements and steps a second, one pair a setting; the quick run takes the first.
        options: What else the adapter is told.
        repeats: Solves of each setting, of which the quickest counts; the first one warms up.
    """

    taker: Taker
    module: str
    package: str
    sweep: tuple[tuple[int, int], ...]
    options: Mapping[str, str | int] = field(default_factory=dict)
    repeats: int = 2


def exudyn(rule: str, method: str, dimensions: int) -> Other:
    """EXUDYN's cable by one of its implicit integrators, in the plane or in space."""
    words = f"{dimensions}-D cable, absolute nodal coordinates, 2 nodes"
    taker = Taker(f"EXUDYN {dimensions}D, {rule}", False, True, method, words, "stretched", dimensions == 3)
    sweep = ((4, 200), (3, 200), (4, 100), (6, 200), (4, 400), (8, 400), (8, 800))
    return Other(taker, "exudyn", "exudyn", sweep, {"rule": rule, "dimensions": dimensions})


TRAPEZOIDAL = "implicit trapezoidal rule, second order"
OPENSEES = Other(
    Taker(
        "OpenSees",
        False,
        True,
        "Newmark ¼, ½ (average acceleration), Newton to 1e-9",
        "3-D corotational beam column, consistent mass",
        "stretched",
    ),
    "opensees",
    "openseespy",
    ((8, 400), (16, 400), (16, 1000), (24, 2000)),
    {"mass": "consistent", "dimensions": 3},
    # Half a minute each, and nothing to warm up.
    repeats=1,
)
PYELASTICA = Other(
    Taker("PyElastica", False, False, "position Verlet, explicit, second order", "staggered Cosserat rod", "sheared"),
    "elastica",
    "pyelastica",
    ((48, 10000), (32, 8000), (40, 8000), (48, 8000), (64, 10000)),
)
MUJOCO = Other(
    Taker(
        "MuJoCo",
        False,
        False,
        "Runge-Kutta, explicit, fourth order",
        "cable: chain of rigid bodies, elasticity plugin",
        "rigid",
    ),
    "mujoco",
    "mujoco",
    ((12, 1000), (8, 500), (10, 500), (12, 500), (16, 1000), (24, 2000)),
)
OTHERS = (
    exudyn("trapezoidal", TRAPEZOIDAL, 3),
    exudyn("generalised alpha", "generalised-α, spectral radius 0.9, second order", 3),
    exudyn("trapezoidal", TRAPEZOIDAL, 2),
    OPENSEES,
    PYELASTICA,
    MUJOCO,
)


def others_measured(other: Other, environment: Environment | None, *, quick: bool) -> Contender:
    """One solver on the swinging rod.

    Args:
        other: Who.
        environment: Where it lives; None: nowhere.
        quick: Only the first setting.

    Returns:
        Its attempts, or why there are none.
    """
    if environment is None:
        return Contender(SWING.name, other.taker, (), ABSENT)
    sweep = other.sweep[:1] if quick else other.sweep
    words = [(f"{n}", f"1/{steps} s") for n, steps in sweep]
    return contest(SWING.name, other.taker, words, lambda k: measured(other, environment, *sweep[k]))


def measured(other: Other, environment: Environment, elements: int, steps: int) -> Measured:
    """One setting.

    Args:
        other: Who.
        environment: Where it lives.
        elements: Of the rod.
        steps: In a second.

    Returns:
        Error and seconds.

    Raises:
        Refused: It gave no answer.
    """
    question = {
        "module": f"verification.peers.{other.module}",
        "package": other.package,
        "pose": SWING.name,
        "problem": asdict(SWING),
        "settings": [{"elements": elements, "step": 1.0 / steps, **other.options}],
        "repeats": other.repeats,
        "budget": BUDGET,
    }
    answer = ask(environment.python, question)
    away = np.linalg.norm(answer.tip - solution(other.taker.assumes), axis=1) / SWING.length
    return Measured(
        error=float(away.max()),
        final=float(away[-1]),
        solve=answer.solve / SWING.times[-1],
        setup=answer.setup,
        once=answer.loading + max(0.0, answer.first - answer.solve),
        steps=round(steps * SWING.times[-1]),
        version=f"{other.package} {answer.version}",
    )
