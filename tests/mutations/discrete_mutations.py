"""Faults in the discrete model, and what kills them."""

from __future__ import annotations

from tests.mutations import discrete_faults as d
from tests.mutations.mutation import Mutation

MUTATIONS = (
    Mutation(
        "4× axial stiffness",
        "elongation is a quarter of F l/EA",
        "discrete",
        "stretch of a pulled rod",
        d.FOUR_TIMES_EA,
    ),
    Mutation(
        "4× axial stiffness, increments",
        "the same without iterations",
        "discrete increments",
        "stretch of a pulled rod",
        d.FOUR_TIMES_EA,
    ),
    Mutation(
        "sign of the u–w coupling, frame of node i",
        "+6EI/l² in both planes of k*",
        "discrete node_i",
        "small deflection",
        d.COUPLING,
    ),
    Mutation(
        "sign of the u–w coupling, Eq. 18–22",
        "the same, the paper to the letter",
        "discrete letter",
        "small deflection",
        d.COUPLING,
    ),
    Mutation(
        "sign of the u–w coupling, increments",
        "the same without iterations",
        "discrete increments",
        "case bend45-300-kirchhoff",
        d.COUPLING,
    ),
    Mutation(
        "κ₀ ignored, arc",
        "elements take both ends for parallel in the reference",
        "discrete",
        "a curved rod at rest",
        d.STRAIGHT,
    ),
    Mutation(
        "κ₀ ignored, helix with pretwist",
        "the same in the frame of node i",
        "discrete node_i",
        "a twisted rod at rest",
        d.STRAIGHT,
    ),
    Mutation(
        "R₀ on the wrong side, element",
        "triads R₀ R in place of R R₀",
        "discrete",
        "objectivity in a plane",
        d.R_0_LEFT,
    ),
    Mutation("R₀ on the wrong side, frame of node i", "the same", "discrete node_i", "mirror", d.R_0_LEFT),
    Mutation(
        "gauge kept from the last step, axes",
        "increments keep the element axes of the first one",
        "discrete increments",
        "case bend45-300-kirchhoff",
        d.FIRST_AXES,
    ),
    Mutation(
        "dead moment treated as follower, discrete",
        "moments turn with their sections",
        "discrete",
        "balance",
        d.FOLLOWING_MOMENT,
    ),
    Mutation("transposed direction cosines, Eq. 10", "J = A J* Aᵀ", "discrete", "inertia", d.TRANSPOSED_INERTIA),
    Mutation(
        "transposed direction cosines, Eq. 19",
        "k = t k* tᵀ in the increments",
        "discrete increments",
        "small deflection",
        d.TRANSPOSED_INCREMENTS,
    ),
    Mutation(
        "transposed direction cosines, element",
        "forces turned by Tᵀ into global axes",
        "discrete",
        "small twist",
        d.TRANSPOSED_CHORD,
        slow=True,
    ),
    Mutation(
        "transposed direction cosines, Eq. 21",
        "deformation seen from the wrong side",
        "discrete letter",
        "small twist",
        d.TRANSPOSED_NODE,
        slow=True,
    ),
    Mutation(
        "F_n/l dropped, Eq. 18–22",
        "the force of the string is left out",
        "discrete letter",
        "case follower-5",
        d.NO_STRING_LETTER,
    ),
    Mutation(
        "F_n/l dropped, increments",
        "k* of Eq. 15 without F_n/l",
        "discrete increments",
        "string",
        d.NO_STRING_INCREMENTS,
    ),
    Mutation(
        "F_n/l dropped, element",
        "tangent without the turning of F_n",
        "discrete",
        "quadratic convergence",
        d.NO_STRING_CHORD,
    ),
    Mutation(
        "F_n/l dropped, frame of node i", "the same", "discrete node_i", "quadratic convergence", d.NO_STRING_NODE
    ),
    Mutation(
        "EI₂ and EI₃ exchanged, discrete", "EI about v bends about w", "discrete", "small deflection", d.EI_SWAPPED
    ),
    Mutation(
        "follower force dead, discrete",
        "it keeps its direction in the reference",
        "discrete",
        "balance",
        d.DEAD_FOLLOWER,
    ),
    Mutation(
        "follower tangent missing, discrete",
        "the load does not turn in the tangent",
        "discrete",
        "quadratic convergence",
        d.NO_FOLLOWER_TANGENT,
    ),
    Mutation(
        "half weight at the end, discrete", "the last node carries half of its share", "discrete", "weight", d.HALF_END
    ),
    Mutation(
        "line load off its place, discrete",
        "between= is not asked",
        "discrete",
        "small deflection under a line load",
        d.WHOLE_LINE_LOAD,
    ),
    Mutation("R in place of Rᵀ in n, discrete", "n = R N", "discrete", "force along the rod", d.R_IN_N),
    Mutation(
        "sign of the end moment at i",
        "internal moments averaged with opposite signs",
        "discrete",
        "moment along the rod",
        d.MOMENT_SIGN,
    ),
    Mutation(
        "order of prescribed rotations, discrete",
        "the first one listed comes last",
        "discrete",
        "order of rotations",
        d.ROTATIONS_REVERSED,
    ),
    Mutation("load factor squared, discrete", "of all loads", "discrete", "half way", d.HISTORY_SQUARED),
    Mutation("motion factor squared, discrete", "of prescribed motions", "discrete", "half way", d.MOTION_SQUARED),
    Mutation(
        "spin in section axes",
        "R exp(ω) in place of exp(ω) R",
        "discrete",
        "quadratic convergence",
        d.SECTION_SPINS,
        slow=True,
    ),
    Mutation(
        "strain energy without ½, discrete",
        "twice the energy in the record",
        "discrete",
        "energy is work",
        d.HALF_ENERGY,
    ),
    Mutation(
        "compression positive", "F_n = −N·u", "discrete", "force along the rod", d.COMPRESSION_POSITIVE, slow=True
    ),
)
