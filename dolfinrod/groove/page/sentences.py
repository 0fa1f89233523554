"""The verdict in five sentences, every number of which comes from the runs or from Table 1 of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import fmean
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.groove.comparison import difference, measured
from dolfinrod.groove.page.settings import KINDS
from dolfinrod.groove.page.words import counted, interval, plain
from dolfinrod.groove.statistics import Interval

if TYPE_CHECKING:
    from dolfinrod.groove.film import Film
    from dolfinrod.groove.page.settings import Setting

__all__ = ["sentences"]

LATERAL, INTERMEDIATE = "lateral", "intermediate"
# Fibres in the section of the yarn: 36 Nm of fibres of 0.484 tex [C from P].
IN_YARN = 57


def sentences(base: Setting, films: Mapping[str, Sequence[Film]]) -> tuple[str, ...]:
    """What was simulated, what it shows, and what it does not.

    Args:
        base: The setting that the page is about, with at least one run that has an end.
        films: Of these runs, by kind.

    Returns:
        Five sentences.
    """
    apart = _apart(base)
    return (
        _asked(base, films),
        _net(base, apart),
        _wound(base),
        _narrowed(films),
        _not_shown(base, films),
    )


def _apart(base: Setting) -> Interval | None:
    """Twist by crossings, lateral less intermediate; None where there are not two runs of each."""
    a, b = (base.values("T_crossed", kind) for kind in (LATERAL, INTERMEDIATE))
    return difference(a, b) if min(len(a), len(b)) >= 2 else None


def _asked(base: Setting, films: Mapping[str, Sequence[Film]]) -> str:
    yarns = measured().comparison.difference
    told = " and ".join(counted(len(base.of(kind)), f"{kind.replace('_', ' ')} run") for kind in base.kinds)
    film = next(iter(films.values()))[0]
    return (
        f"Yarns spun with the lateral groove had {interval(yarns)} turns/m more twist than those of the intermediate "
        f"groove (Table 1, 95 % interval); here {told} of {counted(film.paths.shape[1], 'fibre')} each, "
        f"{_lasting(films)} of gathering in the {base.model} model, are set beside that."
    )


def _lasting(films: Mapping[str, Sequence[Film]]) -> str:
    """How long fibres were followed, which may come to rest sooner or later."""
    ends = [film.times[-1] for group in films.values() for film in group]
    told = dict.fromkeys(f"{1e3 * end:.3g}" for end in (min(ends), max(ends)))
    return f"{' to '.join(told)} ms"


def _net(base: Setting, apart: Interval | None) -> str:
    if apart is None:
        values = {kind: base.values("T_crossed", kind) for kind in base.kinds}
        means = ", ".join(f"{plain(fmean(T))} turns/m {kind}" for kind, T in values.items() if T)
        return (
            f"Net twist by crossings is {means or 'not known'}; a difference with an interval takes two runs of each."
        )
    told = f"The simulated bundles differ by {interval(apart)} turns/m of net twist by crossings"
    yarns = measured().comparison.difference
    if apart.low == apart.high == 0.0:
        return f"{told}: it is the same in every run of both grooves, so no additional twist is seen at all."
    if apart.holds(0.0):
        return f"{told}: the interval holds zero, so these runs show no additional twist of either hand."
    if apart.high < 0.0:
        return f"{told}: less twist in the lateral groove, against what the yarns show."
    if apart.meets(yarns):
        return f"{told}: more twist in the lateral groove, and as much as the yarns show within both intervals."
    return f"{told}: more twist in the lateral groove, as in the yarns, but not as much as there."


def _wound(base: Setting) -> str:
    parts = []
    for kind in base.kinds:
        n, wound = len(base.of(kind)), base.values("wound", kind)
        crossed = int(sum(base.values("edge_crosses", kind)))
        parts.append(
            f"{plain(fmean(wound))} pairs a run in the {kind.replace('_', ' ')} groove, where the edge fibre has "
            f"crossed its neighbour in {crossed} of {n} run{'s' * (n != 1)}"
        )
    a, b = (base.values("wound", kind) for kind in (LATERAL, INTERMEDIATE))
    more = f"; the difference is {interval(difference(a, b))}" if min(len(a), len(b)) >= 2 else ""
    return f"Fibres that wind about each other by 0.4 turns or more, either way: {', and '.join(parts)}{more}."


def _narrowed(films: Mapping[str, Sequence[Film]]) -> str:
    parts = []
    for kind, group in sorted(films.items(), key=lambda of: KINDS.index(of[0])):
        first, last = (1e3 * np.mean([film.course["width"][at] for film in group]) for at in (0, -1))
        parts.append(f"from {plain(first, 2)} to {plain(last, 2)} mm in the {kind.replace('_', ' ')} groove")
    return f"Gathering itself: the ribbon, on average along X, goes {' and '.join(parts)}."


def _not_shown(base: Setting, films: Mapping[str, Sequence[Film]]) -> str:
    film = next(iter(films.values()))[0]
    length = float(film.s[-1])
    turns = measured().comparison.difference.value * length
    n = film.paths.shape[1]
    of = f"{counted(n, 'fibre')} out of the {IN_YARN} of a yarn" if n < IN_YARN else f"{n} fibres"
    core = base.table.get("core")
    middle = {"FixedCore": " around a core at rest", "RollingCore": " with a rigid core that rolls"}.get(str(core), "")
    return (
        f"Not shown: a yarn. {plain(measured().comparison.difference.value)} turns/m over {1e3 * length:.3g} mm are "
        f"{plain(turns)} turns of the whole strand, while these are {_lasting(films)} of {of}{middle}, "
        "without the twist of the spindle, in a groove, air and ends that the paper does not describe and that are "
        "assumed; nothing was fitted to Table 1."
    )
