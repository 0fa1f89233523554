"""Faults in the continuum model but for its weak form, and what kills them."""

from __future__ import annotations

from tests.mutations import continuum_faults as c
from tests.mutations.mutation import Mutation

MUTATIONS = (
    Mutation("4× axial stiffness, planar", "1/4EA", "planar", "stretch of a pulled rod", c.FOUR_TIMES_EA),
    Mutation("4× axial stiffness, spatial", "the same", "spatial", "stretch of a pulled rod", c.FOUR_TIMES_EA),
    Mutation(
        "κ₀ ignored, planar",
        "strains of an arc counted from the straight rod",
        "planar",
        "a curved rod at rest",
        c.STRAIGHT,
    ),
    Mutation("κ₀ ignored, spatial", "the same of a helix", "spatial", "a twisted rod at rest", c.STRAIGHT),
    Mutation(
        "R₀ on the wrong side, frames", "R₀ R(p) in place of R(p) R₀", "spatial", "objectivity", c.FRAMES_R_0_LEFT
    ),
    Mutation(
        "R₀ on the wrong side, compliance",
        "R₀ᵀ C R₀ in place of R₀ C R₀ᵀ",
        "spatial",
        "objectivity",
        c.COMPLIANCE_TURNED_BACK,
    ),
    Mutation(
        "gauge kept from the last step, multiplier",
        "an unknown with a history, not balanced at each state",
        "spatial",
        "quadratic convergence of the roll-up",
        c.MULTIPLIER_KEPT,
    ),
    Mutation(
        "gauge kept from the last step, normal",
        "multipliers balance the residual along the quaternions of the last step",
        "spatial",
        "quadratic convergence of the roll-up",
        c.GAUGE_KEPT,
    ),
    Mutation("quaternion not normalised", "a turn is added, p + δp", "spatial", "orthonormal frames", c.NOT_NORMALISED),
    Mutation("half angle forgotten", "a turn goes twice as far", "spatial", "small twist", c.TURNED_TWICE, slow=True),
    Mutation(
        "dead moment treated as follower, continuum",
        "moments turn with their sections",
        "spatial",
        "balance",
        c.FOLLOWING_MOMENT,
    ),
    Mutation(
        "a dropped quadrature point, read-out",
        "the last Gauss weight is zero in moments and energy",
        "spatial",
        "energy is work",
        c.WEIGHT_LOST,
    ),
    Mutation(
        "a dropped quadrature point, method of sections",
        "the same in a plane",
        "planar",
        "moment along the rod",
        c.WEIGHT_LOST,
    ),
    Mutation(
        "transposed direction cosines, continuum",
        "Rᵀ v wherever a quaternion turns a vector",
        "spatial",
        "order of rotations",
        c.TRANSPOSED,
    ),
    Mutation(
        "F_n/l dropped, continuum",
        "tangent without what forces do as sections turn",
        "spatial",
        "quadratic convergence",
        c.NO_GEOMETRIC_STIFFNESS,
    ),
    Mutation(
        "F_n/l dropped, planar",
        "the same",
        "planar",
        "quadratic convergence under a follower",
        c.NO_GEOMETRIC_STIFFNESS,
    ),
    Mutation("GA₂ and GA₃ exchanged, planar", "shear along d2 by GA₃", "planar", "small deflection", c.GA_SWAPPED),
    Mutation("GA₂ and GA₃ exchanged, spatial", "the same", "spatial", "small deflection", c.GA_SWAPPED),
    Mutation("EI₂ and EI₃ exchanged, planar", "bending about d2 by EI₃", "planar", "small deflection", c.EI_SWAPPED),
    Mutation("EI₂ and EI₃ exchanged, spatial", "the same", "spatial", "small deflection", c.EI_SWAPPED),
    Mutation("sign of the spin, planar", "dead moments turn the other way", "planar", "case rollup-0.5", c.SPIN_SIGN),
    Mutation("sign of the spin, spatial", "the same", "spatial", "small twist", c.SPIN_SIGN),
    Mutation(
        "follower force dead, planar",
        "it keeps its direction in the reference",
        "planar",
        "case follower-5",
        c.DEAD_FOLLOWER,
    ),
    Mutation("follower force dead, spatial", "the same", "spatial", "balance", c.DEAD_FOLLOWER),
    Mutation(
        "follower tangent missing, continuum",
        "the load does not turn in the tangent",
        "spatial",
        "quadratic convergence",
        c.NO_FOLLOWER_TANGENT,
    ),
    Mutation(
        "sign of the follower tangent",
        "it turns the other way there",
        "spatial",
        "quadratic convergence",
        c.FOLLOWER_TANGENT_SIGN,
    ),
    Mutation(
        "half weight at the end, continuum", "the last node carries half of its share", "spatial", "weight", c.HALF_END
    ),
    Mutation("half weight at the end, planar", "the same of a line load", "planar", "line load", c.HALF_END),
    Mutation(
        "line load off its place, continuum",
        "between= is not asked",
        "planar",
        "small deflection under a line load",
        c.WHOLE_LINE_LOAD,
    ),
    Mutation(
        "weight of another rod", "every rod weighs what the first one weighs", "planar", "weight", c.FIRST_ROD_WEIGHS
    ),
    Mutation("R in place of Rᵀ in n, continuum", "n = R N", "spatial", "force along the rod", c.R_IN_N),
    Mutation("sign in the method of sections", "M′ = +r′ × N", "spatial", "moment along the rod", c.SECTIONS_SIGN),
    Mutation(
        "strain energy without ½, continuum",
        "twice the energy in the record",
        "planar",
        "energy is work",
        c.TWICE_THE_ENERGY,
    ),
    Mutation(
        "order of prescribed rotations, continuum",
        "the first one listed comes last",
        "spatial",
        "order of rotations",
        c.ROTATIONS_REVERSED,
    ),
    Mutation("load factor squared, continuum", "of point loads", "spatial", "half way", c.LOAD_SQUARED),
    Mutation("line load factor squared", "of line loads", "planar", "half way", c.LINE_LOAD_SQUARED),
    Mutation("motion factor squared, continuum", "of prescribed motions", "planar", "half way", c.MOTION_SQUARED),
    Mutation(
        "normal of the plane flipped",
        "moments and rotations count from the other side",
        "planar",
        "planar is spatial",
        c.NORMAL_FLIPPED,
    ),
)
