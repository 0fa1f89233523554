"""Sections on critical loads, hard cases and robustness: titles, words, and how many rows hold."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from verification.references.robustness import PEER_LOADS
from verification.report.critical import brackets, eigenvalues
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
}


def contents(report: Report) -> dict[str, str]:
    """The sections by key, those that nothing was solved for left out."""
    parts = {
        "eigen": eigenvalues(report.critical) if report.critical else "",
        "bracket": brackets(report.brackets) if report.brackets else "",
        "hard": hard(report.hard) if report.hard else "",
        "largest": largest(report.largest) if report.largest else "",
        "fewest": fewest(report.fewest) if report.fewest else "",
    }
    return {key: text for key, text in parts.items() if text}


def outcomes(report: Report) -> tuple[tuple[str, Sequence[Any], str], ...]:
    """Section, rows that hold or are missed, and what it says of them that they hold."""
    return (
        ("eigen", report.critical, "critical loads and frequencies right, with the order and the modes of theory"),
        ("bracket", report.brackets, "critical loads lie between a stable and an unstable equilibrium"),
        ("hard", report.hard, "hard cases: solved, called unstable, or refused with a reason; none is wrong"),
        ("largest", report.largest, "models take the load in one step that they should"),
        ("fewest", report.fewest, "problems by default settings, within their limits of steps and iterations"),
    )
