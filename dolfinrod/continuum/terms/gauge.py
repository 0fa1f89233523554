"""A condition that stands on the nodes alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import ufl
    from ufl.core.expr import Expr

__all__ = ["node_condition"]


def node_condition(integrand: Expr, ds_nodes: ufl.Measure) -> ufl.Form:
    """Σ over nodes of weight × integrand, by the Gauss-Lobatto rule whose points are the nodes of P_k.

    With ½ λ (p·p − 1) as integrand every nodal quaternion is exactly of unit norm and λ is its multiplier.
    """
    return integrand * ds_nodes
