"""Rigid tops through the integrators of both models: errors against the step as diagrams, what is kept as a table."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.canvas import Curve, log_log
from verification.report.families import panel
from verification.report.tables import Column, Group, Mark, Row, Swatch, count, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.rigid import TopStudy

__all__ = ["TITLE", "WORDS", "tops"]

TITLE = "Rigid tops"
WORDS = (
    "One rigid body through each rotation integrator, no rod: the references' K7 and K8. Errors are at the last time "
    "named, orders the least of all times; extrapolated: what is left of them with the step extrapolated to none. "
    "To see: the midpoint rule keeps what symmetries keep and its energy swings with the square of the step, both "
    "backward Eulers lose energy in order one, and rotation vectors that are added up, as the paper has them, turn to "
    "another attitude however short the step."
)
NUMBER = "number"
# Class of the style sheet for the line of an integrator.
KINDS = {
    "continuum, midpoint with mean strains": "p2",
    "continuum, implicit Euler": "p1",
    "discrete, implicit Euler": "chord",
    "discrete, rotations added": "paper",
}


def tops(studies: Sequence[TopStudy]) -> str:
    """A diagram for each top, and one table of all."""
    cases = [list(group) for _, group in groupby(studies, key=lambda s: s.case)]
    panels = "".join(panel(against_step(members), members[0].title) for members in cases)
    return f'<div class="panels wide">{panels}</div>{values(studies)}'


def against_step(studies: Sequence[TopStudy]) -> str:
    """Errors of the attitude at the first time of the reference, which all integrators reach, over the step.

    Args:
        studies: Of one top.

    Returns:
        SVG.
    """
    curves = [
        Curve(
            KINDS[s.integrator],
            tuple(1.0 / n for n in s.steps),
            tuple(row[0] for row in s.attitude),
            f"{s.integrator}: order {power(s.attitude_order.observed)}, by theory {count(s.theory)}",
            label=power(s.attitude_order.observed),
            theory=float(s.theory),
        )
        for s in studies
    ]
    first = studies[0]
    return log_log(
        curves,
        x="step [s]",
        y=f"error of the attitude at {first.times[0]:g} s [rad]",
        alt=f"{first.title}: error of the attitude over the step",
    )


def values(studies: Sequence[TopStudy]) -> str:
    """Errors, orders, and what is kept."""
    columns = (
        Column("integrator"),
        Column("shortest step", "s", NUMBER),
        Column("until", "s", NUMBER),
        Column("angular velocity", kind=NUMBER),
        Column("order", kind=NUMBER),
        Column("attitude", "rad", NUMBER),
        Column("order", kind=NUMBER),
        Column("precession", "rad", NUMBER),
        Column("extrapolated", kind=NUMBER),
        Column("energy off", kind=NUMBER),
        Column("order", kind=NUMBER),
        Column("momentum off", kind=NUMBER),
        Column("axial", kind=NUMBER),
        Column("theory", kind=NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for _, group in groupby(studies, key=lambda s: s.case):
        members = list(group)
        rows.append(Group(f"{members[0].title}. Reference: {members[0].provenance}."))
        rows += [row(s) for s in members]
    return table(columns, rows)


def row(s: TopStudy) -> Row:
    """A top by one integrator."""
    return (
        Swatch(KINDS[s.integrator], False, s.integrator),
        scientific(1.0 / s.steps[-1]),
        f"{s.times[-1]:g}",
        scientific(s.spin[-1][-1]),
        power(s.spin_order.observed),
        scientific(s.attitude[-1][-1]),
        power(s.attitude_order.observed),
        scientific(s.precession[-1][-1] if s.precession else None),
        " · ".join(map(scientific, s.extrapolated)),
        scientific(s.energy[-1]),
        power(s.energy_order.observed),
        scientific(max(s.momentum)),
        scientific(max(s.axial, default=None)),
        count(s.theory),
        Mark(s.holds),
    )
