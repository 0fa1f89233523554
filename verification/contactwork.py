"""Contacts as units of work: the fibre in the groove, stability maps, hard cases."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from verification.contactmaps import LENGTH, MESHES, SCHEMES, STEPS, STIFFNESSES, cells
from verification.contacts.groove import CASES
from verification.groovebench import sweep, sweeps
from verification.grooveprofile import side_by_side
from verification.hardcases import contactmotions, contacts, contactways, rodcontacts, rodshots, rodways
from verification.hardcontact import HardContact, hard_contact, pairs
from verification.ledger import Unit

__all__ = ["GROOVE", "HARD", "HARD_CONTACT", "MAPS", "RODS", "WALLS", "listing", "names", "units"]

# Chosen like families; a single hard contact as "hard-contact:NAME".
GROOVE, MAPS, HARD_CONTACT = "groove", "contact-maps", "hard-contact"
WALLS = (*contacts.CASES, *contactways.CASES, *contactmotions.CASES)
RODS = (*rodways.CASES, *rodcontacts.CASES, *rodshots.CASES)
HARD = (*WALLS, *RODS)
# A quick run: every so many cells of one mesh, and two walls.
QUICK_MESH, QUICK_WALLS, QUICK_STEPS = 5, STIFFNESSES[1:3], STEPS[1::2]


def names() -> tuple[str, ...]:
    """Whatever may be asked for by name."""
    return (GROOVE, MAPS, HARD_CONTACT, *(case.name for case in CASES), *map(hard_name, HARD))


def hard_name(case: HardContact) -> str:
    """Under which a hard contact is asked for."""
    return f"{HARD_CONTACT}:{case.name}"


def listing(asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Name and title of what is asked for, members indented.

    Args:
        asked: Out of `names()`; others are passed over.

    Yields:
        One line.
    """
    members = [case for case in CASES if {GROOVE, case.name} & set(asked)]
    if members:
        yield GROOVE, "the paper's fibre in its lateral groove, both models against each other"
    yield from ((f"  {case.name}", case.title) for case in members)
    if MAPS in asked:
        yield MAPS, "step, penalty and length of the elements: what converges, chatters, fails"
    hard = _hard(asked)
    if hard:
        yield HARD_CONTACT, "contacts that solvers stumble over"
    yield from ((f"  {hard_name(case)}", case.title) for case in hard)


def units(asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
    """What is to be done.

    Args:
        asked: Out of `names()`; others are passed over.
        quick: The models side by side in statics alone, maps of one mesh, one hard contact of each group, no shots: all
            of these cut steps on purpose, and take more iterations than are allowed.

    Yields:
        Units in the order of the report.
    """
    for case in CASES:
        if {GROOVE, case.name} & set(asked) and not quick:
            for base, over in sweeps(case):
                words = f"{case.title}: {base.words(case)} over {over}"
                key = (case.name, base.words(case), base.mesh, over)
                swept = partial(sweep, case, base, over)
                yield Unit("groove", words, key, swept, rests_on=f"{case.name}, not {base.model}")
    for case in CASES[:1] if quick else CASES:
        if {GROOVE, case.name} & set(asked):
            yield Unit("side by side", f"{case.title}: side by side", (case.name,), partial(side_by_side, case))
    if MAPS in asked:
        yield from _maps(quick)
    hard = _hard(asked)
    if quick:
        firsts = {case.group: case for case in reversed(hard) if case.group != rodshots.SHOTS}
        hard = tuple(firsts.values())[::-1]
    for hard_case in hard:
        for model, scheme in pairs(hard_case):
            way = "" if scheme is None else type(scheme).__name__
            work = partial(hard_contact, hard_case, model, scheme)
            title, shared = f"{hard_case.title}: {model} {way}".rstrip(), f"{hard_case.name}, not {model}"
            yield Unit("hard contact", title, (hard_case.name, model, way), work, rests_on=shared)


def _hard(asked: tuple[str, ...]) -> tuple[HardContact, ...]:
    return tuple(case for case in HARD if HARD_CONTACT in asked or hard_name(case) in asked)


def _maps(quick: bool) -> Iterator[Unit]:
    """A line of a map, all steps on one wall by one mesh, is a unit."""
    steps = QUICK_STEPS if quick else STEPS
    for scheme in SCHEMES:
        for n in (QUICK_MESH,) if quick else MESHES:
            for eps_N in QUICK_WALLS if quick else STIFFNESSES:
                words = f"Contact map: {scheme.name}, elements of {1e3 * LENGTH / n:g} mm, {eps_N:g} N/m²"
                yield Unit(
                    "contact map", words, (scheme.name, n, eps_N, *steps), partial(cells, scheme, n, eps_N, steps)
                )
