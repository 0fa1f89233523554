"""What is to be done, as units: which cases, by which models, on which meshes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from fnmatch import fnmatchcase
from functools import partial

from dolfinrod.scene import SceneError
from verification import cases, checks, laws, onestep, speed, trials
from verification.case import Case
from verification.ledger import Unit
from verification.models import BOTH, Continuum, Discrete, Model, natural
from verification.peers import race
from verification.shape import shapes
from verification.workprecision import study

__all__ = ["LAWS", "families", "headlines", "known", "plan", "selected"]

# Chosen like a family.
LAWS = "laws"


@dataclass(frozen=True)
class Depth:
    """How closely a case is studied.

    Args:
        degrees: Of the continuum model.
        every: With every kinematics that holds the case, not only the smallest.
        literal: By the discrete model with Eq. 16 as printed, too.
        continuum: Elements a turn.
        discrete: Elements a turn.
        repeats: Timed calls of each solve.
    """

    degrees: tuple[int, ...]
    every: bool
    literal: bool
    continuum: tuple[int, ...]
    discrete: tuple[int, ...]
    repeats: int


# Of headline cases and of the others, in full and in quick runs.
HEADLINE = Depth((1, 2, 3, 4, 5), True, True, (4, 8, 16, 32), (20, 40, 80, 160, 320), 7)
OTHER = Depth((3, 4, 5), True, False, (4, 8, 16), (20, 40, 80, 160), 3)
QUICK_HEADLINE = Depth((3,), True, True, (8, 16, 32), (20, 40, 80), 1)
QUICK_OTHER = Depth((4,), False, False, (4, 8, 16), (20, 40, 80), 1)

Chosen = Callable[[Case], bool]


def families() -> tuple[str, ...]:
    """Families in the order of their first cases."""
    return tuple(dict.fromkeys(case.family for case in cases.CASES))


def headlines() -> tuple[str, ...]:
    """Name of the case of each family that is studied in depth.

    One out of `cases.HEADLINES`, else the first that both models pose, else the first.
    """
    found = []
    for family in families():
        members = [case for case in cases.CASES if case.family == family]
        marked = [case for case in members if case.name in cases.HEADLINES]
        both = [case for case in members if len(case.models) > 1]
        found.append((marked + both + members)[0].name)
    return tuple(found)


def known() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (*families(), LAWS, *(case.name for case in cases.CASES), *trials.names(), race.PEERS)


def selected(names: Iterable[str]) -> tuple[str, ...]:
    """Names that the given ones stand for.

    Args:
        names: Of cases or families, shell-style wildcards allowed; empty: everything but `trials.APART`.

    Returns:
        Names out of `known()`.

    Raises:
        SceneError: One stands for nothing, with names that look like it.
    """
    names = tuple(names)
    for name in names:
        if not any(fnmatchcase(word, name) for word in known()):
            close = get_close_matches(name, known(), n=3, cutoff=0.5)
            hint = f"did you mean {' or '.join(close)}?" if close else "--list shows what there is"
            raise SceneError(f"no case or family is called {name}; {hint}")
    if not names:
        return tuple(word for word in known() if word not in trials.APART)
    return tuple(word for word in known() if any(fnmatchcase(word, name) for name in names))


def plan(names: tuple[str, ...], *, quick: bool) -> tuple[Unit, ...]:
    """All units of the cases asked for.

    Args:
        names: As `selected` returns them.
        quick: Fewer meshes, degrees and repetitions; every limit is still checked.

    Returns:
        Units, in the order in which they are done.
    """

    def chosen(case: Case) -> bool:
        return case.name in names or case.family in names

    asked = tuple(case for case in cases.CASES if chosen(case))
    return (
        # First, so that the time a model takes for its forms is found where it is looked for.
        *(unit for case in asked for unit in _of_case(case, quick)),
        *_limits(chosen, quick),
        *_laws(names),
        *trials.units(names, quick=quick),
        *race.units(names, quick=quick),
    )


def _laws(names: tuple[str, ...]) -> Iterator[Unit]:
    """Every law asked of every model that can be asked."""
    for law in laws.LAWS if LAWS in names else ():
        for model in laws.MODELS:
            if law.holds_for(model):
                work = partial(laws.measured, law, model)
                yield Unit("law", f"{law.title}: {model.name}", (law.name, model.name), work)


def _limits(chosen: Chosen, quick: bool) -> Iterator[Unit]:
    """Errors and iterations against limits, times against figures."""
    for case, n, k, limit in checks.limits():
        if chosen(case):
            found = partial(checks.error_checks, case, n, k, limit)
            yield Unit("limit", f"{case.title}: error of {n} × P{k}", (case.name, n, k, limit), found)
    for case, n, most in onestep.problems():
        if chosen(case):
            taken = partial(onestep.one_step, case, n, most)
            yield Unit("one step", f"{case.title}: in one step", (case.name, n, most), taken)
    repeats = 5 if quick else 25
    for case, words, timed in speed.SPEEDS:
        if chosen(case):
            title = f"{case.title}: speed {words}"
            yield Unit("speed", title, (case.name, words, repeats), partial(timed, repeats))


def _of_case(case: Case, quick: bool) -> Iterator[Unit]:
    """Studies by every model that poses a case, and the picture."""
    depth = _depth(headline=case.name in headlines(), quick=quick)
    for model in _models(case, depth):
        cells = meshes(case, depth.continuum if model.family == "continuum" else depth.discrete, quick=quick)
        work = partial(study, case, model, cells, repeats=depth.repeats)
        yield Unit("study", f"{case.title}: {model.name}", (case.name, model.name, *cells, depth.repeats), work)
    yield Unit("shape", f"{case.title}: picture", (case.name,), partial(shapes, case))


def meshes(case: Case, cells: tuple[int, ...], *, quick: bool) -> tuple[int, ...]:
    """Elements a turn times turns; in a quick run half as many of rods with several turns."""
    turns = case.turns if case.turns == 1 or not quick else case.turns / 2
    return tuple(max(1, round(turns * n)) for n in cells)


def _depth(*, headline: bool, quick: bool) -> Depth:
    """How closely."""
    if quick:
        return QUICK_HEADLINE if headline else QUICK_OTHER
    return HEADLINE if headline else OTHER


def _models(case: Case, depth: Depth) -> list[Model]:
    """Models that pose a case."""
    models: list[Model] = [
        Continuum(k, kinematics) for kinematics in (BOTH if depth.every else (natural(case),)) for k in depth.degrees
    ]
    models += [Discrete(form) for form in (("chord", "paper") if depth.literal else ("chord",))]
    return [model for model in models if model.applies_to(case)]
