"""A cantilever, a roll-up and a 45° bend: one scene each, solved by both models.

The scenes are posed once. The continuum model (DOLFINx) takes each of them in one load step on eight cubic elements;
the paper's discrete model takes eighty of its own. The picture shows both on top of each other.

Run it with `./run shell -c "python demos/first_steps.py"`; it writes `demos/first_steps.png`.
"""

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import discrete
import dolfinrod as dr

# An inextensible, unshearable rod of unit length and bending stiffness: the elastica.
elastica = dr.Section(EA=1.0, GA=1.0, GJ=1.0, EI=1.0, rigid={"shear", "extension"})
# The square section of the 45° bend of Bathe and Bolourchi (1979), E = 1e7, no lateral contraction.
square = dr.Section(EA=1e7, GA=5e6, GJ=1e7 / 12, EI=1e7 / 12)


def cantilever(load: float) -> dr.Scene:
    """Straight, clamped at the left, a dead force P = `load` EI/L² upwards at its end."""
    return dr.Scene(
        rods=[dr.Rod.straight(length=1.0, section=elastica)],
        supports=[dr.Clamp(at="start")],
        loads=[dr.PointForce((0, load, 0), at="end")],
    )


def roll_up(turns: float) -> dr.Scene:
    """The same rod with an end moment 2π `turns` EI/L."""
    return dr.Scene(
        rods=[dr.Rod.straight(length=1.0, section=elastica)],
        supports=[dr.Clamp(at="start")],
        loads=[dr.PointMoment((0, 0, 2 * np.pi * turns), at="end")],
    )


def bend(load: float) -> dr.Scene:
    """An eighth of a circle of radius 100 in the plane, pushed out of it by a dead force."""
    return dr.Scene(
        rods=[dr.Rod.arc(radius=100.0, angle=np.pi / 4, section=square)],
        supports=[dr.Clamp(at="start")],
        loads=[dr.PointForce((0, 0, load), at="end")],
    )


def both(scene: dr.Scene) -> tuple[dr.Result, dr.Result]:
    """The scene solved by the continuum and by the discrete model."""
    return dr.solve(scene, elements=8, degree=3), discrete.solve(scene, elements=80)


def draw(ax: plt.Axes, results: tuple[dr.Result, dr.Result], axes: tuple[int, int], label: str, color: str) -> None:
    """Both deformed shapes: a line for the continuum, dots for the discrete model."""
    continuum, paper = (result.rods[0].r[-1][:, axes] for result in results)
    ax.plot(*continuum.T, color=color, lw=1.8, label=label)
    ax.plot(*paper[::4].T, ".", color=color, ms=5)


def main(picture: Path) -> None:
    """Solve, compare, draw."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
    colors = [mpl.colormaps["viridis"](x) for x in (0.0, 0.35, 0.6, 0.85)]
    for load, color in zip((1, 2, 5, 10), colors, strict=True):
        draw(left, both(cantilever(load)), (0, 1), f"$PL^2/EI = {load}$", color)
    for turns, color in zip((0.25, 0.5, 1.0), colors, strict=False):
        draw(middle, both(roll_up(turns)), (0, 1), f"$ML/EI = {2 * turns:g}\\pi$", color)
    for load, color in zip((0, 300, 600), colors, strict=False):
        draw(right, both(bend(load)), (0, 2), f"$P = {load}$", color)
    left.set(title="Cantilever: continuum (lines), discrete (dots)", xlabel="$x/L$", ylabel="$y/L$")
    middle.set(title="Roll-up by an end moment M", xlabel="$x/L$", ylabel="$y/L$")
    right.set(title="45° bend, force P out of the plane", xlabel="$x$ (radius 100)", ylabel="$z$")
    for ax in (left, middle, right):
        ax.set_aspect("equal")
        ax.grid(alpha=0.25)
        ax.legend(fontsize=8, frameon=False)
    figure.savefig(picture, dpi=130)
    plt.close(figure)


if __name__ == "__main__":
    main(Path(__file__).with_suffix(".png"))
