"""The paper's discrete rod: 12×12 elements between nodes with six degrees of freedom, in equilibrium or in motion.

Lyu, Cheng, Xu, Modeling Additional Twists of Yarn Spun by Lateral Compact Spinning with Pneumatic Groove,
CMES 127(2), 2021. Statics: Eq. 10–22 and 2.3.3; motion: Eq. 1–10, 23–26 and 2.3.2, implicit Euler, with
`scene.motion = Dynamic(...)`; the same masses for frequencies. It has no shear.

    import discrete
    result = discrete.solve(scene, elements=80)
    discrete.buckling(scene, modes=3).factors, discrete.critical(scene).factors[0], discrete.modes(scene).frequencies

Symbols of the paper, kept here, and the names they have in `dolfinrod`:

    ======================  ========================================  ==========================================
    paper                   here                                      dolfinrod
    ======================  ========================================  ==========================================
    O-xyz                   global axes                               spatial axes
    O'-uvw, u axial         triad, axes as columns                    section frame R = [d1 d2 d3]
    [A], [t] (11, 19)       direction_cosines(triad), axes as rows    Rᵀ
    E A                     EA                                        Section.EA
    E I_v, E I_w            EI_v, EI_w, bending about v, w            Section.EI = (EI2, EI3)
    G I_p                   GI_p                                      Section.GJ
    l                       l, natural length of an element           Δs
    F_n (12)                F_n, tension positive, F_uj = -F_ui       n1
    M_u, M_v, M_w at j      end moments, on the element               m1, m2, m3
    Δu, Δv, Δw (15, 16)     displacements in element axes             –
    Δθ_u, Δθ_v, Δθ_w        rotations in element axes                 κ ds summed over an element
    δ_e (20, 21)            deformation(e, A_i, A_j, l_0)             –
    [k*], [k] (15-19)       stiffness(...), tᵀ k* t                   –
    {P}, {Q} (25, 26)       scatter(force, ...), LoadLevel            internal and external forces
    [m]{a} (4, 26)          Inertia.force, m (v₁ − v₀)/Δt             ρA r̈
    {R} (4, 26)             Inertia.moment, with J α                  ρI ω̇ + ω × ρI ω
    J, J* (9, 10)           inertia(J_star, A)                        Section.rhoI, per length
    ======================  ========================================  ==========================================

Importing this package loads NumPy and SciPy only.
"""

from discrete.eigenmodes import buckling, critical, modes
from discrete.element import stiffness
from discrete.solver import solve

__all__ = ["buckling", "critical", "modes", "solve", "stiffness"]
