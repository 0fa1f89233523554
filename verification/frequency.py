"""Frequencies read off small vibrations in time, on one mesh after the other, beside those of the spectrum."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import hankel

from verification.order import Order, order

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene, Velocity
    from verification.case import Array
    from verification.eigencase import EigenModel
    from verification.references.scalar import Scalar
    from verification.stepper import Stepper

__all__ = ["FrequencyStudy", "Vibrating", "Vibration", "frequency", "frequencystudy"]

# Lengths of steps in radians of the vibration: three, so that two powers of Δt² are taken away.
ADVANCES = (0.2, 0.1, 0.05)
# Singular values of a signal below this part of the largest are noise.
NOISE = 1e-7
# Errors of frequencies measured in time below this are noise and what is left of the time step.
FLOOR = 1e-6
# How far an order of the mesh may fall short of theory, and measured frequencies lie from those of the spectrum.
SLACK, APART = 0.4, 1e-5


@dataclass(frozen=True)
class Vibrating:
    """A model as it vibrates, on meshes from coarse to fine.

    Args:
        steppers: One a mesh.
        meshes: Numbers of elements.
        spectrum: The same model's spectral side; None where it has none with these masses.
        order: Power of the element length with which frequencies converge, by theory.
        ratios: Of found frequencies to exact ones as another source has them; empty: none.
        same: Whether motion and spectrum have the same mass matrix, and so the same frequencies.
        quick: Whether a quick run takes it.
    """

    steppers: tuple[Stepper, ...]
    meshes: tuple[int, ...]
    spectrum: EigenModel | None
    order: int
    ratios: tuple[float, ...] = ()
    same: bool = True
    quick: bool = False


@dataclass(frozen=True)
class Vibration:
    """A small vibration with a known frequency.

    Args:
        name: Short, unique.
        title: For people.
        scene: The rod at rest, without motion.
        start: Velocities that set it moving.
        read: Its deflection at every stored time, shape (n_t,).
        mode: Number of the frequency in the spectrum, from 0.
        reference: The frequency [rad/s].
        models: That vibrate.
        duration: Of a run in radians of the vibration; long where slower vibrations have to be told from it.
        note: One sentence where the reference holds in a limit.
    """

    name: str
    title: str
    scene: Scene = field(repr=False)
    start: tuple[Velocity, ...] = field(repr=False)
    read: Callable[[Result], Array] = field(repr=False)
    mode: int
    reference: Scalar
    models: tuple[Vibrating, ...] = field(repr=False)
    duration: float = 8.0
    note: str = ""


@dataclass(frozen=True)
class FrequencyStudy:
    """A frequency by one model and scheme on meshes from coarse to fine.

    Args:
        case: Its name.
        title: For people.
        provenance: Of the reference.
        model: Name of the model and the scheme.
        reference: The frequency [rad/s].
        meshes: Numbers of elements.
        found: Frequencies measured, the time step taken away [rad/s].
        raw: What the longest time step alone gives, less the found one, relative.
        errors: Relative ones.
        order: Of the frequencies in the mesh.
        spectrum: Those of the spectrum on the same meshes; empty where there are none.
        same: Whether they should be the same.
        ratios: Of found frequencies to exact ones as another source has them.
        note: Of the case.
    """

    case: str
    title: str
    provenance: str
    model: str
    reference: float
    meshes: tuple[int, ...]
    found: tuple[float, ...]
    raw: float
    errors: tuple[float, ...]
    order: Order
    spectrum: tuple[float, ...]
    same: bool
    ratios: tuple[float, ...]
    note: str

    @property
    def apart(self) -> float:
        """Largest relative distance from the spectrum; NaN where there is none."""
        gaps = [abs(a / b - 1.0) for a, b in zip(self.found, self.spectrum, strict=False)]
        return max(gaps, default=np.nan)

    @property
    def holds(self) -> bool:
        """As in the spectrum of the same masses, with the order that noise leaves, and another source's ratios."""
        if not np.isfinite(self.found).all() or (self.same and self.apart > APART):
            return False
        pairs = zip(self.found, self.ratios, strict=False)
        # Half of the last digit that the ratios are given to.
        if any(abs(w / self.reference - ratio) > 6e-5 for w, ratio in pairs):
            return False
        return self.order.observed is None or self.order.observed >= self.order.theory - SLACK


def frequencystudy(case: Vibration, model: Vibrating) -> FrequencyStudy:
    """Let a rod vibrate on one mesh after the other.

    Args:
        case: With its reference.
        model: That vibrates.

    Returns:
        The record.
    """
    measured = [_measured(case, stepper) for stepper in model.steppers]
    found = [_at_no_step(three) for three in measured]
    errors = [abs(w / case.reference.value - 1.0) for w in found]
    spectrum = () if model.spectrum is None else tuple(_spectral(case, model.spectrum, n) for n in model.meshes)
    return FrequencyStudy(
        case=case.name,
        title=case.title,
        provenance=f"{case.reference.id}; {case.reference.method}; {case.reference.source}",
        model=f"{model.steppers[0].name}, {model.steppers[0].mesh.partition('×')[2].strip() or 'elements'}",
        reference=case.reference.value,
        meshes=model.meshes,
        found=tuple(found),
        raw=measured[-1][0] / found[-1] - 1.0,
        errors=tuple(errors),
        order=order(errors, model.meshes, model.order, FLOOR),
        spectrum=spectrum,
        same=model.same,
        ratios=model.ratios,
        note=case.note,
    )


def _spectral(case: Vibration, model: EigenModel, elements: int) -> float:
    return float(model.modes(case.scene, elements, case.mode + 2).omega[case.mode].real)


def _measured(case: Vibration, stepper: Stepper) -> list[float]:
    """Frequencies as steps of each length show them [rad/s]."""
    found = []
    for advance in ADVANCES:
        dt = advance / case.reference.value
        steps = round(case.duration / advance)
        # Stored at equal times, also where a step was cut.
        motion = stepper.motion(steps * dt, steps, dt)
        result = stepper.solve(replace(case.scene, motion=motion, velocities=case.start))
        found.append(frequency(case.read(result), dt))
    return found


def _at_no_step(found: list[float]) -> float:
    """Both schemes are off by even powers of Δt; two are taken away (Richardson)."""
    once = [(4.0 * fine - coarse) / 3.0 for coarse, fine in pairwise(found)]
    return (16.0 * once[1] - once[0]) / 15.0


def frequency(signal: Array, dt: float) -> float:
    """Of the strongest vibration in a signal, damped or not (matrix pencil).

    A signal of k terms cⱼ zⱼⁿ makes Hankel matrices of rank k; the zⱼ = exp((−δ ± iω) Δt) are the eigenvalues of what
    leads from one to the next.

    Args:
        signal: At equal times, shape (n,).
        dt: Between them [s].

    Returns:
        ω [rad/s]; NaN where nothing vibrates.

    Source: Hua & Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38, 1990.
    """
    half = len(signal) // 2
    left, values, _ = np.linalg.svd(hankel(signal[: half + 1], signal[half:]))
    rank = int((values > NOISE * values[0]).sum())
    shift = np.linalg.lstsq(left[:-1, :rank], left[1:, :rank], rcond=None)[0]
    z = np.linalg.eigvals(shift)
    powers = z[None, :] ** np.arange(len(signal))[:, None]
    strength = np.abs(np.linalg.lstsq(powers, signal.astype(complex), rcond=None)[0])
    turning = np.abs(np.angle(z)) > 1e-3
    if not turning.any():
        return float("nan")
    strongest = int(np.argmax(np.where(turning, strength, 0.0)))
    return float(abs(np.angle(z[strongest])) / dt)
