"""A rope round a bollard: a small force at one end holds a large one at the other, T₂ = e^{μθ} T₁ (Euler 1769).

How large it may be cannot be found by pulling with a force: beyond the limit there is no equilibrium, and a solver that
fails there proves nothing. So one end is pulled by a displacement instead. The force that this takes rises while the
rope slips on more and more of the bollard and stays what it is once all of it slides: that is the limit load.

Lengths are in radii of the bollard, forces in T₁. The rope is thin, limp and hardly stretches, as Euler has it: its
thickness and bending stiffness change the limit by 1e-6 or so. The wall is an augmented Lagrangian, which leaves no
penetration that would depend on its stiffness.

Run it with `./run shell -c "python demos/capstan.py"`; it writes `demos/capstan.png`.
"""

from math import exp, radians
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import dolfinrod as dr

MU = 0.3
# Stiffness of the rope, of the wall and of the anchors that hold it there: it moves by 1e-6 radii before it slips.
STIFFNESS = 1e6
ROPE = dr.Section(EA=STIFFNESS, GJ=1e-5, EI=1e-5, rigid={"shear"}, radius=1e-6)


def capstan(degrees: float) -> dr.Scene:
    """The rope lies round so much of the bollard. One end is held while the other gets T₁, until t = 1; then pulled."""
    angle = radians(degrees)
    rope = dr.Rod.arc(radius=1.0, angle=angle, section=ROPE, start=(-1, 0, 0), direction=(0, 1, 0), towards=(1, 0, 0))
    # As deep in the wall as T₁ presses it, so that it lies on it everywhere from the beginning.
    bollard = dr.Cylinder((0, 0, 0), axis=(0, 0, 1), radius=1.0 - ROPE.radius + 1.0 / STIFFNESS)
    # Twice what a string would stretch by from T₁ everywhere until all of it slides.
    reach = 2.0 * (exp(MU * angle) - 1.0) / (MU * STIFFNESS)
    pull = dr.Prescribed("start", displacement=(None, -reach, None), history=((0, 0), (1, 0), (4, 1)))
    hold = dr.PointForce(tuple(rope.frames(np.array([rope.length]))[0, :, 0]), "end", history=((0, 0), (1, 1), (4, 1)))
    touch = dr.Contact(bollard, dr.AugmentedLagrangian(STIFFNESS, 1e-10), dr.Coulomb(MU))
    return dr.Scene([rope], [pull], [hold], [touch], motion=dr.Static(steps=16, t_end=4.0))


def pulls(result: dr.Result) -> np.ndarray:
    """T₂ at the stored times from t = 1 on, by the balance of the whole rope."""
    load, contact = result.scene.loads[0].force, result.contacts[0].force
    return load[1] + contact[result.t >= 1.0, 1]


def main(picture: Path) -> None:
    """Solve, compare with Euler, draw."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    colors = mpl.colormaps["viridis"]
    print("wrap     T2/T1      e^(mu theta)   error")
    for degrees in (90, 180, 270):
        color, limit = colors(degrees / 270 - 1 / 3), exp(MU * radians(degrees))
        result = dr.solve(capstan(degrees), elements=degrees // 6, degree=2)
        taken, pulled = pulls(result), result.t >= 1.0
        print(f"{degrees:3d}°  {taken[-1]:.7f}   {limit:.7f}    {taken[-1] / limit - 1.0:.1e}")
        left.plot(-result.rods[0].r[pulled, 0, 1] * STIFFNESS, taken, ".-", color=color, label=f"{degrees}°")
        left.axhline(limit, color=color, ls="--", lw=0.8)
    rope = result.rods[0]
    angle, tension = np.degrees(rope.s[-1] - rope.s), rope.n[pulled, :, 0]
    for i, force in enumerate(tension):
        right.plot(angle, force, color=colors(i / len(tension)), lw=1.0)
    right.plot(angle, np.exp(MU * np.radians(angle)), "k--", lw=0.8, label="$e^{\\mu\\varphi}$")
    left.set(title="Pull against way; dashed: $e^{\\mu\\theta}$", xlabel="way of the pulled end [$T_1R/EA$]")
    right.set(title="Tension along the rope, step by step (270°)", xlabel="angle from the held end φ [°]")
    for ax, name in ((left, "$T_2/T_1$"), (right, "$T/T_1$")):
        ax.set(ylabel=name, yscale="log", yticks=(0.5, 1, 2, 4), yticklabels=("0.5", "1", "2", "4"))
        ax.minorticks_off()
        ax.grid(alpha=0.25)
        ax.legend(fontsize=8, frameon=False)
    figure.savefig(picture, dpi=130)
    plt.close(figure)


if __name__ == "__main__":
    main(Path(__file__).with_suffix(".png"))
