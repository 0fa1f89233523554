"""Faults in rods that touch rods, in the law that both models share and in what each makes of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from discrete.links import Links
from discrete.meeting import Encounters
from dolfinrod.continuum import links
from dolfinrod.continuum.pairs import Pairs
from dolfinrod.scene.meeting import coupling, meeting, neighbours, pressed, slipping, spots
from dolfinrod.scene.meeting.anchors import Anchors
from dolfinrod.scene.meeting.coupling import Felt
from dolfinrod.scene.meeting.meeting import Meeting
from dolfinrod.scene.meeting.neighbours import Neighbours
from dolfinrod.scene.rubbing import Rubbing
from tests.mutations.planting import replaced
from tests.scenes import Array


def _on_one_rod(right: Any, nodes: Array, h: Array, *rest: Any) -> Any:
    """What pushes the second rod is lost."""
    kept = h.copy()
    kept[:, h.shape[1] // 2 :] = 0.0
    return right(nodes, kept, *rest)


def _no_couples(right: Any, self: Meeting, *args: Any) -> Felt:
    """Friction acts at the centrelines."""
    felt: Felt = right(self, *args)
    return Felt(felt.force, 0.0 * felt.moment)


def _elsewhere(right: Any, course: Any, a: Any, u: Array, found: Any) -> Any:
    """The second rod is pushed beside the point of contact."""
    facing = right(course, a, u, found)
    M = facing.h.shape[1] // 2
    h = np.concatenate([facing.h[:, :M], -course.spans.weights(found.b, found.v + 0.1)], axis=1)
    return replace(facing, h=h)


def _not_projected(right: Any, course: Any, a: Any, u: Array, *run: Any) -> Any:
    """The closest point is taken a fifth of a span further."""
    found = right(course, a, u, *run)
    v = np.clip(found.v + 0.2, 0.0, 1.0)
    return replace(found, v=v, d=course.place(a, u) - course.place(found.b, v))


def _one_direction(right: Any, *args: Any, **options: Any) -> Any:
    """The first rod looks for the second only, and counts in full."""
    found = right(*args, **options)
    first = found.a < found.b
    return replace(found, length=np.where(first, 2.0 * found.length, 0.0))


def _from_centrelines(right: Any, self: Meeting, contact: Any, strands: Any, *args: Any, **options: Any) -> None:
    right(self, contact, replace(strands, radius=0.0 * strands.radius), *args, **options)


def _towards_the_slip(right: Any, *args: Any) -> Rubbing:
    rubbing: Rubbing = right(*args)
    return replace(rubbing, traction=-rubbing.traction)


def _no_anchors(right: Any, self: Anchors, *args: Any) -> Array:
    return np.zeros_like(right(self, *args))


def _weights_stay(right: Any, found: Any, *args: Any, **options: Any) -> Any:
    """Derivatives of the last answer as if weights did not change where the point opposite moves."""
    return right(replace(found, facing=replace(found.facing, h_v=0.0 * found.facing.h_v)), *args, **options)


def _opposite_stays(right: Any, found: Any, *args: Any, **options: Any) -> Any:
    """As if it did not move."""
    still = replace(found.facing.opposite, follow=0.0 * found.facing.opposite.follow)
    return right(replace(found, facing=replace(found.facing, opposite=still)), *args, **options)


def _facing_along(by: float) -> Any:
    """The normal times a number."""

    def wrong(right: Any, *args: Any) -> Any:
        facing = right(*args)
        return replace(facing, normal=by * facing.normal)

    return wrong


def _arms_exchanged(right: Any, found: Any, moved: Array, turn: Array, *rest: Any) -> Any:
    """Radii exchanged, and with them lever arms."""
    return right(replace(found, radius_a=found.radius_b, radius_b=found.radius_a), moved, turn, *rest)


def _astray(right: Any, *args: Any) -> Any:
    """Couples on the second rod are of the other sign."""
    slip = right(*args)
    lever = slip.ways.lever.copy()
    lever[:, lever.shape[1] // 2 :] *= -1.0
    return replace(slip, ways=slip.ways._replace(lever=lever))


def _transposed(right: Any, *args: Any) -> Array:
    blocks: Array = right(*args)
    return np.swapaxes(blocks, 1, 3)


def _at_the_ends(right: Any, *args: Any) -> Any:
    """At nodes only, wherever contact is."""
    found = right(*args)
    return replace(found, u=np.rint(found.u))


def _whole_spans(right: Any, *args: Any) -> tuple[Array, Array]:
    begin, end = right(*args)
    touched = end > begin
    return 0.0 * begin, 1.0 * touched


def _all_the_way(right: Any, *args: Any) -> tuple[Array, Array]:
    """What comes from afar has rubbed on all of its way."""
    share, share_gap = right(*args)
    return np.ones_like(share), 0.0 * share_gap


def _at_the_end(right: Any, *args: Any, mean: bool = False, **more: Any) -> Any:
    """The load after a step in place of the mean over it, on the rods half-way."""
    found = right(*args, mean=mean, **more)
    if not mean:
        return found
    p, slope = args[2].pressure(found.gap, np.zeros(len(found.gap)))
    return replace(found, p=p, slope=slope)


def _others_only(right: Any, course: Any, *args: Any) -> Array:
    """No rod touches itself."""
    found: Array = right(course, *args)
    rod = course.spans.rod[found]
    return found[rod[:, 0] != rod[:, 1]]


def _forgotten(_right: Any, self: Meeting, _memory: Any, x: Array, t: float) -> None:
    self.place(x, t)


def _half_linked(right: Any, *args: Any) -> Array:
    """Of what one rod answers to the way of the other, only what either direction says is in the tangent."""
    return np.asarray(0.5 * right(*args))


def _counted_twice(right: Any, self: Pairs, b: Array, q: Array) -> None:
    """What rods do to each other is added by two, as if each of them had reported all of it."""
    right(self, b, q)
    right(self, b, q)


def _turns_in_one(right: Any, self: Pairs) -> Any:
    before = self._q_0
    booked = right(self)
    self._q_0 = before
    return booked


def _discrete_twice(right: Any, self: Encounters, *args: Any) -> Array:
    return np.asarray(2.0 * right(self, *args))


def _discrete_turns_in_one(right: Any, self: Encounters, *args: Any) -> Any:
    before = self._R_0
    booked = right(self, *args)
    self._R_0 = before
    return booked


def _discrete_half_linked(right: Any, self: Links) -> tuple[Array, Array, Array]:
    rows, columns, values = right(self)
    return rows, columns, 0.5 * values


ON_ONE_ROD = replaced(meeting, "dealt", _on_one_rod)
NO_COUPLES = replaced(Meeting, "respond", _no_couples)
ELSEWHERE = replaced(pressed, "face", _elsewhere)
NOT_PROJECTED = replaced(pressed, "look", _not_projected)
ONE_DIRECTION = replaced(meeting, "load", _one_direction)
FROM_CENTRELINES = replaced(Meeting, "__init__", _from_centrelines)
NOT_UNIT = replaced(pressed, "face", _facing_along(1.1))
INWARDS = replaced(pressed, "face", _facing_along(-1.0))
TOWARDS_THE_SLIP = replaced(slipping, "rubbed", _towards_the_slip)
NO_ANCHORS = replaced(Anchors, "of", _no_anchors)
ANCHORS_IN_SPACE = replaced(slipping, "rotated", lambda _right, _turn, u: u)
WEIGHTS_STAY = replaced(meeting, "derivatives", _weights_stay)
OPPOSITE_STAYS = replaced(meeting, "derivatives", _opposite_stays)
ARMS_EXCHANGED = replaced(meeting, "slide", _arms_exchanged)
COUPLES_ASTRAY = replaced(meeting, "slide", _astray)
TRANSPOSED = replaced(coupling, "summed", _transposed)
AT_NODES = replaced(meeting, "points", _at_the_ends)
WHOLE_SPANS = replaced(spots, "intervals", _whole_spans)
ALL_THE_WAY = replaced(slipping, "_shares", _all_the_way)
AT_THE_END = replaced(meeting, "load", _at_the_end)
NOTHING_STORED = replaced(Meeting, "stored", lambda _right, _self: 0.0)
OTHERS_ONLY = replaced(neighbours, "near", _others_only)
KEPT_PAIRS = replaced(Neighbours, "holds", lambda _right, _self, _x: True)
FORGOTTEN = replaced(Meeting, "recall", _forgotten)
NEVER_THROUGH = replaced(meeting, "passes", lambda *_: False)
ALWAYS_THROUGH = replaced(meeting, "passes", lambda *_: True)

COUNTED_TWICE = replaced(Pairs, "add_residual", _counted_twice)
HALF_LINKED = replaced(links, "_between", _half_linked)
TURNS_IN_ONE = replaced(Pairs, "accept", _turns_in_one)
DISCRETE_TWICE = replaced(Encounters, "force", _discrete_twice)
DISCRETE_TURNS_IN_ONE = replaced(Encounters, "accept", _discrete_turns_in_one)
DISCRETE_HALF_LINKED = replaced(Links, "entries", _discrete_half_linked)
