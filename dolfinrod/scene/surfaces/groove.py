"""A groove of any cross-section, straight or around a roller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, pi, tan

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.errors import SceneError
from dolfinrod.scene.quantity import UNIT, Vector, VectorLike, assign, direction, nonnegative, positive, vector
from dolfinrod.scene.surfaces.faces import parts
from dolfinrod.scene.surfaces.nearest import beside_groove
from dolfinrod.scene.surfaces.polyline import points, refuse_axis
from dolfinrod.scene.surfaces.profile import Profile
from dolfinrod.scene.surfaces.sections import flanked, rounded
from dolfinrod.scene.surfaces.surface import Closest
from dolfinrod.scene.surfaces.wall import WallMotion, moving

__all__ = ["Groove"]

Array = NDArray[np.float64]
X, Y, ORIGIN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0)
# The paper gives the angle alone, 15°, and not what it is measured from; widths and depths are our own assumptions.
GENTLE, STEEP = pi / 12, 5 * pi / 12
HALF_WIDTH = 1.5e-3
DEPTH = HALF_WIDTH * tan(GENTLE)
BOTTOM = 1e-3


@dataclass(frozen=True)
class Groove:
    """A wall whose cross-section is a polyline, the rods on its left, the same all along `axis`.

    The section lies in the plane of z = axis × up, to the right, and y along `up`: from the left to the right land the
    rods are above it. Its first and last flanks go on without end. φ is the distance to the nearest piece; around a lip
    the normal fans out and the curvature is 1/φ. In a sharp corner the normal jumps from one flank to the other, so
    that a rod which touches both finds no equilibrium: a `fillet` wider than the rod, or a contact a face, holds it.

    With a `roller` the section goes around instead: y is the height above a roller whose axis, along z, is that far
    below `point`, and `axis` is the direction around it there.

    Args:
        profile: Points (z, y) of the section, at least two [m].
        point: Where its (0, 0) is [m].
        axis: Along the groove, of any length.
        up: Out of the wall, of any length; its part along `axis` is left out.
        fillet: Radius that rounds re-entrant corners; 0: they stay sharp [m].
        roller: Radius of the roller; None: the groove is straight [m].
        motion: How it moves; None: not at all.

    Raises:
        SceneError: A polyline that meets itself or the roller's axis, a fillet without room, `up` along `axis`.
    """

    profile: Sequence[VectorLike]
    point: VectorLike = ORIGIN
    axis: VectorLike = X
    up: VectorLike = Y
    fillet: float = 0.0
    roller: float | None = None
    motion: WallMotion | None = None

    def __post_init__(self) -> None:
        (axis, up), profile = _upright(self.axis, self.up), points(self.profile)
        assign(
            self,
            profile=profile,
            point=vector(self.point, "Groove.point", "m"),
            axis=axis,
            up=up,
            fillet=nonnegative(self.fillet, "Groove.fillet", "m"),
            roller=None if self.roller is None else positive(self.roller, "Groove.roller", "m"),
            motion=moving(self.motion, "Groove.motion"),
        )
        if self.roller is not None:
            refuse_axis(profile, self.roller)
        _ = self._section  # so that what bounds no wall is refused here, not where the rods first ask

    @classmethod
    def v(
        cls,
        beta_left: float,
        beta_right: float,
        half_width: float,
        depth: float | None = None,
        point: VectorLike = ORIGIN,
        axis: VectorLike = X,
        up: VectorLike = Y,
        fillet: float = 0.0,
        roller: float | None = None,
        motion: WallMotion | None = None,
    ) -> Groove:
        """Two flanks between lands at y = 0; where it is less deep than they meet, with a flat bottom.

        Args:
            beta_left: Angle of the left flank to the lands, up to π/2 [rad].
            beta_right: Likewise.
            half_width: From the left lip to the foot of the right flank, which is at z = 0 [m].
            depth: Of the bottom; None: where the flanks meet, half_width tan(beta_left) [m].
            point: This and what follows as `Groove`.
            axis: Likewise.
            up: Likewise.
            fillet: Likewise.
            roller: Likewise.
            motion: Likewise.

        Returns:
            The groove.
        """
        return cls(flanked(beta_left, beta_right, half_width, depth), point, axis, up, fillet, roller, motion)

    @classmethod
    def round(
        cls,
        radius: float,
        depth: float | None = None,
        point: VectorLike = ORIGIN,
        axis: VectorLike = X,
        up: VectorLike = Y,
        roller: float | None = None,
        motion: WallMotion | None = None,
    ) -> Groove:
        """An arc of a circle between lands at y = 0, under upright walls where it is deeper than its radius.

        Without a depth [m] it is as deep as its radius [m], half a circle; the rest as `Groove`.
        """
        profile, fillet = rounded(radius, depth)
        return cls(profile, point, axis, up, fillet, roller, motion)

    @classmethod
    def intermediate(
        cls,
        beta: float = GENTLE,
        half_width: float = HALF_WIDTH,
        point: VectorLike = ORIGIN,
        axis: VectorLike = X,
        up: VectorLike = Y,
        fillet: float = 0.0,
        roller: float | None = None,
        motion: WallMotion | None = None,
    ) -> Groove:
        """A symmetric V for fibres that enter in the middle: our assumption, the paper gives no section.

        Both flanks slope by beta [rad] from lip to bottom over half_width [m]; the rest as `Groove`.
        """
        return cls.v(beta, beta, half_width, None, point, axis, up, fillet, roller, motion)

    @classmethod
    def lateral(
        cls,
        beta_left: float = GENTLE,
        beta_right: float = STEEP,
        half_width: float = HALF_WIDTH,
        point: VectorLike = ORIGIN,
        axis: VectorLike = X,
        up: VectorLike = Y,
        fillet: float = 0.0,
        roller: float | None = None,
        motion: WallMotion | None = None,
    ) -> Groove:
        """A gentle ramp against a steep wall for fibres that enter from the left: our assumption, not the paper's.

        Reads its lateral angle of 15° as that between ramp and surface. Arguments as `Groove.v`.
        """
        return cls.v(beta_left, beta_right, half_width, None, point, axis, up, fillet, roller, motion)

    @classmethod
    def lateral_steep(
        cls,
        beta_left: float = STEEP,
        beta_right: float = STEEP,
        half_width: float = BOTTOM + DEPTH * tan(GENTLE),
        depth: float = DEPTH,
        point: VectorLike = ORIGIN,
        axis: VectorLike = X,
        up: VectorLike = Y,
        fillet: float = 0.0,
        roller: float | None = None,
        motion: WallMotion | None = None,
    ) -> Groove:
        """A flat bottom between steep walls: our assumption, too, the other reading of the paper's lateral angle.

        Its 15° are those between wall and normal here. Arguments as `Groove.v`.
        """
        return cls.v(beta_left, beta_right, half_width, depth, point, axis, up, fillet, roller, motion)

    def faces(self) -> tuple[Groove, ...]:
        """One surface for each part between re-entrant corners, so that each bears a rod by a force of its own.

        The least of their distances is that of the groove wherever rods may be, but for the fillet, which is left out:
        rods thicker than it do not reach it.

        Raises:
            SceneError: A part that cannot go on straight behind the others.
        """
        polylines = parts(np.asarray(self.profile), self.roller)
        return tuple(replace(self, profile=polyline, fillet=0.0) for polyline in polylines)

    @cached_property
    def _section(self) -> Profile:
        return Profile.through(np.asarray(self.profile), self.fillet)

    @cached_property
    def _given(self) -> tuple[Array, Array, float, Array, Array, Array, Array, Array, float]:
        """What `beside_groove` is told of it."""
        axis, up = np.asarray(self.axis), np.asarray(self.up)
        roller = inf if self.roller is None else self.roller
        return np.asarray(self.point), np.stack([axis, np.cross(axis, up), up]), roller, *self._section.pieces

    def closest(self, x: Array) -> Closest:
        """See `Surface.closest`.

        The curvature around a roller is n_y/ρ with the distance ρ to its axis; on the axis it is taken as zero.
        """
        return Closest(*beside_groove(np.ascontiguousarray(x), *self._given))


def _upright(axis: VectorLike, up: VectorLike) -> tuple[Vector, Vector]:
    """Unit vectors along a groove and across it, out of the wall; already orthonormal ones unchanged."""
    a, b = direction(axis, "Groove.axis"), direction(up, "Groove.up")
    if np.linalg.norm(np.cross(a, b)) <= 1e-6:
        raise SceneError(f"must not be along Groove.axis {axis}, got {up}", field="Groove.up")
    # Twice, for the digits the first projection loses where up leans towards the axis.
    for _ in range(2):
        if abs(np.dot(a, b)) > UNIT:
            b = direction(np.asarray(b) - np.dot(a, b) * np.asarray(a), "Groove.up")
    return a, b
