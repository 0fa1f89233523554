"""Tables on motions: frequencies of small vibrations, what a free rod keeps, the paper's fibre, milliseconds a step."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from verification.report.tables import Column, Group, Mark, Row, count, figure, ms, power, scientific, table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from verification.drift import DriftStudy
    from verification.frequency import FrequencyStudy
    from verification.pace import Pace, PaperFibre

__all__ = ["drifts", "fibres", "frequencies", "paces"]

NUMBER = "number"


def frequencies(found: Sequence[FrequencyStudy]) -> str:
    """Measured in time, beside those of the spectrum."""
    columns = (
        Column("model"),
        Column("elements"),
        Column("found", "rad/s, finest", NUMBER),
        Column("over exact"),
        Column("errors", "coarse to fine"),
        Column("order", "in the mesh (theory)", NUMBER),
        Column("errors of the spectrum"),
        Column("longest step", "shift of ω", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for _, group in groupby(found, key=lambda s: s.case):
        members = list(group)
        rows.append(Group(f"{members[0].title}: {figure(members[0].reference)} rad/s. {members[0].provenance}."))
        rows += [
            (
                s.model,
                ", ".join(map(count, s.meshes)),
                figure(s.found[-1]),
                ", ".join(f"{w / s.reference:.4f}" for w in s.found),
                ", ".join(map(scientific, s.errors)),
                f"{power(s.order.observed)} ({s.order.theory})",
                ", ".join(scientific(abs(w / s.reference - 1.0)) for w in s.spectrum) or "–",
                scientific(s.raw),
                Mark(s.holds),
            )
            for s in members
        ]
    note = (
        "Begun with the velocities of a mode, read off by a matrix pencil at steps of 0.2, 0.1 and 0.05 rad, the "
        "step taken away by extrapolation. The discrete model has the frequencies of its spectrum; the continuum "
        "model integrates masses in the nodes when it moves and exactly in its spectrum, so that both converge with "
        "one order from different values. Ratios of process.md 1.5 are limits of the discrete rows of K1."
    )
    return f'<p class="soft">{note}</p>' + table(columns, rows)


def drifts(found: Sequence[DriftStudy]) -> str:
    """Largest changes of what a free rod should keep."""
    columns = (
        Column("model"),
        Column("mesh"),
        Column("steps", kind=NUMBER),
        Column("time step", "s", NUMBER),
        Column("linear momentum", "largest change", NUMBER),
        Column("angular momentum", "largest change", NUMBER),
        Column("energy", "largest change", NUMBER),
        Column("energy", "at the end", NUMBER),
        Column("order", "of the energy", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for d in found:
        for k, n in enumerate(d.steps):
            last = k == len(d.steps) - 1
            changes = (d.linear[k], d.angular[k], d.energy[k], d.end[k])
            observed = power(d.order.observed) if last else ""
            verdict: str | Mark = Mark(d.holds) if last else ""
            rows.append((d.model, d.mesh, count(n), f"{d.seconds / n:g}", *map(scientific, changes), observed, verdict))
    note = (
        "A thick rod that turns about three axes and bends, relative to its first values. Midpoint must keep both "
        "momenta to 1e-9 and the energy within O(Δt²); implicit Euler keeps the linear momentum and loses energy."
    )
    return f'<p class="soft">{note}</p>' + table(columns, rows)


def fibres(found: Sequence[PaperFibre]) -> str:
    """The paper's fibre by each model."""
    columns = (
        Column("model"),
        Column("mesh"),
        Column("way of the tip", "µm", NUMBER),
        Column("apart", "of the first", NUMBER),
        Column("ledger open by", kind=NUMBER),
        Column("a step", "ms", NUMBER),
        Column(""),
    )
    rows: list[Row] = []
    for f in found:
        rows.append(Group(f"20 µm, 40 mm, clamped, weight and a wind of 10 m/s: {f.steps} steps of {f.dt:g} s"))
        rows += [
            (name, mesh, f"{1e6 * way:.3f}", scientific(apart), scientific(gap), ms(a_step), Mark(f.holds))
            for name, mesh, way, apart, gap, a_step in zip(
                f.models, f.meshes, f.way, f.apart, f.open, f.ms, strict=True
            )
        ]
    return table(columns, rows)


def paces(found: Sequence[Pace]) -> str:
    """Milliseconds a step against the aims."""
    columns = (
        Column("moved"),
        Column("model"),
        Column("mesh"),
        Column("a step", "ms, least of three runs", NUMBER),
        Column("Newton iterations", "a step", NUMBER),
        Column("aim", "ms", NUMBER),
        Column("ratio", kind=NUMBER),
        Column(""),
    )
    rows = (
        (
            p.words,
            p.model,
            p.mesh,
            ms(p.ms),
            power(p.iterations),
            ms(p.aim),
            power(p.ms / p.aim),
            Mark(p.holds, good="within", bad="slower", severity="slow"),
        )
        for p in found
    )
    return table(columns, rows)
