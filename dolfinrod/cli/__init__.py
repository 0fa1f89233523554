"""The command `dolfinrod`: solve a scene file, say what it holds, verify the models, simulate bundles in a groove.

Exit codes: 0 solved, 1 not converged (what had converged is written), 2 bad input (nothing is written); `verify`:
1 a number beyond its limit, 130 interrupted; `groove`: 1 a run failed (the others are kept), 130 interrupted.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from dolfinrod.cli import bundles
from dolfinrod.cli.speech import check_writable, complain, is_first_rank, ranks, readable
from dolfinrod.output import contents, summary, versions, write
from dolfinrod.progress import ProgressLine
from dolfinrod.result import NotConverged
from dolfinrod.scene import Dynamic, Planar, Scene, SceneError, Spatial, toml
from verification import __main__ as verification

if TYPE_CHECKING:
    from dolfinrod.result import Result, StepLog

__all__ = ["main"]

SOLVED, NOT_CONVERGED, BAD_INPUT = 0, 1, 2
KINEMATICS = {"planar": Planar, "spatial": Spatial}
MODELS = {"continuum": ("continuum",), "discrete": ("discrete",), "both": ("continuum", "discrete")}
# What the discrete model of the paper leaves no choice in.
CONTINUUM_ONLY = ("degree", "kinematics")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        arguments: Words after `dolfinrod`; None: those of the process.

    Returns:
        Exit code of the process.
    """
    if arguments is None:
        _settle_threads()
    options = _parser().parse_args(arguments)
    try:
        return options.command(options)
    except SceneError as error:
        complain(str(error))
        return BAD_INPUT


def run(options: argparse.Namespace) -> int:
    """Solve a scene with the models asked for, write and print what was found."""
    scene, chosen = _read(options.scene)
    chosen |= {key: getattr(options, key) for key in ("elements", *CONTINUUM_ONLY) if getattr(options, key) is not None}
    models = MODELS[options.model]
    if "continuum" not in models:
        for key in CONTINUUM_ONLY:
            if getattr(options, key) is not None:
                raise SceneError(f"--{key} belongs to the continuum model, but --model is {options.model}")
    check_writable(options.out)
    # Every model first, files after: input that one of them refuses leaves nothing written.
    outcomes = {model: _solve(model, scene, chosen | _kept_in(options.checkpoint, model, models)) for model in models}
    if is_first_rank():
        for model, (result, failure) in outcomes.items():
            print(summary(model, result))
            if options.out is not None:
                folder = options.out / model if len(models) > 1 else options.out
                write(result, folder, failure=failure)
        if options.out is not None:
            (options.out / "scene.toml").write_text(toml.dumps(scene, chosen), encoding="utf-8")
            print(f"written to {options.out}{os.sep}")
    failures = {model: failure for model, (_, failure) in outcomes.items() if failure is not None}
    for model, failure in failures.items():
        complain(f"{model}: {failure}")
    return NOT_CONVERGED if failures else SOLVED


def _kept_in(checkpoint: Path | None, model: str, models: Sequence[str]) -> dict[str, Path]:
    """Where a run is kept: one file, or one a model, such as run-discrete.h5."""
    if checkpoint is None or len(models) == 1 or not checkpoint.name:
        return {} if checkpoint is None else {"checkpoint": checkpoint}
    return {"checkpoint": checkpoint.with_name(f"{checkpoint.stem}-{model}{checkpoint.suffix}")}


def info(options: argparse.Namespace) -> int:
    """Say what is installed and what a scene holds."""
    lines = [f"{name} {version}" for name, version in (versions() | _petsc()).items()]
    if options.scene is not None:
        scene, chosen = _read(options.scene)
        lines += ["", *contents(scene), *(f"solve: {key} = {value}" for key, value in chosen.items())]
    if is_first_rank():
        print("\n".join(lines))
    return SOLVED


def verify(options: argparse.Namespace) -> int:
    """Solve the verification cases with both models and report."""
    if ranks() > 1:
        raise SceneError(f"verify measures one process, got {ranks()} ranks")
    check_writable(options.out)
    return verification.verify(options)


def groove(options: argparse.Namespace) -> int:
    """Simulate bundles of fibres in pneumatic grooves, seed by seed, and say what they show."""
    check_writable(options.out)
    return bundles.groove(options)


def _settle_threads() -> None:
    """Begin long commands anew on one thread, as NumPy has loaded: times must mean something, ranks share cores."""
    modules = {"verify": ["verification"], "groove": ["dolfinrod.cli", "groove"]}
    if sys.argv[1:2] and sys.argv[1] in modules and "OMP_NUM_THREADS" not in os.environ:
        os.environ["OMP_NUM_THREADS"] = "1"
        os.execv(sys.executable, [sys.executable, "-m", *modules[sys.argv[1]], *sys.argv[2:]])


class _Parser(argparse.ArgumentParser):
    """Complains in one line."""

    def error(self, message: str) -> NoReturn:
        complain(f"{message} (see {self.prog} --help)")
        self.exit(BAD_INPUT)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="dolfinrod", description="Elastic rods in space, solved by two independent models.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    command = commands.add_parser("run", help="solve a scene file", description=run.__doc__)
    command.set_defaults(command=run)
    command.add_argument("scene", metavar="SCENE.toml", type=Path)
    command.add_argument("--model", choices=MODELS, default="continuum", help="default: %(default)s")
    command.add_argument("--elements", type=_counts, metavar="N", help="elements of every rod, or N,M,... one a rod")
    command.add_argument("--degree", type=int, metavar="K", help="polynomial degree of the continuum model, 1 to 5")
    command.add_argument("--kinematics", choices=KINEMATICS, help="default: planar where the scene lies in one plane")
    command.add_argument("--out", type=Path, metavar="DIR", help="write result.json, rod-*.csv and scene.toml here")
    command.add_argument("--checkpoint", type=Path, metavar="FILE", help="keep the run in this file, go on from there")
    command = commands.add_parser("info", help="versions; what a scene holds", description=info.__doc__)
    command.set_defaults(command=info)
    command.add_argument("scene", metavar="SCENE.toml", type=Path, nargs="?")
    command = commands.add_parser(
        "verify", help="errors and times of both models", description=verification.DESCRIPTION
    )
    command.set_defaults(command=verify)
    verification.add_options(command)
    command = commands.add_parser("groove", help="bundles in pneumatic grooves", description=bundles.DESCRIPTION)
    command.set_defaults(command=groove)
    bundles.add_options(command)
    return parser


def _counts(text: str) -> int | list[int]:
    """`16` or `16,24`."""
    try:
        numbers = [int(word) for word in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"must be a whole number or one a rod, such as 16 or 16,24, got {text}"
        ) from None
    return numbers if len(numbers) > 1 else numbers[0]


def _read(path: Path) -> tuple[Scene, dict[str, Any]]:
    """Scene and solve options of a file."""
    with readable(path):
        scene, chosen = toml.load(path)
        _check_options(chosen)
    return scene, chosen


def _check_options(chosen: Mapping[str, Any]) -> None:
    """The table `solve` of a file says nothing that would be ignored."""
    known = ("elements", *CONTINUUM_ONLY)
    for key, value in chosen.items():
        if key not in known:
            raise SceneError(f"solve.{key} is unknown; known are {', '.join(known)}")
        if key == "kinematics" and not (isinstance(value, str) and value in KINEMATICS):
            raise SceneError(f"solve.kinematics must be {' or '.join(KINEMATICS)}, got {value!r}")


def _solve(model: str, scene: Scene, options: Mapping[str, Any]) -> tuple[Result, NotConverged | None]:
    """Result of one model, and the failure where the end was not reached."""
    unit = "s" if isinstance(scene.motion, Dynamic) else ""
    line = ProgressLine(sys.stderr, name=model, unit=unit) if is_first_rank() and sys.stderr.isatty() else None
    solver = _continuum if model == "continuum" else _discrete
    try:
        return solver(scene, options, line), None
    except NotConverged as failure:
        return failure.result, failure
    finally:
        if line is not None:
            line.clear()


def _continuum(scene: Scene, options: Mapping[str, Any], progress: Callable[[StepLog, float], None] | None) -> Result:
    from dolfinrod.continuum import solve

    kinematics = options.get("kinematics")
    chosen = {**options, "kinematics": kinematics if kinematics is None else KINEMATICS[kinematics]()}
    return solve(scene, **chosen, progress=progress)


def _discrete(scene: Scene, options: Mapping[str, Any], progress: Callable[[StepLog, float], None] | None) -> Result:
    from discrete import solve

    chosen = {key: value for key, value in options.items() if key not in CONTINUUM_ONLY}
    return solve(scene, **chosen, progress=progress)


def _petsc() -> dict[str, str]:
    """Version and scalar type of PETSc and the MPI library under it."""
    from mpi4py import MPI
    from petsc4py import PETSc

    version = ".".join(str(part) for part in PETSc.Sys.getVersion())
    library = MPI.Get_library_version().split(",")[0].rstrip("\0\n")
    return {"PETSc": f"{version} ({PETSc.ScalarType.__name__})", "MPI": library}
