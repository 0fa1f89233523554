"""The fibre in the groove: errors over resolution and over seconds, and what lies where by both models."""

from __future__ import annotations

from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.canvas import Curve, log_log
from verification.report.lines import Trace, linear
from verification.report.tables import Column, Group, Mark, Row, Swatch, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.groovebench import GrooveSweep
    from verification.grooveprofile import GrooveProfile, SideBySide

__all__ = ["TITLE", "WORDS", "groove"]

TITLE = "Fibre in the groove"
WORDS = (
    "The paper's fibre, 40 mm long, lies on the left flank of its lateral groove, 1 mm from the bottom, clamped at A "
    "and drawn by 1 mN at B, with μ = 0.64: dragged down in equilibrium and let back, or blown down by air of 20 m/s "
    "in 0.4 ms. Errors are those of the centreline over 1 mm, against the other model on a fine mesh in short steps; "
    "grey is how far that reference itself still moves. To see: both models settle on one answer; steps and elements "
    "are told apart, since orders are those of the differences, which the other error does not disturb; over seconds "
    "the lower curve is the cheaper way to an error."
)
NUMBER = "number"
LOWEST = 1e-12
# Line of each model and scheme.
KINDS = {
    "discrete": "chord",
    "discrete, implicit Euler": "chord",
    "continuum": "p3",
    "continuum, implicit Euler": "p1",
    "continuum, midpoint": "p4",
}
AXES = {"elements": "elements", "steps": "steps", "penalty": "penalty ε_N [N/m²]"}


def groove(sweeps: Sequence[GrooveSweep], pairs: Sequence[SideBySide]) -> str:
    """Diagrams and tables of every way into the groove."""
    parts = []
    for _, group in groupby(sweeps, key=lambda s: s.case):
        members = list(group)
        parts.append(f"<h3>{escape(members[0].title)}</h3>{legend(members)}{diagrams(members)}{rows_of(members)}")
    for pair in pairs:
        parts.append(f"<h3>{escape(pair.title)}: side by side</h3>{beside(pair)}")
    return "".join(parts)


def legend(members: Sequence[GrooveSweep]) -> str:
    """Lines of the solvers."""
    names = dict.fromkeys(s.solver for s in members)
    return f'<p class="soft">{" ".join(Swatch(KINDS[name], False, name).html for name in names)}</p>'


def diagrams(members: Sequence[GrooveSweep]) -> str:
    """Errors over each resolution, and over seconds."""
    panels = []
    for over, x in AXES.items():
        chosen = [s for s in members if s.over == over]
        if chosen:
            title = f"Error over the {over.replace('penalty', 'penalty of the wall')}"
            panels.append(figure(title, drawn(chosen, x, seconds=False)))
    chosen = [s for s in members if s.over != "penalty"]
    if chosen:
        panels.append(figure("Error over seconds", drawn(chosen, "whole solve, one thread [s]", seconds=True)))
    return f'<div class="panels wide">{"".join(panels)}</div>'


def figure(title: str, drawing: str) -> str:
    """A small figure."""
    return f"<figure><figcaption>{escape(title)}</figcaption>{drawing}</figure>"


def drawn(chosen: Sequence[GrooveSweep], x: str, *, seconds: bool) -> str:
    """Errors of sweeps over their axis or over seconds."""
    curves = []
    for s in chosen:
        good = [p for p in s.points if not p.failure]
        if not good:
            continue
        shown = not seconds and s.order is not None
        curves.append(
            Curve(
                kind=KINDS[s.solver],
                x=tuple(p.seconds if seconds else p.at for p in good),
                y=tuple(max(p.error, LOWEST) for p in good),
                title=f"{s.solver}, over {s.over}; {s.fixed}",
                dashed=seconds and s.over == "elements",
                label=power(s.order) if shown else "",
            )
        )
    band = max(s.settled for s in chosen)
    note = " (dashed: over elements)" if seconds else ""
    return log_log(curves, x=x + note, y="error of the centreline / 1 mm", alt=f"error over {x}", band=band)


def rows_of(members: Sequence[GrooveSweep]) -> str:
    """Every sweep with its numbers."""
    columns = (
        Column("solver"),
        Column("over"),
        Column("from", "what stays", "prose"),
        Column("error", "coarse to fine"),
        Column("resultant", "off, finest", NUMBER),
        Column("order", "of the differences", NUMBER),
        Column("iterations", "a step, most", NUMBER),
        Column("finest", "s", NUMBER),
        Column("reference", "moves", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for reference, group in groupby(sorted(members, key=lambda s: s.reference), key=lambda s: s.reference):
        rows.append(Group(f"Against {reference}"))
        rows += [row_of(s) for s in group]
    return table(columns, rows)


def row_of(s: GrooveSweep) -> Row:
    """A sweep."""
    last = s.points[-1]
    errors = " · ".join("refused" if p.failure else scientific(p.error) for p in s.points)
    most = max((p.iterations / p.steps for p in s.points if p.steps), default=float("nan"))
    failures = [p.failure for p in s.points if p.failure]
    mark = Mark(s.holds, bad=failures[0] if failures else "missed")
    numbers = scientific(last.force), power(s.order), f"{most:.1f}", f"{last.seconds:.1f}", scientific(s.settled)
    return s.solver, s.over, s.fixed, errors, *numbers, mark


def beside(pair: SideBySide) -> str:
    """Profiles along the fibre, and the models in numbers."""
    panels = []
    for name, unit, read in (
        ("line load", "mN/m", lambda p: [1e3 * v for v in p.pressure]),
        ("friction", "mN/m", lambda p: [1e3 * v for v in p.traction]),
        ("gap", "µm", lambda p: [1e6 * v for v in p.gap]),
        ("place across the groove", "mm", lambda p: [1e3 * v for v in p.z]),
    ):
        traces = [
            Trace(KINDS[p.solver], tuple(1e3 * s for s in p.s), tuple(read(p)), p.solver, dashed=k > 0)
            for k, p in enumerate(pair.profiles)
        ]
        panels.append(figure(name.capitalize(), linear(traces, "arc length [mm]", f"{name} [{unit}]")))
    panels.append(figure("Zones: what sticks (thick), slides (thin) and is off (none)", zones(pair.profiles)))
    lines = " ".join(Swatch(KINDS[p.solver], k > 0, f"{p.solver}, {p.mesh}").html for k, p in enumerate(pair.profiles))
    apart = (
        f"Resultants differ by {scientific(pair.forces)}, line loads by {scientific(pair.pressures)} of their mean "
        f"(root mean square), gaps by {scientific(pair.gaps)} m; on {100 * pair.zones:.1f} % of the length one sticks "
        "and the other does not."
    )
    return f'<p class="soft">{lines}</p><div class="panels wide">{"".join(panels)}</div>{numbers(pair)}<p>{apart}</p>'


def zones(profiles: Sequence[GrooveProfile]) -> str:
    """A bar a model: thick where it sticks, thin where it slides."""
    traces = []
    for k, p in enumerate(profiles):
        half = [0.5 * (a + b) for a, b in zip(p.s[:-1], p.s[1:], strict=True)]
        edges = [p.s[0], *half, p.s[-1]]
        for j, state in enumerate(p.state):
            if state:
                ends = 1e3 * edges[j], 1e3 * edges[j + 1]
                width = 9.0 if state == 1 else 2.0
                traces.append(Trace(KINDS[p.solver], ends, (2.0 - k, 2.0 - k), p.solver, width=width))
    return linear(traces, "arc length [mm]", "", rows=tuple((2.0 - k, p.solver) for k, p in enumerate(profiles)))


def numbers(pair: SideBySide) -> str:
    """Each model in a line."""
    columns = (
        Column("solver"),
        Column("mesh"),
        Column("contact force along, out, across", "µN", NUMBER),
        Column("touches", "mm", NUMBER),
        Column("sticks", "mm", NUMBER),
        Column("iterations", "a step", NUMBER),
        Column("solve", "s", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for p in pair.profiles:
        force = ", ".join(f"{1e6 * f:.2f}" for f in p.force).replace("-", "−")
        lengths = f"{1e3 * p.touching:.2f}", f"{1e3 * p.sticking:.2f}"
        rows.append((p.solver, p.mesh, force, *lengths, f"{p.iterations:.1f}", f"{p.seconds:.1f}", Mark(pair.holds)))
    return table(columns, rows)
