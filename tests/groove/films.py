"""Runs with known twist, written as an ensemble would, for what reads them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from dolfinrod.groove import Folder, Run, Scenario
from dolfinrod.groove.described import described, key
from dolfinrod.groove.film import COURSE, ENERGY
from dolfinrod.twist import crossings, pairs, profile

LENGTH, RADIUS = 0.04, 1e-5
# Frames and nodes.
FRAMES, NODES, STRETCHES = 4, 81, 20


def helices(turns: float, n: int, about: tuple[float, float] = (-3e-4, 0.0)) -> np.ndarray:
    """Fibres side by side at A that turn rigidly as a strand, right-handed, shape (n, nodes, 3) [m]."""
    X = np.linspace(0.0, LENGTH, NODES)
    angle = 0.1 + 2.0 * np.pi * turns * X / LENGTH
    off = 6e-5 * (np.arange(n) - 0.5 * (n - 1))
    # From Y to Z is right-handed about X; the first fibre lies on the right.
    return np.stack([np.column_stack((X, about[0] + o * np.sin(angle), about[1] - o * np.cos(angle))) for o in off])


def arrays(paths: np.ndarray) -> dict[str, np.ndarray]:
    """What a run keeps whose fibres do not move."""
    curves, n = list(paths), len(paths)
    still = np.broadcast_to
    found = crossings(curves)
    rows = [(f, c.k, c.l, c.over, c.X, c.sign) for f in range(FRAMES) for c in found]
    T = profile(curves, STRETCHES)
    t = 1e-3 * np.arange(FRAMES)
    course = {"t": t, **{name: np.ones(FRAMES) for name in ("width", "T_pair", "wound", "walls", "fibres", "speed")}}
    return {
        "times": t,
        "s": np.linspace(0.0, LENGTH, NODES),
        "paths": still(paths, (FRAMES, *paths.shape)),
        "pull": np.full((FRAMES, n, NODES), 1e-4),
        "pressed": np.zeros((FRAMES, n, NODES)),
        "met": np.empty((0, 7)),
        "crossed": np.array(rows).reshape(-1, 6),
        "X": still(T.X, (FRAMES, STRETCHES + 1)),
        "T": still(T.pairs, (FRAMES, STRETCHES)),
        "along": np.ones((FRAMES, 4, STRETCHES)),
        "turns": still(pairs(curves).turns, (FRAMES, n, n)),
        "outline": 1e-3 * np.array([(-2.0, 0.0), (-1.5, 0.0), (0.0, -0.4), (0.1, 0.0), (0.6, 0.0)]),
        "core": np.tile((-3e-4, 0.0, 2e-5), (FRAMES, 1)),
        "radius": np.array([RADIUS]),
        **{COURSE + name: values for name, values in course.items()},
        **{ENERGY + name: np.arange(FRAMES) * scale for name, scale in (("kinetic", 1e-9), ("drag", 1e-9))},
    }


def twisted(
    folder: Path,
    scenario: Scenario,
    seeds: Iterable[int],
    *,
    turns: float = 1.2,
    wound: int = 3,
    failed: str | None = None,
) -> tuple[Run, ...]:
    """Write runs whose strand turns by some turns and a little more from seed to seed."""
    kept, runs = Folder(folder), []
    for seed in seeds:
        one = replace(scenario, seed=seed)
        sign = -1.0 if one.mirrored else 1.0
        by = sign * (turns + 0.01 * (seed - 4.5))
        paths = helices(turns, one.fibres) * (1.0, 1.0, sign)
        run = Run(
            key=key(one, "discrete", None), kind=one.kind, seed=seed, model="discrete", scenario=described(one),
            seconds=1.0, failed=failed, t=3e-3, T_pair=by / LENGTH, T_crossed=by / LENGTH, wound=wound + seed % 2,
            winding=((0.0, by), (by, 0.0)), edge_crosses=True, crossings=4, width=3e-4,
        )  # fmt: skip
        kept.write(run, {} if failed else arrays(paths))
        runs.append(run)
    return tuple(runs)
