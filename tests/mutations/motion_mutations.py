"""Faults in the motion of both models, and what kills them."""

from __future__ import annotations

from tests.mutations import motion_faults as m
from tests.mutations.mutation import Mutation

MUTATIONS = (
    Mutation("ω × Jω dropped, discrete", "the moment of inertia is J α alone", "discrete", "free top", m.NO_GYROSCOPIC),
    Mutation(
        "ω × Jω dropped, continuum",
        "momentum is carried along by the section",
        "spatial",
        "free top",
        m.NO_GYROSCOPIC_TERM,
    ),
    Mutation("J* not rotated, discrete", "J* α in space", "discrete", "spun up", m.HELD_IN_SPACE),
    Mutation(
        "J* not rotated, continuum",
        "J stays in space as the sections turn",
        "spatial",
        "free top",
        m.INERTIA_HELD_IN_SPACE,
    ),
    Mutation("J* not rotated, midpoint", "the same", "spatial", "free top by midpoint", m.INERTIA_HELD_IN_SPACE),
    Mutation("wrong end-node mass, discrete", "the mass of a whole element", "discrete", "fall", m.WHOLE_ENDS),
    Mutation("wrong end-node mass, inside", "inner nodes get half of theirs", "discrete", "fall", m.HALF_INSIDE),
    Mutation("wrong end-node mass, continuum", "twice the Gauss-Lobatto weight", "spatial", "fall", m.WHOLE_END_NODES),
    Mutation(
        "wrong end-node mass, between elements",
        "the weight of one of the two",
        "spatial",
        "fall by midpoint",
        m.HALF_BETWEEN,
    ),
    Mutation(
        "momentum at the wrong time level, spin",
        "Ω × J Ω at the start of the step",
        "discrete",
        "energy of a free top",
        m.GYROSCOPIC_BEFORE,
    ),
    Mutation("momentum at the wrong time level, positions", "x₁ = x₀ + Δt v₀", "discrete", "fall", m.CARRIED_BEFORE),
    Mutation(
        "momentum at the wrong time level, midpoint",
        "moments of momentum in the middle of the step at both of its ends",
        "spatial",
        "moment of momentum",
        m.MEAN_MOMENTUM,
    ),
    Mutation(
        "momentum at the wrong time level, velocity",
        "that of the middle at the end",
        "spatial",
        "fall by midpoint",
        m.MEAN_VELOCITY,
    ),
    Mutation("sign of the drag, discrete", "air pushes what moves", "discrete", "terminal speed", m.PUSHED_BY_AIR),
    Mutation("sign of the drag, continuum", "the same", "spatial", "terminal speed", m.AIR_PUSHES),
    Mutation("gravity counted twice, discrete", "2 ρA g", "discrete", "fall", m.TWICE_THE_WEIGHT),
    Mutation("gravity counted twice, continuum", "the same", "spatial", "fall by midpoint", m.WEIGHT_TWICE),
    Mutation(
        "damping without rate, discrete", "the strain itself over Δt, not its change", "discrete", "settled", m.NO_RATE
    ),
)
