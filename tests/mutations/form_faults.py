"""Faults in the weak form of the continuum model; each is compiled."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import basix
import pytest
import ufl

from dolfinrod.continuum import forms, quaternion, reference
from tests.mutations.planting import replaced


class _LastPointLost:
    """The measure, on a rule whose last Gauss point has no weight."""

    def __init__(self, **domain: Any) -> None:
        self._dx = ufl.dx(**domain)

    def __call__(self, *, metadata: dict[str, Any]) -> ufl.Measure:
        if "quadrature_points" in metadata:
            return self._dx(metadata=metadata)
        degree = metadata["quadrature_degree"]
        points, weights = basix.make_quadrature(reference.CELL, degree)
        return self._dx(
            metadata={
                "quadrature_rule": "custom",
                "quadrature_degree": degree,
                "quadrature_points": points.tolist(),
                "quadrature_weights": [*weights[:-1].tolist(), 0.0],
            }
        )


def _point_lost(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(forms, "ufl", SimpleNamespace(**{**vars(ufl), "dx": _LastPointLost}))


def _on_gauss_points(_right: Any, gauge: Any, nodes: ufl.Measure) -> ufl.Form:
    """|p| = 1 in the mean over the Gauss points, not at the nodes; for k = 2."""
    return gauge * ufl.dx(domain=nodes.ufl_domain(), metadata={"quadrature_degree": 4})


def _in_space(_right: Any, p: Any, p_s: Any) -> Any:
    """Curvature 2 Im(p′ p̄)/|p|² in space."""
    v, v_s = (ufl.as_vector([a[1], a[2], a[3]]) for a in (p, p_s))
    return 2 * (p[0] * v_s - p_s[0] * v + ufl.cross(v, v_s)) / ufl.inner(p, p)


def _force_turned_forward(right: Any, q: Any, C_n: Any, C_m: Any, r_0: Any) -> Any:
    """n = R N in the energy of stretch and shear."""
    n, wrong = q.R.T * q.N, q.R * q.N
    return right(q, C_n, C_m, r_0) + (ufl.inner(n, C_n * n) - ufl.inner(wrong, C_n * wrong)) / 2


def _without_half(right: Any, q: Any, C_n: Any, C_m: Any, r_0: Any) -> Any:
    return right(q, C_n, C_m, r_0) - ufl.inner(q.m, C_m * q.m) / 2


def _normal_not_turned(right: Any, q: Any, C_n: Any, C_m: Any, r_0: Any) -> Any:
    """γ = r′ − r₀′: every section stands as it does in the reference."""
    return right(q, C_n, C_m, r_0) + ufl.inner(q.N, q.R * r_0.dx(0) - r_0.dx(0))


POINT_LOST = _point_lost
GAUGE_ON_GAUSS_POINTS = replaced(forms, "node_condition", _on_gauss_points)
CURVATURE_IN_SPACE = replaced(quaternion, "curvature", _in_space)
NOT_DIVIDED = replaced(quaternion, "rotation", lambda f, p: ufl.inner(p, p) * f(p))
FORCE_TURNED_FORWARD = replaced(forms, "stored_energy", _force_turned_forward)
ROTATION_TRANSPOSED = replaced(forms, "stored_energy", lambda f, q, *rest: f(replace(q, R=q.R.T), *rest))
WITHOUT_HALF = replaced(forms, "stored_energy", _without_half)
NORMAL_NOT_TURNED = replaced(forms, "stored_energy", _normal_not_turned)
