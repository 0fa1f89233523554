"""Who is ahead: the quickest of ours beside the quickest of the others, problem by problem, and what ours should be."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import inf

from verification.peers.contest import TARGET, TARGETS, Attempt, Contender, Taker
from verification.peers.rods import RODS
from verification.peers.rough import ROUGH
from verification.peers.swing import SWING

__all__ = ["Aim", "Standing", "aims", "named", "standing", "standings"]

SPACE, PLANE = "in space", "anywhere"
Chosen = Callable[[Taker], bool]


def anybody(_: Taker) -> bool:
    """All of the others."""
    return True


@dataclass(frozen=True)
class Standing:
    """The quickest of either side that is exact enough.

    Args:
        problem: Its name.
        target: Error allowed, over the length.
        where: "in space": only who moves in space; "anywhere": everybody.
        ours: Who, and the attempt; None where nobody is exact enough.
        theirs: The same of the others.
    """

    problem: str
    target: float
    where: str
    ours: tuple[Contender, Attempt] | None
    theirs: tuple[Contender, Attempt] | None

    @property
    def ahead(self) -> float:
        """How many times as long the others take: above 1 ours are ahead, infinite where the others do not get there.

        Nobody there: 1.
        """
        mine, others = (spent(side) for side in (self.ours, self.theirs))
        if mine == others == inf:
            return 1.0
        return inf if others == inf else others / mine


def named(problem: str) -> str:
    """Such as P5."""
    return "P5" if problem == SWING.name else problem


def spent(side: tuple[Contender, Attempt] | None) -> float:
    """Seconds of an attempt, infinite where there is none [s]."""
    return inf if side is None or side[1].found is None else side[1].found.solve


def standing(found: Iterable[Contender], problem: str, target: float, where: str, of: Chosen = anybody) -> Standing:
    """Who is ahead on a problem.

    Args:
        found: Everybody.
        problem: Its name.
        target: Error allowed, over the length.
        where: "in space" or "anywhere".
        of: Which of the others are looked at.

    Returns:
        The quickest of ours and of the others.
    """
    there = [c for c in found if c.problem == problem and (c.taker.space or where != SPACE)]
    ours = first((c for c in there if c.taker.ours), target)
    return Standing(problem, target, where, ours, first((c for c in there if not c.taker.ours and of(c.taker)), target))


def first(contenders: Iterable[Contender], target: float) -> tuple[Contender, Attempt] | None:
    """The quickest of several."""
    there = [(c, best) for c in contenders if (best := c.quickest(target)) is not None]
    return min(there, key=spent, default=None)


def standings(found: Iterable[Contender]) -> tuple[Standing, ...]:
    """Every problem that both sides were asked for, to every target, in space and anywhere."""
    found = tuple(found)
    names = [name for name in (*(one.name for one in (*RODS, SWING, *ROUGH)),) if _both(found, name)]
    return tuple(
        standing(found, name, target, where) for name in names for target in TARGETS for where in (SPACE, PLANE)
    )


def _both(found: Iterable[Contender], problem: str) -> bool:
    """Whether ours and others tried it."""
    return {c.taker.ours for c in found if c.problem == problem and c.attempts} == {True, False}


@dataclass(frozen=True)
class Aim:
    """What ours should reach beside the others.

    Args:
        words: What.
        least: By how many times ours should be ahead.
        ahead: By how many times they are; infinite where the others do not get there.
        why: Who was looked at.
        profile: What either side's steps cost; empty where a solver does not say how many it took.
    """

    words: str
    least: float
    ahead: float
    why: str
    profile: str = ""

    @property
    def holds(self) -> bool:
        """Whether it is reached."""
        return self.ahead >= self.least


def aims(found: Iterable[Contender]) -> tuple[Aim, ...]:
    """What issue 9 asks for, of what was measured.

    Args:
        found: Everybody.

    Returns:
        One row a problem and target.
    """
    found = tuple(found)
    return tuple(aim for aim in _all(found) if aim is not None)


def _all(found: tuple[Contender, ...]) -> Iterator[Aim | None]:
    """In the order of the issue."""
    yield _aim(found, "P3", 1e-5, SPACE, 5.0)
    yield _aim(found, "P3", 1e-8, SPACE, 50.0)
    # Not the roll-ups: elements of two nodes reproduce a circle exactly.
    for name in ("P1", "P4", "P6", "P6n"):
        for target in TARGETS[1:]:
            yield _aim(found, name, target, SPACE, 1.0)
    for name in ("P1", "P4", "P6", "P6n"):
        yield _aim(found, name, 1e-5, PLANE, 1.0 / 3.0)
        yield _aim(found, name, 1e-8, PLANE, 1.0)
    for name in ("P6", "P6n"):
        for target in TARGETS[1:]:
            yield _aim(found, name, target, PLANE, 1.0, ("exact elements", lambda taker: taker.exact))
    yield _aim(found, SWING.name, TARGET, SPACE, 1.0)
    yield from _at_equal_elements(found)


def _aim(
    found: tuple[Contender, ...],
    problem: str,
    target: float,
    where: str,
    least: float,
    of: tuple[str, Chosen] = ("", anybody),
) -> Aim | None:
    """One row; None where one side was not asked."""
    if not _both(found, problem):
        return None
    words, chosen = of
    s = standing(found, problem, target, where, chosen)
    sides = " against ".join(_named(side) for side in (s.ours, s.theirs))
    among = ", ".join(filter(None, (where, words)))
    return Aim(f"{named(problem)} to {target:g}, {among}", least, s.ahead, sides, _profile(s))


def _profile(s: Standing) -> str:
    """Whether steps or what each costs keeps ours behind, and what ours are spent on.

    Such as "steps: 160 of 1.9 ms against 200 of 0.05 ms, so what a step costs makes the difference; of ours 40 % …".
    """
    sides = [side[1].found for side in (s.ours, s.theirs) if side is not None]
    taken = [(one.steps, 1e3 * one.solve / one.steps) for one in sides if one is not None and one.steps]
    if len(taken) < 2:
        return ""
    (n, ms), (others, theirs) = taken
    reason = "what a step costs" if n / others < ms / theirs else "how many steps it takes"
    words = f"steps: {n} of {ms:.2g} ms against {others} of {theirs:.2g} ms, so {reason} makes the difference"
    parts = s.ours[1].found.parts if s.ours is not None and s.ours[1].found is not None else ()
    spent = ", ".join(f"{100.0 * part:.0f} % {name}" for name, part in parts)
    return f"{words}; of ours {spent}" if spent else words


def _named(side: tuple[Contender, Attempt] | None) -> str:
    """Who, on which mesh."""
    return "nobody" if side is None else f"{side[0].taker.name} ({side[1].mesh})"


def _at_equal_elements(found: tuple[Contender, ...]) -> Iterator[Aim]:
    """The discrete model beside the 3-D corotational elements of OpenSees, from 32 elements on."""
    for problem in dict.fromkeys(c.problem for c in found):
        mine, theirs = (
            {a.mesh: a.found.solve for c in found for a in c.attempts if c.problem == problem and chosen(c) and a.found}
            for chosen in (lambda c: c.taker.name == "discrete", lambda c: c.taker.name == "OpenSees corot 3D")
        )
        for mesh in mine:
            if mesh in theirs and int(mesh) >= 32:
                why = f"discrete against OpenSees corot 3D, {mesh} elements"
                yield Aim(f"{problem} at equal elements", 1.0, theirs[mesh] / mine[mesh], why)
