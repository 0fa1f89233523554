"""Bundles that wander and wind at random, each fibre with nodes of its own, and never meet."""

from __future__ import annotations

import numpy as np

MIRROR = np.array([1.0, 1.0, -1.0])


def wandering(seed, nodes):
    """A ring of fibres from X = 0 to 1.

    Args:
        seed: Of all that is random.
        nodes: Of each fibre.
    """
    random = np.random.default_rng(seed)
    way, phase, turns, sway, start = random.uniform(-1.0, 1.0, (5, 2))
    fibres = []
    for k, n in enumerate(nodes):
        x = np.linspace(0.0, 1.0, n)
        x[1:-1] += random.uniform(-0.4, 0.4, n - 2) / (n - 1)
        core = 0.2 * way * np.sin(np.pi * np.outer(x, [1.0, 2.0]) + 3.0 * phase)
        angle = 2.0 * np.pi * (k / len(nodes) + 2.0 * turns[0] * x + 0.3 * sway[0] * np.sin(9.0 * x) + start[0])
        ring = (
            0.1 * (1.0 + 0.3 * np.sin(5.0 * x + start[1]))[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        )
        fibres.append(np.concatenate([x[:, None], core + ring], axis=1))
    return fibres
