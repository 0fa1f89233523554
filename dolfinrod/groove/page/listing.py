"""Tables of the page."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from dolfinrod.groove.comparison import measured
from dolfinrod.groove.page.words import counted, interval, plain
from dolfinrod.groove.statistics import of_mean
from dolfinrod.groove.table1 import INTERMEDIATE, LATERAL

if TYPE_CHECKING:
    from dolfinrod.groove.page.acceptance import Judged
    from dolfinrod.groove.page.settings import Setting
    from dolfinrod.groove.page.show import Show
    from dolfinrod.groove.runs import Run

__all__ = ["acceptance_table", "failures", "parameters", "settings_table", "yarn_table"]

MARKS = {"pass": "✓ pass", "fail": "✗ fail", "not run": "– not run"}
DASH = "–"


def acceptance_table(judged: Sequence[Judged]) -> str:
    """Rows (a) to (f) with their outcomes."""
    rows = [(f"({row.letter})", _mark(row.outcome), escape(row.law), escape(row.words)) for row in judged]
    return _table(("", "outcome", "should be", "found"), rows, prose=(2, 3))


def settings_table(show: Show) -> str:
    """A row a setting and kind: what its runs give."""
    heads = (
        "setting", "groove", "runs", "net twist by crossings [turns/m]", "twist by pairs [turns/m]",
        "pairs wound ≥ 0.4", "edge crosses in", "width [mm]", "processor time a run [s]",
    )  # fmt: skip
    rows = [_setting_row(setting, kind) for setting in show.settings for kind in setting.kinds]
    note = (
        "<p>Means with 95 % intervals. Twist by pairs holds the angles at the ends, too: fibres side by side at A that "
        "lie on a slope or on one another at B have turned by up to a quarter without winding, in a lateral groove all "
        "the same way. Crossings alone leave that out.</p>"
    )
    return note + _table(heads, rows, prose=(0,), numbers=range(2, 9))


def _setting_row(setting: Setting, kind: str) -> tuple[str, ...]:
    runs = setting.of(kind)
    crossed = f"{sum(run.edge_crosses for run in runs)} of {len(runs)}"
    seconds = plain(float(np.mean([run.seconds for run in runs])))
    return (
        escape(setting.words),
        kind.replace("_", " "),
        str(len(runs)),
        _mean(setting.values("T_crossed", kind)),
        _mean(setting.values("T_pair", kind)),
        _mean(setting.values("wound", kind)),
        crossed,
        _mean([1e3 * width for width in setting.values("width", kind)], 3),
        seconds,
    )


def _mean(values: Sequence[float], digits: int = 1) -> str:
    if not values:
        return DASH
    return plain(values[0], digits) if len(values) == 1 else interval(of_mean(values), digits)


def failures(runs: Sequence[Run]) -> str:
    """Runs that have no end, each with its reason; nothing where all have."""
    failed = [run for run in runs if run.failed is not None]
    if not failed:
        return ""
    items = "".join(
        f"<li>{run.kind}, seed {run.seed}, {run.model} model, reached {1e3 * run.t:.3g} ms: "
        f"{escape(str(run.failed))}</li>"
        for run in failed
    )
    return (
        f'<div class="misses"><h3>{counted(len(failed), "run").capitalize()} failed</h3>'
        f"<p>Left out of all means.</p><ul>{items}</ul></div>"
    )


def yarn_table() -> str:
    """The measured yarns and the tests of their difference."""
    found = measured()
    both = found.comparison
    rows = [
        (yarn.system, " ".join(f"{value:g}" for value in yarn.twist), interval(mean), plain(100.0 * lost))
        for yarn, mean, lost in zip((LATERAL, INTERMEDIATE), (both.first, both.second), found.lost, strict=True)
    ]
    heads = ("yarn", "twist of ten specimens [turns/m]", "mean (95 % interval)", "below the nominal 680 [%]")
    pair = found.paired
    told = (
        f"<p>The difference is {interval(both.difference)} turns/m by Welch's test for independent samples "
        f"(t = {both.welch.statistic:.2f}, {both.welch.printed_p}). The paper pairs the specimens "
        f"(t = {pair.statistic:.2f}, {pair.printed_p}), but nothing belongs together in pairs: they correlate by "
        f"{plain(found.correlation, 2)}. Both yarns lie below the twist that the machine was set to, so that the "
        "figures fit “less twist lost” as well as “twist added”; and ten specimens of one bobbin each say how much a "
        "bobbin varies, not how much spindles or days do.</p>"
    )
    return _table(heads, rows, prose=(1,), numbers=(2, 3)) + told


def parameters(show: Show) -> str:
    """Every parameter of the setting that the page is about; those that other settings change are marked."""
    changed = {name for setting in show.settings for name in setting.changes}
    rows = [
        (f"<code>{escape(name)}</code>", escape(_shown(value)), "varied" if name in changed else "")
        for name, value in show.base.table.items()
    ]
    words = (
        "<p>In SI units, named as in <code>dolfinrod.groove.Scenario</code>, whose documentation says which come from "
        "the paper and which are assumed. “None” of groove and offset stands for what belongs to the kind.</p>"
    )
    return f"{words}<details><summary>{len(rows)} parameters</summary>{_table(('name', 'value', ''), rows)}</details>"


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _mark(outcome: str) -> str:
    return f'<span class="mark {outcome.replace(" ", "-")}">{MARKS[outcome]}</span>'


def _table(
    heads: Sequence[str], rows: Sequence[Sequence[str]], *, prose: Sequence[int] = (), numbers: Sequence[int] = ()
) -> str:
    """A table in a box that scrolls by itself where it is too wide.

    Args:
        heads: Of the columns.
        rows: Cells in HTML.
        prose: Columns that may wrap.
        numbers: Columns that stand to the right.
    """
    kinds = {**dict.fromkeys(prose, ' class="prose"'), **dict.fromkeys(numbers, ' class="number"')}
    head = "".join(f"<th{kinds.get(i, '')}>{escape(word)}</th>" for i, word in enumerate(heads))
    body = "".join(
        "<tr>" + "".join(f"<td{kinds.get(i, '')}>{cell}</td>" for i, cell in enumerate(row)) + "</tr>" for row in rows
    )
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'
