"""Small vibrations in time (K1 to K4) and the frequency ratios of the paper's masses (process.md 1.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import Planar, PointForce, Rod, Scene, Section, Spatial, Steady, Velocity
from verification.eigencases.vibrations import CLAMPED, PINNED, STRETCHING, THICK, THIN, squared, waves
from verification.eigenmodels import EigenContinuum, EigenDiscrete
from verification.frequency import Vibrating, Vibration
from verification.references.scalar import scalar
from verification.stepper import DiscreteStepper, both_schemes

if TYPE_CHECKING:
    from collections.abc import Callable

    from dolfinrod.result import Result
    from dolfinrod.scene import Support
    from verification.case import Array
    from verification.references.scalar import Scalar

    Shape = Callable[[Array], Array]

__all__ = ["CASES"]

# Velocities at the start, in m/s per rad/s of the vibration: so small that no digit depends on them.
SMALL = 1e-4
PLANE = Planar((0.0, 0.0, 1.0))
DEGREE, CELLS, MASSES = 2, (2, 4, 8), (8, 20, 40, 80)
# Frequencies over exact ones for n = 8, 20, 40, 80 (process.md 1.5).
RATIOS = {
    1: (0.9899, 0.9984, 0.9996, 0.9999),
    2: (0.9567, 0.9927, 0.9982, 0.9995),
    3: (0.9195, 0.9857, 0.9964, 0.9991),
}


def continuum(kinematics: Planar | Spatial) -> tuple[Vibrating, ...]:
    """The continuum model by either scheme; its spectrum integrates the masses exactly, its motion in the nodes."""
    schemes = zip(*(both_schemes(n, DEGREE, kinematics) for n in CELLS), strict=True)
    return tuple(Vibrating(s, CELLS, EigenContinuum(DEGREE), 2 * DEGREE, same=False) for s in schemes)


def discrete(ratios: tuple[float, ...] = (), *, quick: bool = False) -> tuple[Vibrating, ...]:
    """The discrete model, and with ratios to hold it against also that with the paper's end masses."""
    steppers = tuple(DiscreteStepper(n) for n in MASSES)
    half = Vibrating(steppers, MASSES, EigenDiscrete(), 2, ratios, quick=quick)
    if not ratios:
        return (half,)
    return half, Vibrating(tuple(DiscreteStepper(n, "paper") for n in MASSES), MASSES, None, 1)


def vibration(
    name: str,
    title: str,
    section: Section,
    supports: tuple[Support, ...],
    mode: int,
    reference: Scalar,
    shape: Shape,
    models: tuple[Vibrating, ...],
    tension: float = 0.0,
    duration: float = 8.0,
) -> Vibration:
    """Bending of a rod of length 1, begun at rest with the velocities of a mode shape.

    Args:
        name: Of the case.
        title: For people.
        section: With mass.
        supports: That hold it.
        mode: Number of the frequency, from 0.
        reference: The frequency.
        shape: Of the mode, at arc lengths.
        models: That vibrate.
        tension: T [EI/L²].
        duration: Of a run in radians of the vibration.

    Returns:
        The case.
    """
    loads = [PointForce((tension, 0.0, 0.0), at="end", history=Steady())] if tension else []
    speed = SMALL * reference.value
    start = Velocity(v=lambda r: speed * np.outer(shape(r[:, 0]), (0.0, 1.0, 0.0)))

    def read(result: Result) -> Array:
        s, r = result.rods[0].s, result.rods[0].r
        return np.asarray((r[:, :, 1] - r[0, :, 1]) @ (shape(s) * trapezoid(s)))

    scene = Scene(rods=[Rod.straight(1.0, section)], supports=supports, loads=loads)
    name = f"motion-vibration-{name}"
    return Vibration(name, title, scene, (start,), read, mode, reference, models, duration)


def trapezoid(s: Array) -> Array:
    """Weights of the rule, shape (n,) [m]."""
    return np.asarray(0.5 * (np.diff(s, prepend=s[0]) + np.diff(s, append=s[-1])))


def clamped(n: int) -> Shape:
    """Mode n of the thin cantilever."""
    β = scalar("K1-EB-cantilever", f"betaL_{n}").value
    σ = (np.cosh(β) + np.cos(β)) / (np.sinh(β) + np.sin(β))
    return lambda x: np.cosh(β * x) - np.cos(β * x) - σ * (np.sinh(β * x) - np.sin(β * x))


def sine(n: float) -> Shape:
    """sin(nπx)."""
    return lambda x: np.sin(n * np.pi * x)


def stretched() -> Vibration:
    """Extension of a cantilever."""
    reference = waves(np.sqrt(200.0), 1)

    def velocity(r: Array) -> Array:
        return SMALL * reference.value * np.stack([sine(0.5)(r[:, 0]), 0.0 * r[:, 0], 0.0 * r[:, 0]], axis=1)

    return Vibration(
        name="motion-vibration-extension",
        title="K3, cantilever, extension 1",
        scene=Scene(rods=[Rod.straight(1.0, STRETCHING)], supports=CLAMPED),
        start=(Velocity(v=velocity),),
        read=lambda result: result.rods[0].r[:, -1, 0] - 1.0,
        mode=4,
        reference=reference,
        models=(*continuum(PLANE), *discrete()),
    )


def turned(result: Result) -> Array:
    """Twist of the sections about the x axis, weighted by the mode shape."""
    h = result.rods[0]
    return np.asarray(h.frames[:, :, 2, 1] @ (sine(0.5)(h.s) * trapezoid(h.s)))


def twisted() -> Vibration:
    """Torsion of a cantilever whose sections all spin alike at first, but for the clamped one."""
    reference = waves(np.sqrt(600.0 / 1.3), 1)
    return Vibration(
        name="motion-vibration-torsion",
        title="K3, cantilever, torsion 1",
        scene=Scene(rods=[Rod.straight(1.0, STRETCHING)], supports=CLAMPED),
        start=(Velocity(omega=(SMALL * reference.value, 0.0, 0.0)),),
        read=turned,
        mode=5,
        reference=reference,
        models=(*continuum(Spatial()), *discrete()),
    )


def thin(n: int, mode: int) -> Vibration:
    """The thin cantilever, with the ratios of the discrete model."""
    in_time = discrete(RATIOS[n], quick=n == 1)
    return vibration(
        f"cantilever-{n}",
        f"K1, thin cantilever, bending {n}",
        THIN,
        CLAMPED,
        mode,
        squared("cantilever", n),
        clamped(n),
        (*continuum(PLANE), *in_time) if n < 3 else in_time[:1],
        # The coarsest mesh mixes the third bending with slower ones, which have to be told from it.
        duration=8.0 if n < 3 else 32.0,
    )


def thick(ends: str, supports: tuple[Support, ...], mode: int, shape: Shape) -> Vibration:
    """Timoshenko's beam, which only the continuum model knows; its sections do not turn at first."""
    reference = scalar(f"K2-Timo-{ends}-s10-nu0.3", "omega_1")
    models = continuum(PLANE)
    return vibration(f"thick-{ends}", f"K2, Timoshenko beam, {ends}", THICK, supports, mode, reference, shape, models)


def pulled(T: float) -> Vibration:
    """A pinned thin rod under tension; one mode goes before, the spin about the axis that nothing resists."""
    models = (*continuum(PLANE), *discrete())
    title = f"K4, pinned beam under tension {T:g} EI/L²"
    return vibration(
        f"pulled-{T:g}", title, THIN, PINNED, 1, scalar(f"K4-tension-T{T}", "omega_1"), sine(1.0), models, T
    )


CASES = (
    *(thin(n, mode) for n, mode in ((1, 0), (2, 2), (3, 5))),
    thick("cantilever", CLAMPED, 0, clamped(1)),
    thick("pinned", PINNED, 1, sine(1.0)),
    *(pulled(T) for T in (10.0, -5.0)),
    stretched(),
    twisted(),
)
