"""`dolfinrod groove`: bundles in grooves, run by run on one rank or several, and what they show."""

from __future__ import annotations

import os
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from dolfinrod.cli.listing import listing
from dolfinrod.cli.speech import complain, is_first_rank, ranks, readable
from dolfinrod.cli.watch import Watch
from dolfinrod.groove import VARIANTS, Ensemble, Scenario, ensemble, report, toml, variant
from dolfinrod.groove.closing import closing
from dolfinrod.groove.rows import write_rows
from dolfinrod.groove.scenario import MODELS
from dolfinrod.groove.sections import KINDS
from dolfinrod.groove.sweep import SHORT, grid, value
from dolfinrod.scene import SceneError

__all__ = ["DESCRIPTION", "add_options", "groove"]

DONE, FAILED, INTERRUPTED = 0, 1, 130
BOTH = "both"
DESCRIPTION = (
    "Simulate bundles of fibres in pneumatic grooves, each with several seeds, and compare lateral with intermediate. "
    "Every finished run is kept in DIR, and the same command goes on where it was stopped. Started by "
    "`mpirun -n N dolfinrod groove ...`, N ranks share the runs."
)


def add_options(parser: ArgumentParser) -> None:
    """Give a parser the options of the command."""
    parser.add_argument("systems", nargs="*", metavar="SYSTEM", help=f"{BOTH}, {', '.join(KINDS)}, or a file FILE.toml")
    parser.add_argument("--model", choices=(*MODELS, BOTH), default="discrete", help="default: %(default)s")
    parser.add_argument("--fibres", type=int, metavar="N", help="default: 5")
    parser.add_argument("--seeds", type=_number, default=10, metavar="N", help="runs of each; default: %(default)s")
    parser.add_argument("--elements", type=int, metavar="N", help="of a fibre in the discrete model; default: 80")
    parser.add_argument("--duration", metavar="TIME", help="that is followed, such as 6ms, the default")
    parser.add_argument(
        "--variant", choices=VARIANTS, action="append", default=[], help="change one mechanism; may be repeated"
    )
    parser.add_argument(
        "--sweep",
        type=_sweep,
        action="append",
        default=[],
        metavar="NAME=VALUE,...",
        help=f"a parameter at several values: {', '.join(SHORT)}, or any of --parameters; may be repeated",
    )
    parser.add_argument("--out", type=Path, default=Path("groove"), metavar="DIR", help="default: %(default)s")
    parser.add_argument("--parameters", action="store_true", help="list all parameters, solve nothing")
    parser.add_argument("--toml", action="store_true", help="print the scenario as a file, solve nothing")


def groove(options: Namespace) -> int:
    """Solve, tell, list, draw.

    Args:
        options: As `add_options` describes them.

    Returns:
        Exit code.

    Raises:
        SceneError: What is asked for cannot be posed.
    """
    if options.parameters or options.toml:
        if is_first_rank():
            _show(options)
        return DONE
    models = MODELS if options.model == BOTH else (options.model,)
    asked = _seeded(_posed(options), options.seeds)
    watch = Watch(sys.stderr) if is_first_rank() else None
    try:
        with _all_or_none():
            found = ensemble(asked, folder=options.out, seeds=None, model=models, progress=watch)
        _tell(found, options.out)
    except KeyboardInterrupt:
        done = "" if watch is None else watch.told
        complain(f"interrupted: {done}, kept in {options.out}{os.sep}; the same command goes on from there")
        return INTERRUPTED
    finally:
        if watch is not None:
            watch.clear()
    return FAILED if found.failed else DONE


def _tell(found: Ensemble, folder: Path) -> None:
    """What came out: in words, as a table, as a page."""
    for run in found.failed:
        complain(f"failed: {run.kind}, seed {run.seed}, {run.model}: {run.failed} (remove {run.key}.json to try again)")
    if not is_first_rank():
        return
    print("\n".join(closing(found)))
    table, _ = write_rows(found.runs, folder)
    print(f"one row a run: {table}", flush=True)
    if found.finished:
        print(report(folder).resolve())


def _show(options: Namespace) -> None:
    """What there is to choose, or what was chosen, without solving it."""
    if options.parameters:
        print(listing())
    if options.toml:
        print("\n\n".join(toml.dumps(scenario) for scenario in _posed(options)), end="")


def _posed(options: Namespace) -> tuple[Scenario, ...]:
    """Scenarios with every change that was asked for; each can be built."""
    if not options.systems:
        raise SceneError(f"which groove? Name {BOTH}, {', '.join(KINDS)} or a file FILE.toml")
    names = [kind for name in options.systems for kind in (("lateral", "intermediate") if name == BOTH else (name,))]
    changes: dict[str, Any] = {name: getattr(options, name) for name in ("fibres", "elements")}
    if options.duration is not None:
        changes["t_end"] = value("t_end", options.duration)
    changes = {name: number for name, number in changes.items() if number is not None}
    found = [replace(_system(name), **changes) for name in names]
    for name in options.variant:
        found = [variant(scenario, name) for scenario in found]
    posed = grid(found, {name: [value(name, text) for text in texts] for name, texts in options.sweep})
    for scenario in posed:
        scenario.scene()
    return posed


def _system(name: str) -> Scenario:
    """By its kind, or from a file."""
    if name in KINDS:
        return Scenario(name)
    if not name.endswith(".toml"):
        raise SceneError(f"a groove must be {BOTH}, {', '.join(KINDS)} or a file FILE.toml, got {name!r}")
    with readable(Path(name)):
        return toml.load(name)


def _seeded(scenarios: Sequence[Scenario], seeds: int) -> tuple[Scenario, ...]:
    """Each with so many seeds, counted from its own on."""
    return tuple(replace(scenario, seed=scenario.seed + k) for scenario in scenarios for k in range(seeds))


@contextmanager
def _all_or_none() -> Iterator[None]:
    """A rank that ends early ends the others, which would wait for it for ever."""
    ended = False
    try:
        yield
        ended = True
    finally:
        if not ended and ranks() > 1:
            from mpi4py.run import set_abort_status

            set_abort_status(INTERRUPTED)


def _number(text: str) -> int:
    """A number of runs."""
    if not (text.isdecimal() and int(text) > 0):
        raise ArgumentTypeError(f"must be a positive whole number, got {text}")
    return int(text)


def _sweep(text: str) -> tuple[str, list[str]]:
    """`mu_wall=0.1,0.3,0.64`."""
    name, equals, values = text.partition("=")
    texts = [word.strip() for word in values.split(",")]
    if not (name and equals and all(texts)):
        raise ArgumentTypeError(f"must be a name and values, such as mu_wall=0.1,0.3,0.64, got {text}")
    return name.strip(), texts
