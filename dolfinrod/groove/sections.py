"""Cross-sections of the groove: two flanks between lands, and what lies in the corner between them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot, pi, radians, tan

import numpy as np
from numpy.typing import NDArray

from dolfinrod.groove.limits import known, limited
from dolfinrod.scene import Groove, SceneError, WallMotion
from dolfinrod.scene.quantity import assign

__all__ = ["KINDS", "CrossSection"]

Array = NDArray[np.float64]

KINDS = ("lateral", "intermediate", "lateral_steep")
GENTLE = radians(15.0)
STEEP = 0.5 * pi - GENTLE
HALF_WIDTH = 1.5e-3
DEPTH = HALF_WIDTH * tan(GENTLE)


@dataclass(frozen=True)
class CrossSection:
    """Section of the groove in the plane X = const, z to the right and y up; the foot of the right flank is at z = 0.

    The paper gives one angle, 15° [P], "left lateral angle", and not what it is measured from, nor any length: widths
    and depths are assumptions [I].

    Args:
        beta_left: Angle of the left flank to the roller surface, 0.01 to π/2 rad; 15° [P, as the ramp is read here].
        beta_right: Of the right flank, likewise; 75° [I], that the right flank is as far from the normal.
        half_width: From the left lip to the foot of the right flank, 1e-5 to 0.1 m; 1.5 mm [I].
        depth: Of the bottom, 1e-5 to 0.1 m; None: where the flanks meet [I].
        fillet: Radius of the bottom, 0 to 0.01 m: wider than a fibre and its gap; 0: sharp, and each face of the groove
            bears fibres by itself [I].

    Raises:
        SceneError: A number out of its range, flanks that make no groove.
    """

    beta_left: float = GENTLE
    beta_right: float = STEEP
    half_width: float = HALF_WIDTH
    depth: float | None = None
    fillet: float = 0.0

    def __post_init__(self) -> None:
        assign(
            self,
            beta_left=limited(self.beta_left, "CrossSection.beta_left", "rad", 0.01, 0.5 * pi),
            beta_right=limited(self.beta_right, "CrossSection.beta_right", "rad", 0.01, 0.5 * pi),
            half_width=limited(self.half_width, "CrossSection.half_width", "m", 1e-5, 0.1),
            depth=None if self.depth is None else limited(self.depth, "CrossSection.depth", "m", 1e-5, 0.1),
            fillet=limited(self.fillet, "CrossSection.fillet", "m", 0.0, 0.01),
        )
        # Refused here, not where a scene is built.
        self._groove()

    @classmethod
    def of(cls, kind: str) -> CrossSection:
        """The section that a kind of groove has unless another is given.

        Args:
            kind: "lateral", a gentle ramp against a steep wall: the angle is that to the surface; "lateral_steep", a
                flat bottom between steep walls: it is that to the normal; "intermediate", both flanks gentle.

        Returns:
            The section.
        """
        sections = {
            "lateral": cls(),
            "intermediate": cls(GENTLE, GENTLE),
            "lateral_steep": cls(STEEP, STEEP, 1e-3 + DEPTH * tan(GENTLE), DEPTH),
        }
        return sections[known(kind, "kind", KINDS)]

    @property
    def bottom(self) -> tuple[float, float]:
        """y and z of the foot of the right flank, the deepest place [m]."""
        z, y = self._corner()[1]
        return float(y), float(z)

    def surfaces(self, motion: WallMotion | None, *, mirrored: bool, roller: float | None = None) -> tuple[Groove, ...]:
        """What fibres touch: a surface a face, or one with its fillet.

        Args:
            motion: How the roller moves on.
            mirrored: Whether left is right.
            roller: Radius of the roller around which the groove goes; None: it is straight [m].

        Returns:
            The surfaces, from the left to the right.
        """
        groove = replace(self._groove(), roller=roller)
        if mirrored:
            groove = replace(groove, profile=[(-z, y) for z, y in reversed(list(groove.profile))])
        faces = (groove,) if self.fillet > 0.0 else groove.faces()
        return tuple(replace(face, motion=motion) for face in faces)

    def seat(self, radius: float) -> tuple[float, float]:
        """Where a cylinder along X lies in the bottom: it touches both flanks there, or the fillet.

        Args:
            radius: Of the cylinder [m].

        Returns:
            y and z of its axis [m].

        Raises:
            SceneError: It is too thick to touch both flanks.
        """
        before, foot, beyond = self._corner()
        flanks = np.hypot(*(before - foot)), np.hypot(*(beyond - foot))
        left, right = (before - foot) / flanks[0], (beyond - foot) / flanks[1]
        # Between the flanks; half as long as it is the cosine of half the angle.
        middle = left + right
        half = hypot(*middle) / 2.0
        sine = (1.0 - half**2) ** 0.5
        up = middle / (2.0 * half)
        wide, most = max(radius, self.fillet), float(min(flanks)) * sine / half
        if wide > most:
            message = f"must be at most {most:.6g} m to lie between the flanks of the groove, got {radius!r} m"
            raise SceneError(message, field="core.radius")
        z, y = foot + (wide / sine - (wide - radius)) * up
        return float(y), float(z)

    def ramp(self, z: float, radius: float) -> tuple[float, float]:
        """Where a cylinder along X lies on the left flank, between its lip and its foot.

        Args:
            z: Of the axis [m].
            radius: Of the cylinder [m].

        Returns:
            y and z of its axis [m].
        """
        closest = self._groove().closest
        low, high = self.bottom[0], 0.1
        # The distance from the groove grows with y above any z: halve the interval to round-off.
        while (middle := 0.5 * (low + high)) not in (low, high):
            distance = float(closest(np.array([[0.0, middle, z]])).distance[0])
            low, high = (middle, high) if distance < radius else (low, middle)
        return high, z

    def _groove(self) -> Groove:
        return Groove.v(self.beta_left, self.beta_right, self.half_width, self.depth, fillet=self.fillet)

    def _corner(self) -> tuple[Array, Array, Array]:
        """The foot of the right flank between the points beside it, (z, y) each."""
        profile = np.asarray(self._groove().profile)
        k = len(profile) - 3
        return profile[k - 1], profile[k], profile[k + 1]
