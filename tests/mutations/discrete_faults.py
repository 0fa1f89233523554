"""Faults in the discrete model."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import discrete.corotation
import discrete.element
import discrete.endforces
import discrete.frames
import discrete.increments
import discrete.loads
import discrete.mesh
import discrete.nodeframe
import discrete.record
import discrete.solver
import discrete.supports
import dolfinrod as dr
from discrete.corotation import ChordElement
from discrete.equilibrium import Equilibrium
from discrete.increments import Increments
from discrete.loads import LoadLevel, Loads
from discrete.mesh import Elements
from discrete.nodeframe import EnergyNodeElement, PaperElement
from discrete.supports import Turn
from discrete.unknowns import SPIN, X
from tests.mutations.planting import Plant, all_of, replaced
from tests.scenes import Array


def swapped(matrix: Array) -> Array:
    return np.swapaxes(matrix, -1, -2)


def _coupling_of_one_sign(patch: Any) -> None:
    patch.setattr(discrete.element, "_COUPLING_W", -discrete.element._COUPLING_W)


def _straight(right: Any, *args: Any) -> Elements:
    """Both ends as the first: the element is taken to be straight and free of twist in the reference."""
    elements = right(*args)
    return replace(elements, attached=np.repeat(elements.attached[:, :1], 2, axis=1))


def _triads_from_the_left(_right: Any, self: Elements, R: Array) -> Array:
    return self.attached @ np.stack([R[self.node_i], R[self.node_i + 1]], axis=1)


def _following(right: Any, scene: dr.Scene, mesh: Any) -> Loads:
    """Every dead moment becomes one that is fixed to its section."""

    def fixed(load: Any) -> Any:
        if not isinstance(load, dr.PointMoment):
            return load
        ((rod, s),) = scene.location(load.at, load.rod)
        R_0 = scene.rods[rod].frames(s)
        return dr.FollowerMoment(tuple(R_0.T @ load.moment), load.at, rod=load.rod, history=load.history)

    return right(replace(scene, loads=[fixed(load) for load in scene.loads]), mesh)


def _unloaded_end(right: Any, self: Loads, t: float) -> LoadLevel:
    """The last node gets half of its share of the line loads."""
    level = right(self, t)
    level.dead[-1, X] -= 0.25 * level.line[-1]
    return level


def _whole_line_load(right: Any, self: Loads, load: Any) -> Array:
    """Where a line load begins and ends is not asked."""
    return right(self, replace(load, between=None) if isinstance(load, dr.LineForce) else load)


def _turned_again(right: Any, mesh: Any, R: Array, forces: Any, path: Any) -> tuple[Array, Array]:
    """R in place of Rᵀ: force in the section frame is R·N."""
    n, m = right(mesh, R, forces, path)
    return np.einsum("tkij,tkjl,tkl->tki", R, R, n), m


def _moment_of_i_not_turned_over(right: Any, mesh: Any, R: Array, forces: Any, path: Any) -> tuple[Array, Array]:
    spin = slice(3, 6)
    wrong = [force.copy() for force in forces]
    for force in wrong:
        force[:, spin] *= -1.0
    return right(mesh, R, wrong, path)


def _without_axial_force(right: Any, deformed: Any, μ: Array, m: Array, f: Array, *rest: Any) -> Array:
    """Tangent of the chord element without the turning of F_n."""
    sideways = f.copy()
    sideways[1, 0] = 0.0
    return right(deformed, μ, m, sideways, *rest)


def _transposed_axes(right: Any, *args: Array) -> tuple[Array, Array]:
    length, T = right(*args)
    return length, np.swapaxes(T, 0, 1)


def _stretch_without_turning(right: Any, self: Any, force: Array, tangent: Array, e: Array, F_n: Array) -> None:
    """The same of the element in the frame of node i."""
    right(self, force.copy(), tangent, e, 0.0 * F_n)
    right(self, force, tangent.copy(), e, F_n)


def _no_string(right: Any, self: PaperElement, elements: Elements) -> None:
    right(self, elements)
    self._l = np.full_like(self._l, np.inf)


def _section_spins(right: Any, self: Equilibrium, state: Any, d: Array, *rest: Any) -> Any:
    """Spins are taken for components in the section frame."""
    turned = d.copy()
    turned[:, SPIN] = np.matmul(state.R, d[:, SPIN, None])[:, :, 0]
    return right(self, state, turned, *rest)


def _first_axes(right: Any, self: Increments, _x: Array, _R: Array) -> Array:
    """Axes of the elements kept from the beginning."""
    return right(self, self.mesh.x, self.mesh.R)


FOUR_TIMES_EA = replaced(discrete.mesh, "_axial_stiffness", lambda f, rod: 4.0 * f(rod))
COUPLING: Plant = _coupling_of_one_sign
STRAIGHT = replaced(discrete.mesh, "_elements", _straight)
R_0_LEFT = replaced(Elements, "triads", _triads_from_the_left)
FOLLOWING_MOMENT = replaced(discrete.solver, "Loads", _following)
FIRST_AXES = replaced(Increments, "_axes", _first_axes)
NO_STRING_LETTER = replaced(PaperElement, "__init__", _no_string)
NO_STRING_INCREMENTS = replaced(discrete.increments, "_string", lambda f, stress: 0.0 * f(stress))
NO_STRING_CHORD = replaced(discrete.corotation, "end_tangents", _without_axial_force)
NO_STRING_NODE = replaced(EnergyNodeElement, "_stretch", _stretch_without_turning)
TRANSPOSED_CHORD = replaced(discrete.endforces, "_axes", _transposed_axes)
TRANSPOSED_NODE = replaced(discrete.nodeframe, "direction_cosines", lambda _f, triad: triad)
TRANSPOSED_INCREMENTS = replaced(discrete.increments, "direction_cosines", lambda _f, triad: triad)
TRANSPOSED_INERTIA = replaced(discrete.frames, "inertia", lambda f, J, A: f(J, swapped(A)))
EI_SWAPPED = replaced(discrete.mesh, "stiffness", lambda f, *, EI_v, EI_w, **rest: f(EI_v=EI_w, EI_w=EI_v, **rest))
DEAD_FOLLOWER = replaced(LoadLevel, "_turned", lambda _f, self, _R: self.follower)
NO_FOLLOWER_TANGENT = replaced(LoadLevel, "stiffness", lambda f, self, R: 0.0 * f(self, R))
HALF_END = replaced(Loads, "level", _unloaded_end)
WHOLE_LINE_LOAD = replaced(Loads, "_per_element", _whole_line_load)
R_IN_N = replaced(discrete.record, "_resultants", _turned_again)
MOMENT_SIGN = replaced(discrete.record, "_resultants", _moment_of_i_not_turned_over)
ROTATIONS_REVERSED = all_of(
    replaced(Turn, "frame", lambda f, self, factors: f(_reversed(self), factors)),
    replaced(Turn, "spin", lambda f, self, factors, change: f(_reversed(self), factors, change)),
)
HISTORY_SQUARED = replaced(discrete.loads, "factor", lambda f, *args: f(*args) ** 2)
MOTION_SQUARED = replaced(discrete.supports, "factor", lambda f, *args: f(*args) ** 2)
SECTION_SPINS = replaced(Equilibrium, "_moved", _section_spins)
HALF_ENERGY = replaced(ChordElement, "measure", lambda f, self, *state: (f(self, *state)[0], 2.0 * f(self, *state)[1]))
COMPRESSION_POSITIVE = replaced(ChordElement, "axial", lambda f, self, *state: -f(self, *state))


def _reversed(turn: Turn) -> Turn:
    return replace(turn, which=turn.which[::-1], theta=turn.theta[::-1])
