"""Capstans: what ropes round drums hold, how they slip before, and how fast they run when they no longer hold."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene import ImplicitEuler, Planar
from verification.contactcase import ContactCase, ContactRun
from verification.contacts.ropes import LEVEL, TILTED, Loop, Run, Wrap
from verification.contacts.runs import DISCRETE, PLANE, SPACE, on_meshes
from verification.contacts.timed import in_time
from verification.references.capstan import friction_of_polygon
from verification.references.moving import exact
from verification.stepper import ContinuumStepper, DiscreteStepper

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from verification.models import Model

__all__ = ["CASES"]

THICKNESS = (
    "Friction acts at the surface of a rope of radius r, which holds e^{λθ}, λ ≈ μ (1 − (1 + μ²) r/ρ); r/ρ = 1e-6 here."
)
COUPLES = (
    "Couples of friction act at the nodes of the discrete model and bend its elements, by μ r p ℓ²/12EI: "
    "what is coarse rolls by that before it slides."
)
HEAVY = "What has been pulled off the drum hangs there: the pull falls by its weight, 1e-5 of it."
# When a rope that runs is looked at, and in how many steps; how much slower a polygon of 64 chords runs.
TAKEN, LOOKED, POLYGON = (0.5, (50, 100)), (0.3, 0.5), 2.2e-2
ANCHORS = "Anchors yield by μT/(ρ ε_T) before they slip: ways differ from those of the string by μ² EA/(ρ² ε_T) ≤ 9e-4."


def chords(result: Result) -> int:
    """Elements of the rope, all on the drum."""
    return len(result.rods[0].s) - 1


def limit_case(wrap: Wrap, words: str, levels: tuple[int, ...], within: float, note: str = "") -> ContactCase:
    """A rope pulled until it slides: what it then holds over what it should, on two load steps, so that it has slid."""
    model = PLANE if wrap.tilt == LEVEL else SPACE
    return ContactCase(
        name=f"capstan-{wrap.mu:g}-{wrap.degrees:g}" + words.replace(" ", "-"),
        title=f"Capstan{words}, μ = {wrap.mu:g}, {wrap.degrees:g}°",
        family="capstan",
        reference=exact(f"T₂ = {wrap.limit:.9g} T₁", "Euler 1769, with the arm of friction", 1.0, 1.0),
        scale=1.0,
        quantity="T₂ over the limit, while the rope is pulled on for two load steps",
        read=lambda result: wrap.pulled(result) / wrap.limit,
        runs=(
            on_meshes(model, wrap.scene(), levels, limit=within, quick=wrap.degrees == 180.0),
            on_meshes(DISCRETE, wrap.scene(), tuple(4 * n for n in levels), order=1.9),
        ),
        note=note,
    )


def polygon_case(wrap: Wrap) -> ContactCase:
    """The discrete rope turns at nodes only, and holds what a polygon does, on any mesh."""
    return ContactCase(
        name=f"capstan-polygon-{wrap.mu:g}-{wrap.degrees:g}",
        title=f"Capstan, μ = {wrap.mu:g}, {wrap.degrees:g}°, as a polygon",
        family="capstan",
        reference=exact("[(cos δ/2 + μ sin δ/2)/(cos δ/2 − μ sin δ/2)]ⁿ", "equilibrium of nodes", wrap.mu, wrap.mu),
        scale=wrap.mu,
        quantity="μ of which a polygon of so many chords holds what the rope does, on two load steps",
        read=lambda result: np.array([friction_of_polygon(T, wrap.angle, chords(result)) for T in wrap.pulled(result)]),
        runs=(on_meshes(DISCRETE, wrap.scene(), (8, 16, 32, 64), limit=5e-6, quick=wrap.degrees == 180.0),),
        note=THICKNESS,
    )


def _staged(
    loop: Loop, elements: int, steps: tuple[int, ...], limits: tuple[float, float], *, quick: bool
) -> tuple[ContactRun, ...]:
    """A loop by both models, in so many load steps a stage."""

    def run(model: Model, n: int, label: str, limit: float, *, quick: bool) -> ContactRun:
        def solve(steps: int) -> Result:
            return model.solve(loop.scene(steps), n)

        return ContactRun(model.family, label, solve, steps, "steps a stage", limit=limit, quick=quick)

    return (
        run(PLANE, elements, f"P3 planar, {elements} elements", limits[0], quick=quick),
        run(DISCRETE, 64, "64 elements", limits[1], quick=False),
    )


def held_case(loop: Loop) -> ContactCase:
    """A rope below its limit: what slips."""
    string = loop.string
    ways = (string.raised, string.pulled(loop.strong), string.back(loop.strong), string.pulled(loop.strong))
    return ContactCase(
        name=f"capstan-holds-{loop.mu:g}-{loop.degrees:g}-{loop.part:g}",
        title=f"Rope at {loop.part:g} of what it holds, μ = {loop.mu:g}, {loop.degrees:g}°: to T₂, back, and again",
        family="capstan",
        reference=exact("∫ T/EA ds, T = T₂ e^{−μφ} as far as it slips", "own derivation", *ways),
        scale=ways[1],
        quantity="way of the pulled end at T₁, T₂, T₁ and T₂, m",
        read=loop.read,
        runs=_staged(loop, 16, (4, 8), (2e-3, 3e-3), quick=True),
        note=ANCHORS,
    )


def lost_case(loop: Loop) -> ContactCase:
    """What that costs."""
    loss = loop.string.loss(loop.strong)
    return ContactCase(
        name=f"capstan-loses-{loop.mu:g}-{loop.degrees:g}-{loop.part:g}",
        title=f"Rope let back and pulled again below what it holds, μ = {loop.mu:g}, {loop.degrees:g}°: loss",
        family="capstan",
        reference=exact("ρ/(3 μ EA) (√T₁ + √T₂) (√T₂ − √T₁)³", "own derivation", loss),
        scale=loss,
        quantity="∮ T du, J",
        read=loop.lost,
        runs=_staged(replace(loop, anchors=10.0), 32, (8, 32), (1e-2, 1e-2), quick=False),
        note="Anchors ten times as stiff as the drum: as stiff ones would give back 1.6 % of the loss.",
    )


def loop_cases(loop: Loop) -> tuple[ContactCase, ContactCase]:
    """A rope below its limit, let back and pulled again."""
    return held_case(loop), lost_case(loop)


def run_case(run: Run, words: str, limit: float) -> ContactCase:
    """Held or not: a little below or above what it holds."""
    scale = Run(run.mu, run.degrees, 1.01).acceleration
    return ContactCase(
        name=f"capstan-{words}-{run.mu:g}-{run.degrees:g}",
        title=f"Rope under {run.part:g} of what it holds, μ = {run.mu:g}, {run.degrees:g}°: {words}",
        family="capstan",
        reference=exact("(T₂ − e^{μθ} T₁) μ/(ρA ρ (e^{μθ} − 1))", "dT/dφ = μT + ρA ρ a", *2 * (run.acceleration,)),
        scale=scale,
        quantity="acceleration of both ends, m/s²",
        read=run.read,
        runs=(
            in_time(
                ContinuumStepper(ImplicitEuler(), 8, 3, Planar((0.0, 0.0, 1.0))),
                run.scene,
                *TAKEN,
                output=LOOKED,
                limit=limit,
            ),
            in_time(
                DiscreteStepper(64),
                run.scene,
                *TAKEN,
                output=LOOKED,
                limit=max(limit, POLYGON if run.part > 1.0 else 0.0),
            ),
        ),
        note="A polygon of 64 chords holds 2e-4 more: of the hundredth that is too much, 2.1 % are missing.",
    )


CASES = (
    *(
        limit_case(Wrap(mu, degrees), "", (4, 8, 16), 1e-6, THICKNESS)
        for mu, degrees in ((0.64, 30.0), (0.1, 90.0), (0.64, 90.0), (0.2, 180.0), (0.3, 180.0), (0.64, 180.0))
    ),
    *(
        limit_case(Wrap(mu, degrees, TILTED), " along a helix", (16, 32), 1e-6, THICKNESS)
        for mu, degrees in ((0.3, 360.0), (0.64, 360.0), (0.1, 540.0), (0.3, 540.0))
    ),
    # Friction that holds 400 times the tension: on 12 and 24 elements load steps are cut again and again.
    limit_case(Wrap(0.64, 540.0, TILTED), " along a helix", (16, 48), 1e-4, THICKNESS),
    limit_case(Wrap(0.3, 180.0, epsilon=1e-3), " of a thick rope", (16, 32), 1e-6, COUPLES),
    limit_case(Wrap(0.3, 180.0, weight=1.0 / 3.0), " of a heavy rope", (8, 16), 5e-5, HEAVY),
    polygon_case(Wrap(0.3, 180.0)),
    polygon_case(Wrap(0.64, 90.0)),
    *loop_cases(Loop(0.3, 180.0, 0.9)),
    *loop_cases(Loop(0.64, 90.0, 0.99, EA=1e3)),
    run_case(Run(0.3, 180.0, 0.99), "holds", 1e-6),
    run_case(Run(0.3, 180.0, 1.01), "runs", 1e-3),
)
