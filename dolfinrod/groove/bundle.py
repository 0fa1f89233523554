"""Fibres as they leave the nip: straight along X, side by side, with a little noise."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from dolfinrod.groove.limits import limited
from dolfinrod.scene import Rod, SceneError, Section
from dolfinrod.scene.quantity import assign

__all__ = ["Bundle"]

# Of the middle of the ribbon at A [m]: to the left of the bottom [P], or above it.
OFFSETS = {"lateral": -1e-3, "lateral_steep": -1e-3, "intermediate": 0.0}


@dataclass(frozen=True)
class Bundle:
    """A ribbon of fibres, numbered 1, 2, … from the right to the left: the last is the left edge fibre.

    z_k = offset − (k − (n + 1)/2) pitch and y = height, each moved by noise of its own, the same all along it, so that
    every mesh and either model begin with the same fibres. The noise of a fibre depends on the seed and on its number.

    Args:
        pitch: Between neighbours, 1e-5 to 0.01 m; 0.25 mm [I], five fibres over the 1 mm of a ribbon.
        offset: z of the middle, −0.05 to 0.05 m; None: −1 mm in lateral grooves [P], 0 in the intermediate [I].
        height: y, −0.01 to 0.05 m; 0.2 mm [I], the ribbon leaves the nip above the surface; the paper says 0 [P].
        noise: Standard deviation in y and z, 0 to 1e-4 m; 1 µm [I].
        layers: How much higher the fibres of even number lie, −1e-3 to 1e-3 m; 0 [I].
        length: From A to B, 1e-3 to 1 m; 40 mm [P].
        tail: Straight part before A, which the nip holds, 0 to 1 m; 0 [I]: 60 mm where 100 mm of fibre are meant.
        section: Ramie of 20 µm [P].

    Raises:
        SceneError: A number out of its range, a section without radius or density.
    """

    pitch: float = 0.25e-3
    offset: float | None = None
    height: float = 0.2e-3
    noise: float = 1e-6
    layers: float = 0.0
    length: float = 0.04
    tail: float = 0.0
    section: Section = field(default_factory=Section.ramie)

    def __post_init__(self) -> None:
        assign(
            self,
            pitch=limited(self.pitch, "Bundle.pitch", "m", 1e-5, 0.01),
            offset=None if self.offset is None else limited(self.offset, "Bundle.offset", "m", -0.05, 0.05),
            height=limited(self.height, "Bundle.height", "m", -0.01, 0.05),
            noise=limited(self.noise, "Bundle.noise", "m", 0.0, 1e-4),
            layers=limited(self.layers, "Bundle.layers", "m", -1e-3, 1e-3),
            length=limited(self.length, "Bundle.length", "m", 1e-3, 1.0),
            tail=limited(self.tail, "Bundle.tail", "m", 0.0, 1.0),
        )
        if not isinstance(self.section, Section) or self.section.radius is None or self.section.rhoA is None:
            raise SceneError(f"must be a round Section with a density, got {self.section!r}", field="Bundle.section")

    @property
    def radius(self) -> float:
        """Of a fibre [m]."""
        assert self.section.radius is not None
        return self.section.radius

    def starts(self, fibres: int, seed: int, kind: str) -> NDArray[np.float64]:
        """Where the fibres leave the nip.

        Args:
            fibres: How many.
            seed: Of the noise.
            kind: Of groove.

        Returns:
            y and z at A, shape (fibres, 2) [m].
        """
        k = np.arange(1, fibres + 1)
        offset = OFFSETS[kind] if self.offset is None else self.offset
        places = np.stack(
            [self.height + np.where(k % 2 == 0, self.layers, 0.0), offset - (k - 0.5 * (fibres + 1)) * self.pitch],
            axis=1,
        )
        return places + np.random.default_rng(seed).normal(0.0, self.noise, (fibres, 2))

    def rods(self, starts: NDArray[np.float64], roller: float | None = None) -> tuple[Rod, ...]:
        """The fibres, free of stress.

        Args:
            starts: y and z at A, shape (n, 2) [m].
            roller: Radius of the roller around which they lie; None: they are straight [m].

        Returns:
            Rods, the tail included.
        """
        if roller is not None:
            angle, down = self.length / roller, (0.0, -1.0, 0.0)
            return tuple(
                Rod.arc(roller + float(y), angle, self.section, (0.0, float(y), float(z)), towards=down)
                for y, z in starts
            )
        whole = self.tail + self.length
        return tuple(Rod.straight(whole, self.section, (-self.tail, float(y), float(z))) for y, z in starts)
