"""What bundles in the groove should show, judged from ensembles; what they do not show is said as plainly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dolfinrod.groove import Interval, measured
from dolfinrod.groove.statistics import of_mean, welch
from verification.groovepaper import PaperRun
from verification.groovescenario import SEEDS, GrooveEnsemble
from verification.groovescenariobeside import GrooveImage, GrooveModels
from verification.groovescenariosteps import GrooveSteps

__all__ = ["Gathered", "GrooveClaim", "judged", "with_claims"]

# Of a bundle's width, by which one that nothing drives may swing [1]. And of the winding of fibres held at both ends,
# whole turns but for the piece at B by which one ends before the other: less than this is nearest to none [turns].
KEPT, HELD = 1e-3, 0.25
REFINED = (
    ("lateral", "half-elements"),
    ("lateral", "half-steps"),
    ("lateral", "twice-penalty"),
    ("damped", "damped-half-steps"),
)


@dataclass(frozen=True)
class GrooveClaim:
    """One claim.

    Args:
        title: What should be.
        found: What is, in numbers.
        holds: Whether it is; True where nothing is asked.
        asked: Whether anything is: runs too few to tell, or what is only told, is not judged.
    """

    title: str
    found: str
    holds: bool
    asked: bool = True

    @property
    def words(self) -> str:
        """For a list of misses."""
        return f"Bundles in the groove: {self.title}: {self.found}"


Gathered = GrooveEnsemble | GrooveClaim | GrooveImage | GrooveModels | GrooveSteps | PaperRun


def with_claims(rows: Sequence[Gathered]) -> tuple[Gathered, ...]:
    """Rows of the topic, and the claims that follow from its ensembles."""
    return (*rows, *judged([row for row in rows if isinstance(row, GrooveEnsemble)]))


def judged(found: Sequence[GrooveEnsemble]) -> tuple[GrooveClaim, ...]:
    """All claims whose ensembles are there.

    Args:
        found: Ensembles, each known by its name.

    Returns:
        In the order of process.md 6.7.
    """
    by = {one.name: one for one in found if len(one.crossed) >= 2 or (one.name in ("still", "pinned") and one.most)}
    claims: list[GrooveClaim] = []
    if "intermediate" in by:
        claims.append(_zero(by["intermediate"]))
    if {"lateral", "intermediate"} <= by.keys():
        claims += [_more(by["lateral"], by["intermediate"]), _beside(by["lateral"], by["intermediate"])]
    if {"damped", "damped-intermediate"} <= by.keys():
        pair = by["damped"], by["damped-intermediate"]
        claims += [_damped(_more(*pair)), _damped(_beside(*pair))]
    if "lateral" in by:
        claims.append(_edge(by["lateral"]))
    if {"lateral", "mirrored"} <= by.keys():
        claims.append(_mirrored(by["lateral"], by["mirrored"]))
    if "still" in by:
        claims.append(_still(by["still"]))
    if {"L2", "L2-mirrored"} <= by.keys():
        claims.append(_rolling(by["L2"], by["L2-mirrored"]))
    if "damped-L2" in by:
        claims.append(_damped(_rolled(by["damped-L2"])))
    if "pinned" in by:
        claims.append(_pinned(by["pinned"]))
    claims += [_refined(by[one], by[other]) for one, other in REFINED if {one, other} <= by.keys()]
    return tuple(claims)


def _told(interval: Interval, unit: str = "turns/m") -> str:
    """With its interval."""
    return f"{interval.value:+.2f} ({interval.low:+.2f} to {interval.high:+.2f}) {unit}".replace("-", "−").rstrip()


def _enough(*several: GrooveEnsemble) -> bool:
    """Whether they are as many as a statement on means asks for."""
    return all(len(one.crossed) >= SEEDS for one in several)


def _zero(one: GrooveEnsemble) -> GrooveClaim:
    mean, asked = of_mean(one.crossed), _enough(one)
    title = "(a) intermediate: the interval of the mean twist contains zero"
    return GrooveClaim(title, _told(mean), mean.holds(0.0) or not asked, asked)


def _more(a: GrooveEnsemble, b: GrooveEnsemble) -> GrooveClaim:
    difference, p = _less(a.wound, b.wound)
    told = f"{of_mean(a.wound).value:.1f} against {of_mean(b.wound).value:.1f}, more by {_told(difference, '')}"
    title, asked = "(b) lateral: more pairs wind by 0.4 turns or more than in the intermediate groove", _enough(a, b)
    return GrooveClaim(title, f"{told}, {p}", difference.low > 0.0 or not asked, asked)


def _damped(claim: GrooveClaim) -> GrooveClaim:
    """The same with a law that the paper does not have, and of which nothing is asked."""
    return replace(claim, title=f"contact damped critically: {claim.title}", holds=True, asked=False)


def _beside(a: GrooveEnsemble, b: GrooveEnsemble) -> GrooveClaim:
    difference, p = _less(a.crossed, b.crossed)
    yarns = measured().comparison.difference
    meets = "they meet" if difference.meets(yarns) else "they do not meet"
    told = f"{_told(difference)}, {p}; of the yarns {_told(yarns)}: {meets}"
    return GrooveClaim("lateral less intermediate beside Table 1 (nothing is fitted, nothing asked)", told, True, False)


def _less(a: Sequence[float], b: Sequence[float]) -> tuple[Interval, str]:
    """Difference of means and what Welch's test says of it, which needs some scatter and more than a few runs."""
    if len({*a}) == len({*b}) == 1:
        exact = a[0] - b[0]
        return Interval(exact, exact, exact), "no scatter, no test"
    test = welch(a, b)
    assert test.difference is not None
    enough = min(len(a), len(b)) >= SEEDS
    return test.difference, f"Welch {test.printed_p}" if enough else f"no test of fewer than {SEEDS} runs"


def _edge(one: GrooveEnsemble) -> GrooveClaim:
    told = f"in {sum(one.edge):.0f} of {len(one.edge)} runs"
    return GrooveClaim("(b) fibre 5 crosses fibre 4 (counted, nothing asked)", told, True, False)


def _mirrored(one: GrooveEnsemble, image: GrooveEnsemble) -> GrooveClaim:
    mean, back, asked = of_mean(one.crossed), of_mean([-T for T in image.crossed]), _enough(one, image)
    told = f"{_told(mean)} and {_told(back)}, sign exchanged"
    return GrooveClaim(
        "(c) the mirror image, solved, has the statistics of the image", told, mean.meets(back) or not asked, asked
    )


def _still(one: GrooveEnsemble) -> GrooveClaim:
    off = max(abs(width / one.begun - 1.0) for width in one.width)
    wound = max(one.wound)
    # Noise of the starts, 1 µm each, is part of the width.
    return GrooveClaim(
        "(d) no air, no friction, 2 mN: nothing gathers",
        f"{wound:.0f} pairs wound, width off by {off:.1e} of what it was",
        wound == 0.0 and off <= KEPT + 8e-6 / one.begun,
    )


def _rolling(one: GrooveEnsemble, image: GrooveEnsemble) -> GrooveClaim:
    mean, back, asked = of_mean(one.crossed), of_mean(image.crossed), _enough(one, image)
    sure = mean.low > 0.0 and back.high < 0.0
    told = f"{_told(mean)} from the left, {_told(back)} mirrored"
    return GrooveClaim(
        "(e) a core that rolls: Z from the left, S from the right, for sure", told, sure or not asked, asked
    )


def _rolled(one: GrooveEnsemble) -> GrooveClaim:
    mean, left = of_mean(one.crossed), sum(T > 0.0 for T in one.crossed)
    told = f"{_told(mean)} from the left, Z in {left} of {len(one.crossed)} runs"
    return GrooveClaim("(e) a core that rolls: Z from the left, for sure", told, mean.low > 0.0)


def _pinned(one: GrooveEnsemble) -> GrooveClaim:
    return GrooveClaim(
        "held at both ends, no pair has wound: false twist only",
        f"at most {max(one.most):.1e} turns",
        max(one.most) <= HELD,
    )


def _refined(one: GrooveEnsemble, finer: GrooveEnsemble) -> GrooveClaim:
    asked = _enough(one, finer)
    pairs = [(of_mean(getattr(one, name)), of_mean(getattr(finer, name))) for name in ("crossed", "wound")]
    told = [f"{_told(a, unit)} and {_told(b, unit)}" for (a, b), unit in zip(pairs, ("turns/m", "pairs"), strict=True)]
    title = f"(f) the same statistics, {finer.title}"
    return GrooveClaim(title, "; ".join(told), all(a.meets(b) for a, b in pairs) or not asked, asked)
