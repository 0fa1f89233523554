"""Faults in the weak form, and what kills them."""

from __future__ import annotations

from tests.mutations import form_faults as f
from tests.mutations.mutation import Mutation

MUTATIONS = (
    Mutation(
        "a dropped quadrature point, planar",
        "the last Gauss point of the weak form has no weight",
        "planar P2",
        "small deflection",
        f.POINT_LOST,
        True,
        True,
    ),
    Mutation("a dropped quadrature point, spatial", "the same", "spatial P2", "order", f.POINT_LOST, True, True),
    Mutation(
        "transposed direction cosines, planar",
        "R(φ)ᵀ in all strains",
        "planar P2",
        "case rollup-0.5",
        f.ROTATION_TRANSPOSED,
        True,
        True,
    ),
    Mutation(
        "transposed direction cosines, spatial",
        "R(p)ᵀ in all strains",
        "spatial P2",
        "balance",
        f.ROTATION_TRANSPOSED,
        True,
        True,
    ),
    Mutation(
        "unit norm in the mean",
        "|p| = 1 over Gauss points, not at the nodes",
        "spatial P2",
        "number of steps",
        f.GAUGE_ON_GAUSS_POINTS,
        True,
        True,
    ),
    Mutation(
        "curvature in space",
        "κ = 2 Im(p′ p̄) in place of 2 Im(p̄ p′)",
        "spatial P2",
        "balance",
        f.CURVATURE_IN_SPACE,
        True,
        True,
    ),
    Mutation(
        "R in place of Rᵀ in the energy",
        "½ n·C n with n = R N",
        "planar P2",
        "case elastica-10-shear",
        f.FORCE_TURNED_FORWARD,
        True,
        True,
    ),
    Mutation(
        "bending energy without ½", "twice the compliance", "planar P2", "small deflection", f.WITHOUT_HALF, True, True
    ),
    Mutation(
        "sections that do not turn", "γ = r′ − r₀′", "planar P2", "case follower-5", f.NORMAL_NOT_TURNED, True, True
    ),
    Mutation(
        "rotation not divided by |p|²",
        "R grows between the nodes; same order, larger error",
        "spatial P2",
        "accuracy",
        f.NOT_DIVIDED,
        True,
        True,
    ),
)
