"""What whole matrices and the energy itself say of an equilibrium, for tests of the counts and flags of `discrete`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import dolfinrod as dr
from discrete.equilibrium import Equilibrium
from discrete.mass import at_nodes, uniform
from discrete.rotation import exp
from discrete.solver import beginning
from discrete.state import Outcome
from discrete.unknowns import AXIAL, N_NODE, SPIN, X


def reached(result: dr.Result) -> tuple[Equilibrium, Outcome]:
    """The last state of a result, in the hands of the solver."""
    phase, path = beginning(result.scene, [len(rod.s) - 1 for rod in result.rods], result)
    found = phase.find(path.state, float(result.t[-1]))
    assert found.converged
    return phase.equilibrium, found


def vibrations(result: dr.Result) -> np.ndarray:
    """All λ of K v = λ M v of the last state, M a uniform mass, by dense matrices with every F_n eliminated."""
    equilibrium, found = reached(result)
    tangent = found.tangent
    n, node_i = tangent.system.n_unknowns, tangent.system.node_i
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for i, block in zip(node_i, tangent.elements, strict=True):
        K[N_NODE * i : N_NODE * i + 13, N_NODE * i : N_NODE * i + 13] += block
    for k, block in enumerate(at_nodes(uniform(equilibrium.mesh).elements(found.state.R, tangent), tangent)):
        M[N_NODE * k : N_NODE * (k + 1), N_NODE * k : N_NODE * (k + 1)] = block
    free = np.ones(n, dtype=bool)
    free[tangent.system.held] = False
    axial = np.arange(n) % N_NODE == AXIAL
    x, f = np.flatnonzero(free & ~axial), np.flatnonzero(free & axial)
    K_x = K[np.ix_(x, x)] - K[np.ix_(x, f)] @ np.linalg.solve(K[np.ix_(f, f)], K[np.ix_(f, x)])
    M_x = M[np.ix_(x, x)]
    # By K + M: without an inverse of what may be singular.
    θ = np.linalg.eigvals(np.linalg.solve(K_x + M_x, M_x))
    return 1.0 / θ[np.abs(θ) > 1e-12 * np.abs(θ).max()] - 1.0


def falling(result: dr.Result) -> int:
    """Negative eigenvalues of the second differences of the potential energy on what the supports leave free.

    Strain energy of the elements with F_n from the length of the chord, less the work of dead forces.
    """
    equilibrium, found = reached(result)
    mesh, state = equilibrium.mesh, found.state
    node_i = mesh.elements.node_i
    load = equilibrium.loads.level(float(result.t[-1])).at(state.R)
    free = np.setdiff1d(np.arange(N_NODE * len(mesh.x)), equilibrium.supports.held)
    free = free[free % N_NODE != AXIAL]

    def energy(d: np.ndarray) -> float:
        whole = np.zeros(N_NODE * len(mesh.x))
        whole[free] = d
        whole = whole.reshape(-1, N_NODE)
        x = state.x + whole[:, X]
        e = x[node_i + 1] - x[node_i]
        length = np.linalg.norm(e, axis=1)
        F_n = (length - mesh.elements.l_0) / mesh.elements.compliance
        there = replace(state, x=x, R=exp(whole[:, SPIN]) @ state.R, u=e / length[:, None], F_n=F_n)
        return equilibrium.snapshot(there, float(result.t[-1])).energy - float(np.vdot(load[:, X], whole[:, X]))

    h, unit = 1e-4, np.eye(len(free))
    single = [(energy(h * d), energy(-h * d)) for d in unit]
    rest, H = energy(np.zeros(len(free))), np.zeros((len(free), len(free)))
    for a in range(len(free)):
        H[a, a] = sum(single[a]) - 2.0 * rest
        for b in range(a):
            both = energy(h * (unit[a] + unit[b])) + energy(-h * (unit[a] + unit[b]))
            H[a, b] = H[b, a] = 0.5 * (both - sum(single[a]) - sum(single[b]) + 2.0 * rest)
    return int((np.linalg.eigvalsh(H / h**2) < 0.0).sum())
