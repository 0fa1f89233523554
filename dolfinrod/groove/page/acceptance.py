"""What the scenarios should show by the acceptance of the project, judged from the runs that are there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import Any

import numpy as np

from dolfinrod.groove.comparison import difference
from dolfinrod.groove.page.settings import Setting
from dolfinrod.groove.page.words import interval, signed
from dolfinrod.groove.runs import Folder, Run
from dolfinrod.groove.statistics import of_mean

__all__ = ["FEWEST", "Judged", "acceptance"]

# Runs of each kind below which an ensemble decides nothing.
FEWEST = 10
# Of the length: how far apart mirrored fibres may be before they touch one another.
MIRRORED = 1e-8
LATERAL, INTERMEDIATE = "lateral", "intermediate"
REFINED = ("elements", "dt", "law.eps_N")


@dataclass(frozen=True)
class Judged:
    """One row of the acceptance.

    Args:
        letter: Of the row.
        law: What should be.
        holds: Whether it is; None: what it takes has not been run.
        words: What was found.
    """

    letter: str
    law: str
    holds: bool | None
    words: str

    @property
    def outcome(self) -> str:
        """In a word."""
        return "not run" if self.holds is None else "pass" if self.holds else "fail"


def acceptance(found: Sequence[Setting], folder: Folder) -> tuple[Judged, ...]:
    """All six rows.

    Args:
        found: At least one setting, the first of which (a) and (b) are about.
        folder: Where the films of the runs are.

    Returns:
        Rows (a) to (f).
    """
    base = found[0]
    laws = (
        ("a", "Intermediate: no net twist; the interval of the mean holds zero", _no_net(base)),
        ("b", "Lateral: more pairs of fibres wind by 0.4 turns or more than intermediate", _more(base)),
        ("c", "Mirrored scenes, built and solved, give mirrored paths until fibres touch", _mirror(found, folder)),
        ("d", "Without air and friction nothing gathers", _nothing(found)),
        ("e", "A core that rolls winds one way, whatever the seed; mirrored the other way", _rolls(found)),
        ("f", "Finer elements, shorter steps, stiffer contact: the same statistics", _refined(found)),
    )
    return tuple(Judged(letter, law, *judged) for letter, law, judged in laws)


def _few(*counts: int) -> str:
    told = " and ".join(str(n) for n in counts)
    return f"takes {FEWEST} runs of each kind, there are {told}"


def _no_net(base: Setting) -> tuple[bool | None, str]:
    T = base.values("T_crossed", INTERMEDIATE)
    if len(T) < 2:
        return None, _few(len(T))
    mean = of_mean(T)
    words = f"{interval(mean)} turns/m by crossings, {len(T)} runs"
    return (mean.holds(0.0), words) if len(T) >= FEWEST else (None, f"{words}; {_few(len(T))}")


def _more(base: Setting) -> tuple[bool | None, str]:
    a, b = (base.values("wound", kind) for kind in (LATERAL, INTERMEDIATE))
    if min(len(a), len(b)) < 2:
        return None, _few(len(a), len(b))
    more = difference(a, b)
    words = f"{fmean(a):.1f} against {fmean(b):.1f} pairs, difference {interval(more, 1)}"
    enough = min(len(a), len(b)) >= FEWEST
    return (more.low > 0.0, words) if enough else (None, f"{words}; {_few(len(a), len(b))}")


def _mirror(found: Sequence[Setting], folder: Folder) -> tuple[bool | None, str]:
    pairs = [
        (run, image)
        for one in found
        for other in found
        if one.model == other.model and {**one.table, "mirrored": True} == other.table != one.table
        for run in one.runs
        for image in other.runs
        if (run.kind, run.seed) == (image.kind, image.seed) and run.failed is image.failed is None
    ]
    if not pairs:
        return None, "no scene was run with its mirror image"
    apart = max(_apart(folder, run, image) for run, image in pairs)
    against = sum(run.T_pair * image.T_pair < 0.0 for run, image in pairs)
    words = f"{len(pairs)} scenes with their images: paths {apart:.1g} of a length apart before fibres touch, "
    return apart <= MIRRORED, f"{words}{against} end with the opposite sign"


def _apart(folder: Folder, run: Run, image: Run) -> float:
    """Largest distance of mirrored fibres up to the frame at which any touch, over their length."""
    a, b = folder.film(run.key), folder.film(image.key)
    n = min(len(a.times), len(b.times))
    touched = [int(film.met[:, 0].min()) for film in (a, b) if len(film.met)]
    until = max(1, min([n, *touched]))
    off = a.paths[:until] * (1.0, 1.0, -1.0) - b.paths[:until]
    return float(np.abs(off).max(initial=0.0) / a.s[-1])


def _nothing(found: Sequence[Setting]) -> tuple[bool | None, str]:
    free = [s for s in found if all(s.table.get(name, 0) is None for name in ("air", "wall_friction"))]
    runs = [run for s in free if s.table.get("fibre_friction", 0) is None for run in s.runs if run.failed is None]
    if not runs:
        return None, "no scene without air and friction was run"
    most, wound = max(run.crossings for run in runs), max(run.wound for run in runs)
    return most == 0 == wound, f"{len(runs)} runs: at most {most} crossings and {wound} pairs wound"


def _rolls(found: Sequence[Setting]) -> tuple[bool | None, str]:
    rolling = [s for s in found if s.table.get("core") == "RollingCore"]
    sides = {
        mirrored: [run.T_pair for s in rolling if s.table["mirrored"] is mirrored for run in s.of(LATERAL)]
        for mirrored in (False, True)
    }
    if len(sides[False]) < FEWEST:
        return None, f"takes {FEWEST} lateral runs with a rolling core, there are {len(sides[False])}"
    words = ", ".join(
        f"{'mirrored' if mirrored else 'as built'} {sum(v > 0 for v in T)} of {len(T)} Z, mean {signed(fmean(T))}"
        for mirrored, T in sides.items()
        if T
    )
    return min(sides[False]) > 0.0 and max(sides[True], default=-1.0) < 0.0, f"{words} turns/m"


def _refined(found: Sequence[Setting]) -> tuple[bool | None, str]:
    base, told, holds = found[0], [], True
    for other in found[1:]:
        if other.model != base.model or not set(other.changes) <= set(REFINED):
            continue
        samples = [(base.values("wound", kind), other.values("wound", kind)) for kind in (LATERAL, INTERMEDIATE)]
        if min(len(values) for pair in samples for values in pair) < FEWEST:
            continue
        apart = [difference(now, then) for then, now in samples]
        holds &= all(each.holds(0.0) for each in apart)
        told.append(f"{_named(other.changes)}: {', '.join(interval(each, 1) for each in apart)} pairs wound")
    if not told:
        return None, f"takes {FEWEST} runs of each kind with another mesh, step or penalty"
    return holds, "; ".join(told)


def _named(changes: dict[str, tuple[Any, Any]]) -> str:
    return ", ".join(f"{name} {now:g} for {then:g}" for name, (then, now) in changes.items())
