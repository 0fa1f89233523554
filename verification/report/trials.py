"""Sections on critical loads, hard cases and robustness: titles, words, and how many rows hold."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from verification.references.robustness import PEER_LOADS
from verification.report import (
    bundles,
    contact,
    contactmaps,
    groove,
    groovescenario,
    groovescenariopaper,
    hardcontact,
    limit,
    meetings,
    motion,
    ranks,
    rigid,
    twist,
)
from verification.report.critical import brackets, eigenvalues
from verification.report.hardmotion import hard_motions
from verification.report.maps import limits, maps
from verification.report.robust import fewest, hard, largest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.suite import Report

__all__ = ["TITLES", "WORDS", "contents", "outcomes"]

TITLES = {
    "eigen": "Critical loads and frequencies",
    "bracket": "Stable below, unstable above",
    "hard": "Hard cases",
    "largest": "Largest load in one step",
    "fewest": "Fewest load steps",
    "explicit": "Explicit limits",
    "maps": "Stability maps",
    "hard-motion": "Hard cases in motion",
    **motion.TITLES,
    "ranks": ranks.TITLE,
    "bundles": bundles.TITLE,
    **limit.TITLES,
    "tops": rigid.TITLE,
    "contact": contact.TITLE,
    "groove": groove.TITLE,
    "contact-maps": contactmaps.TITLE,
    "hard-contact": hardcontact.TITLE,
    "winding": twist.TITLE,
    "meetings": meetings.TITLE,
    "groove-scenarios": groovescenario.TITLE,
    "groove-paper": groovescenariopaper.TITLE,
}
WORDS = {
    "eigen": "Critical loads with all deformation before them, and natural frequencies, against characteristic "
    "equations, shooting and closed forms. Found: on the finest mesh. The order is that between the two finest meshes "
    "that round-off leaves alone; modes are the independent shapes of one value, two for a round section.",
    "bracket": "Half a per cent below a critical load the path ends in an equilibrium that is called stable, half a "
    "per cent above in one that is not, and the directions lost are as many as the critical load has modes.",
    "hard": "Scenes that solvers stumble over, default settings, nothing tuned. Flagged: the equilibrium sought was "
    "found and is called unstable. Elsewhere: another one was, and is called unstable. Refused: the solver says "
    "that and why it found none. Wrong: another equilibrium than sought, or one that no finer mesh has, and no "
    "warning; there must be none.",
    "largest": "Newton iterations for a dead tip load P L²/EI taken at once by a cantilever of 16 elements; "
    "–: more than one step, a failure or a wrong equilibrium. Other people's solvers were tried up to "
    f"{PEER_LOADS[-1]:g}.",
    "fewest": "Load steps and all Newton iterations, failed attempts included, that the default settings take, and the "
    "fewest equal steps with which other people's solvers get there, of those tried (–: none, up to 128).",
    "explicit": "The longest step with which symplectic Euler, v first and r by the new v, keeps a small kick small, "
    "found by bisection on the paper's clamped fibre, waves of one kind let go at a time; 2/ω_max of the assembled "
    "matrices; and the formula for a long chain of elements, which knows no ends (the free one turns five per cent "
    "faster in bending). Forward Euler, r by the old v, has no such step: it wins ω²Δt² of the energy a step.",
    "maps": "The paper's fibre, clamped, under the drag of air at 20 m/s as a dead load across it for 0.5 ms, put on "
    "at once or within that time; 80, 40, 20 and 10 elements. To see: explicit steps end at the line, those of "
    "implicit Euler at what they lose, which grows with the step alone, and the midpoint rule has the same error in "
    "steps over ten times as long; what a coarse mesh is off no step mends. Missed is a cell that fails within the "
    "line, or by an implicit scheme at all. Rest the pointer on a cell for its numbers.",
    "hard-motion": "Motions that schemes stumble over, default settings, steps as given, resolved or not. The ledger "
    "judges without a reference: damped means that the steps took more than 1 % of all energy that went in, swings "
    "that they had made more than 1 % at some time. Wrong: half of that energy or more made by the steps (any at all "
    "by implicit Euler), a ledger that does not close to 1e-8, or another end than a finer solve with a clean ledger, "
    "in shorter steps too; coarse: such an end, nearer to it in steps of half the length. Crawls: stopped, more "
    "attempts failed than steps were asked for.",
    **motion.WORDS,
    "ranks": ranks.WORDS,
    "bundles": bundles.WORDS,
    **limit.WORDS,
    "tops": rigid.WORDS,
    "contact": contact.WORDS,
    "groove": groove.WORDS,
    "contact-maps": contactmaps.WORDS,
    "hard-contact": hardcontact.WORDS,
    "winding": twist.WORDS,
    "meetings": meetings.WORDS,
    "groove-scenarios": groovescenario.WORDS,
    "groove-paper": groovescenariopaper.WORDS,
}


def contents(report: Report) -> dict[str, str]:
    """The sections by key, those that nothing was solved for left out."""
    parts = {
        "eigen": eigenvalues(report.critical) if report.critical else "",
        "bracket": brackets(report.brackets) if report.brackets else "",
        "hard": hard(report.hard) if report.hard else "",
        "largest": largest(report.largest) if report.largest else "",
        "fewest": fewest(report.fewest) if report.fewest else "",
        "explicit": limits(report.limits) if report.limits else "",
        "maps": maps(report.maps) if report.maps else "",
        "hard-motion": hard_motions(report.motions) if report.motions else "",
    }
    parts |= motion.contents(report)
    parts["ranks"] = ranks.ranks(report.ranks) if report.ranks else ""
    parts["bundles"] = bundles.bundles(report.bundles) if report.bundles else ""
    parts |= limit.contents(report)
    parts["tops"] = rigid.tops(report.tops) if report.tops else ""
    parts["contact"] = contact.contact_cases(report.touching) if report.touching else ""
    parts["groove"] = groove.groove(report.grooves, report.beside) if report.grooves or report.beside else ""
    parts["contact-maps"] = contactmaps.contact_maps(report.contact_maps) if report.contact_maps else ""
    parts["hard-contact"] = hardcontact.hard_contacts(report.hard_contacts) if report.hard_contacts else ""
    parts["winding"] = twist.twists(report.twists) if report.twists else ""
    parts["meetings"] = meetings.meeting_cases(report.meetings) if report.meetings else ""
    parts["groove-scenarios"] = groovescenario.scenarios(report.scenarios)
    parts["groove-paper"] = groovescenariopaper.paper(report.scenarios)
    return {key: text for key, text in parts.items() if text}


def outcomes(report: Report) -> tuple[tuple[str, Sequence[Any], str], ...]:
    """Section, rows that hold or are missed, and what it says of them that they hold."""
    return (
        ("eigen", report.critical, "critical loads and frequencies right, with the order and the modes of theory"),
        ("bracket", report.brackets, "critical loads lie between a stable and an unstable equilibrium"),
        ("hard", report.hard, "hard cases: solved, called unstable, or refused with a reason; none is wrong"),
        ("largest", report.largest, "models take the load in one step that they should"),
        ("fewest", report.fewest, "problems by default settings, within their limits of steps and iterations"),
        ("explicit", report.limits, "explicit limits are 2/ω_max"),
        ("maps", report.maps, "cells: explicit schemes fail beyond their limit and only there, implicit ones nowhere"),
        ("hard-motion", report.motions, "hard motions: finished with a sound ledger, or refused with a reason"),
        *motion.outcomes(report),
        ("ranks", report.ranks, "kinds of scenes with the same answer on one rank and on two"),
        ("bundles", report.bundles, "bundles moved to their ends, on ranks to the same"),
        (
            "growth",
            limit.growths(report),
            "models on ever finer meshes: solved, with memory that grows no faster than the elements",
        ),
        ("tops", report.tops, "rigid tops: orders of theory, momentum kept, energy lost or swinging as it should"),
        ("contact", report.touching, "ways to take a rod on a surface: answers within their limits, orders as stated"),
        ("groove", (*report.grooves, *report.beside), "ways into the groove on which the models agree"),
        (
            "contact-maps",
            report.contact_maps,
            "cells of contact: implicit Euler never fails, friction that sticks never creeps",
        ),
        (
            "hard-contact",
            report.hard_contacts,
            "hard contacts: the end sought in few iterations, or a refusal in words",
        ),
        (
            "winding",
            report.twists,
            "measures of twist: exact, or with the order of theory and right to the digits trusted",
        ),
        ("meetings", report.meetings, "ways to take rods on rods: answers within their limits, orders as stated"),
        *groovescenario.outcomes(report.scenarios),
    )
