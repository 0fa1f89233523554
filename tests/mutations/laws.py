"""Laws that faults break."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

import dolfinrod as dr
from tests.mutations import contact_measures as touching
from tests.mutations import measures as by
from tests.mutations import meeting_answers as answers
from tests.mutations import meeting_measures as meeting
from tests.mutations import motions as moving
from tests.mutations import twist_measures as twisting
from tests.mutations.contact_scenes import ROUGH
from tests.mutations.measures import Solve
from tests.mutations.scenes import CURVED, TWISTED, loaded_in_a_plane, loaded_in_every_way
from tests.scenes import KIRCHHOFF, SKEW, followed
from verification.case import SKEW as CASE_POSE
from verification.cases import bend45, elastica, follower, rollup


@dataclass(frozen=True)
class Law:
    """Something that every correct model obeys.

    Args:
        statement: What holds, in words.
        measure: Solves, and returns by how much it does not hold.
        bound: What that may be.
    """

    statement: str
    measure: Callable[[Solve], float]
    bound: float

    def holds(self, solve: Solve) -> tuple[bool, float]:
        """Whether it holds for a solver, and the number measured; infinite where there is no answer at all."""
        try:
            found = self.measure(solve)
        except dr.NotConverged:
            found = np.inf
        return found <= self.bound, found


LAWS = {
    "stretch of a pulled rod": Law("u = F L/EA", by.stretch, 1e-8),
    "small deflection": Law(
        "w = F L³/3EI + F L/GA in both planes of a section, and nothing else", by.small_deflection, 1e-5
    ),
    "small deflection under a line load": Law("w = q (b³/6 − b⁴/24)/EI", by.small_line_load, 1e-2),
    "small twist": Law("θ = T L/GJ", by.small_twist, 1e-6),
    "string": Law("under tension w = F/T (L − tanh(kL)/k), k² = T/EI", by.string, 1e-2),
    "a curved rod at rest": Law("an arc without load stays as it is", partial(by.rest, CURVED), 1e-10),
    "a twisted rod at rest": Law("a helix with pretwist stays as it is", partial(by.rest, TWISTED), 1e-10),
    "objectivity": Law("a moved scene has the moved answer", partial(by.objectivity, loaded_in_every_way), 1e-9),
    "objectivity in a plane": Law("the same for a plane scene", partial(by.objectivity, loaded_in_a_plane), 1e-9),
    "balance": Law("the clamp answers with the force and moment of all loads", by.balance, 1e-9),
    "weight": Law("each clamp carries the weight of its rod", partial(by.weights, "gravity"), 1e-9),
    "line load": Law("each clamp carries the whole line load", partial(by.weights, "line"), 1e-9),
    "force along the rod": Law("R n is the dead tip force everywhere", by.force_along, 1e-9),
    "moment along the rod": Law("R m is the arm times the dead tip force everywhere", by.moment_along, 1e-9),
    "orthonormal frames": Law("RᵀR = 1 at all nodes", by.orthonormal, 1e-12),
    "half way": Law("at half of the time the answer is that to half of the loads and displacements", by.half_way, 1e-9),
    "number of steps": Law("one load step or eight end the same", by.same_in_steps, 1e-9),
    "planar is spatial": Law("a plane scene has one answer in the plane and in space", by.same_in_space, 1e-5),
    "order of rotations": Law("prescribed rotations follow each other in the order listed", by.composition, 1e-12),
    "energy is work": Law("U = ½ F·u for a small force", by.work, 1e-6),
    "mirror": Law("mirrored loads have the mirrored answer", by.mirror, 1e-10),
    "quadratic convergence": Law(
        "loads of every kind in space, all at once: at most 7 iterations",
        partial(by.iterations, loaded_in_every_way(SKEW)),
        7,
    ),
    "quadratic convergence under a follower": Law(
        "α = 5 at once: at most 8 iterations", partial(by.iterations, followed(KIRCHHOFF, 5.0)), 8
    ),
    "quadratic convergence of the roll-up": Law(
        "one turn in space at once: at most 8 iterations",
        partial(by.iterations, rollup.rolled(1.0).scene(CASE_POSE)),
        8,
    ),
    "inertia": Law("the energy of a rotation is the same in section and global axes, Eq. 10", by.inertia, 1e-12),
    "order": Law("the tip of the elastica converges with h⁴ for k = 2", by.lost_order, 0.3),
    "case follower-5": Law("within three digits of the reference", partial(by.error, follower.inextensible(5.0)), 3e-3),
    "accuracy": Law("for k = 2 the elastica is in space no less accurate than in the plane", by.lost_accuracy, 1.0),
    "case elastica-10-shear": Law(
        "within four digits of the reference", partial(by.error, elastica.shearable(10.0)), 1e-4
    ),
    "case rollup-0.5": Law("the same", partial(by.error, rollup.rolled(0.5)), 3e-3),
    "case bend45-300-kirchhoff": Law("the same", partial(by.error, bend45.bend(300.0, kirchhoff=True)), 3e-3),
    "free top": Law("a free rod turns as Euler's equations say, K7", partial(moving.top, moving.EULER), 5e-3),
    "free top by midpoint": Law("the same", partial(moving.top, moving.MIDPOINT), 5e-3),
    "spun up": Law("R J Rᵀ ω = M t in mean while a free rod has hardly turned", moving.spun_up, 5e-3),
    "energy of a free top": Law("backward Euler adds none", moving.energy_gained, 0.0),
    "moment of momentum": Law("a free rod keeps it by the midpoint rule", moving.moment_of_momentum, 1e-9),
    "fall": Law("every point of a free rod falls by ½ g t (t + Δt)", partial(moving.fall, moving.EULER), 1e-9),
    "fall by midpoint": Law("the same by ½ g t²", partial(moving.fall, moving.MIDPOINT), 1e-9),
    "terminal speed": Law("a level fibre falls through air at 0.08695 m/s", moving.terminal_speed, 1e-4),
    "settled": Law("a damped bar comes to rest at u = F L/EA", moving.settled, 1e-9),
    "lying": Law("p = q at every node, where the law has it", partial(touching.rests, None), 1e-8),
    "lying and rough": Law("the same with friction", partial(touching.rests, ROUGH), 1e-8),
    "held by friction": Law("u = t/ε_T and no slip, in four steps", partial(touching.sticks, dr.Static(steps=4)), 1e-8),
    "held by friction in motion": Law(
        "the same at rest at last", partial(touching.sticks, dr.Dynamic(1.0, 0.05, output=1.0)), 1e-8
    ),
    "drawn forth and back": Law("a wall takes along a rod held still by μ q, either way", touching.drawn_along, 1e-8),
    "moments of friction": Law("act at the surface of the rod", touching.moments, 1e-8),
    "carried along": Law("what sticks to a wall turns with it and is as before", touching.carried_along, 1e-8),
    "lifted": Law("a rod lifted from a wall is as if there had been none", touching.lifted_off, 1e-9),
    "few iterations on a drum": Law("a fifth more load at once: at most 5", touching.iterations, 5),
    "pressures of a hard wall": Law("p = ε (g_0 − g)", touching.presses, 1e-9),
    "slopes of contact": Law("are those of force and moment", touching.tangent, 1e-6),
    "landed": Law("t = ε_T times the way in touch", touching.lands, 1e-8),
    "penetration": Law("is within the tolerance of an augmented Lagrangian", touching.penetrates, 1.0),
    "tried again": Law("a step that fails leaves no trace in contact", touching.tries_again, 1e-12),
    "impact by midpoint": Law("leaves the energy that came", touching.bounces, 1e-8),
    "energy of contact": Law("½ ε δ² per length", touching.stores, 1e-9),
    "belt": Law("what it takes along gets v, and loses half of its work", touching.taken_along, 5e-3),
    "gone on": Law(
        "a solve interrupted and gone on with ends like a whole one",
        partial(touching.goes_on, dr.Static(steps=4)),
        1e-8,
    ),
    "gone on in motion": Law("the same", partial(touching.goes_on, dr.Dynamic(0.8, 0.05)), 1e-8),
    "signs of crossings": Law("Z where what lies on top goes to the right, S in its mirror", twisting.crosses, 0.0),
    "winding of strands": Law("is how often they were wound, Z positive", twisting.winds, 1e-9),
    "winding about an axis": Law("is how often the bundle was turned", twisting.turns_about_its_axis, 1e-9),
    "winding with a hook": Law("is that without it, where none is inside", twisting.winds_with_a_hook, 1e-9),
    "Lk = Tw + Wr": Law("is a whole number, of any polygon", twisting.linked, 1e-10),
    "twist that leaves": Law("is that of the strand that moves on", twisting.leaves, 1e-9),
    "third law of rods": Law(
        "forces between them and their moments add up to nothing", partial(meeting.third_law, None), 1e-12
    ),
    "third law of rough rods": Law("the same with couples of friction", partial(meeting.third_law, meeting.MU), 1e-12),
    "order of rods": Law("forces do not depend on which is named first", meeting.exchanged, 1e-12),
    "rods side by side": Law("press by ε δ along all of their length", meeting.side_by_side, 1e-9),
    "crossing rods": Law("press by ε ∫ (D₀ − D) d/D ds, wherever their nodes are", meeting.crossing, 1e-4),
    "a rod on itself": Law("touches where it is a hairpin, not where it is straight", meeting.loop, 0.0),
    "a rod from afar": Law("is felt where it comes to", meeting.comes, 1e-9),
    "held by a rod": Law("t = ε_T u, then μ p, against the way", meeting.holds, 1e-9),
    "gears": Law("rods that roll on each other do not rub", meeting.rolls, 1e-9),
    "turned together": Law("what sticks turns with the rods", meeting.turned_along, 1e-3),
    "landed on a rod": Law("t = ε_T times the way in touch", meeting.lands, 1e-9),
    "slopes of rods": Law("are those of forces, side by side", partial(meeting.slopes, 0.0, None, 1.0), 1e-8),
    "slopes of crossing rods": Law("the same across", partial(meeting.slopes, 1.0, None, 1.0), 1e-6),
    "slopes of rough rods": Law(
        "the same of forces and couples of what slides", partial(meeting.slopes, 0.0, meeting.MU, 0.5), 1e-8
    ),
    "work between rods": Law("of a mean load is what is stored, ½ ε δ² L", meeting.work, 1e-9),
    "remembered by rods": Law("a contact gone on with acts as if it had not been left", meeting.goes_on, 1e-12),
    "shots through rods": Law("are told from those that pass an end", meeting.passes, 0.0),
    "stacked": Law("what lies on a rod weighs on it, and on the floor", answers.weighs, 1e-9),
    "turned on a rod": Law("t = ε_T a θ, however many steps ago it was turned", answers.twists, 5e-3),
    "few iterations of crossed rods": Law("a fifth more load at once: at most 6", answers.iterations, 6),
}
