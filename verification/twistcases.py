"""Curves whose twist is known: helices, ropes and knots of the references, crossed lines, rigid bundles."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from dolfinrod import twist
from verification.references.coils import (
    EIGHT,
    RIBBON,
    TORUS,
    TREFOIL,
    WAVE,
    coil,
    eight,
    helix,
    rigid_bundle,
    round_about,
    torus,
    trefoil,
    wave,
)
from verification.references.moving import exact
from verification.twist import TwistCase

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["CASES"]

# The paper's twist and zone.
T, ZONE = 55.0, 0.04
SPEED = 0.1716
FEW, SEGMENTS = (10, 20, 40, 80), (1, 2, 4, 8)
RIGID = ("rigid turn, θ = 2π T X", "geometry")


def _evenly(n: int) -> list[Array]:
    X = np.linspace(0.0, ZONE, n + 1)
    return rigid_bundle(2.0 * np.pi * T * X, X)


def _ever_tighter(n: int) -> list[Array]:
    """dθ/dX = 2π T X/L."""
    X = np.linspace(0.0, ZONE, n + 1)
    return rigid_bundle(np.pi * T * X**2 / ZONE, X)


def _delivered(quantity: str, n: int) -> float:
    return float(getattr(twist.delivered(_ever_tighter(n)), quantity)[0])


def _flowing(n: int) -> float:
    """A bundle that goes through the plane as a rigid body along X."""
    t = np.linspace(0.0, 0.02, n + 1)
    X = np.linspace(-0.01, ZONE + 0.01, 121)
    states = [rigid_bundle(2.0 * np.pi * T * (X - SPEED * τ), X, 5) for τ in t]
    histories = [np.stack(rows) for rows in zip(*states, strict=True)]
    return twist.outflow(t, histories, X=ZONE, speed=SPEED).mean


def _bundles() -> Iterator[TwistCase]:
    every = exact("T", "; ".join(RIGID), T)
    tighter = exact("T (1 − 10 mm/2L)", "mean of T X/L over the last 10 mm", T * (1.0 - 0.125))
    read: tuple[tuple[str, str, Callable[[int], float]], ...] = (
        ("pairs", "57 fibres turned rigidly, all pairs", lambda n: twist.pairs(_evenly(n)).T),
        ("axis_winding", "57 fibres turned rigidly, about their axis", lambda n: twist.axis_winding(_evenly(n)).T),
    )
    for measure, title, of in read:
        yield TwistCase(f"rigid-{measure}", title, measure, every, of, (20, 40, 80), None, "turns/m", "elements")
    for quantity in ("pairs", "axis"):
        yield TwistCase(
            f"delivered-{quantity}",
            f"57 fibres, ever tighter: the last 10 mm, {quantity}",
            "delivered",
            tighter,
            partial(_delivered, quantity),
            (20, 40, 80),
            None,
            "turns/m",
            "elements",
        )
    yield TwistCase("outflow", "5 fibres that leave", "outflow", every, _flowing, FEW[2:], None, "turns/m", "times")


def _lines() -> Iterator[TwistCase]:
    """Of the half length a, at a distance h and the slopes ± tan α: (1/π) atan(a tan α/h); Gauss at right angles."""
    a, h, α = 1.0, 0.1, 0.3
    for side, word in ((1.0, "right"), (-1.0, "left")):

        def crossed(n: int, side: float = side) -> float:
            X = np.linspace(-a, a, n + 1)
            half = X * np.tan(α) / 2.0
            lower, upper = (np.stack([X, side * y + 0.0 * X, z], axis=1) for y, z in ((0.0, -half), (h, half)))
            return twist.winding(lower, upper).turns

        formula = exact("± (1/π) atan(a tan α/h)", "geometry", side * np.arctan(a * np.tan(α) / h) / np.pi)
        yield TwistCase(
            f"crossed-{word}", f"Crossed lines, {word}", "winding", formula, crossed, SEGMENTS, points="segments"
        )

    def square(n: int) -> float:
        t = np.linspace(-a, a, n + 1)
        o = np.zeros_like(t)
        return twist.link(np.stack([t, o, o], axis=1), np.stack([o, t, o + h], axis=1), closed=False)

    value = exact(
        "(1/π) asin(a²/(a² + h²))",
        "solid angle of a square seen from its axis",
        -np.arcsin(a**2 / (a**2 + h**2)) / np.pi,
    )
    yield TwistCase(
        "square", "Gauss integral of segments at right angles", "link", value, square, SEGMENTS, points="segments"
    )


def _helices() -> Iterator[TwistCase]:
    for name, r, pitch in (("M1-helix-r1.0-p1.0", 1.0, 1.0), ("M1-helix-r0.5-p3.0", 0.5, 3.0)):
        shown = f"Helix, r = {r:g}, pitch {pitch:g}"
        per_turn, coils = coil(name, "twist_per_turn"), coil(name, "writhe_per_turn")
        laid, frames = partial(_laid, r, pitch), partial(_frames, r, pitch)
        yield TwistCase(
            f"helix-{r:g}-{pitch:g}-ribbon", f"{shown}: towards its axis", "twist", per_turn, laid, theory=2
        )
        yield TwistCase(f"helix-{r:g}-{pitch:g}-frames", f"{shown}: Frenet frames", "frame_twist", per_turn, frames)
        left = partial(_left, r, pitch)
        yield TwistCase(
            f"helix-{r:g}-{pitch:g}-left", f"{shown}: winding about its axis − twist", "winding", coils, left, theory=2
        )
    name, r, lay = "M2-2strand-r0.5-lay3.0", 0.5, 3.0
    both, back = coil(name, "Lk_per_lay"), coil(name, "tw_per_lay_full_backtwist")
    rope, held = partial(_rope, r, lay), partial(_held, r, lay)
    yield TwistCase("rope", "Two strands of a rope, a lay", "winding", both, rope, FEW)
    yield TwistCase("full-back-twist", "Strand laid with full back-twist", "twist", back, held, theory=2)


def _laid(r: float, pitch: float, n: int) -> float:
    curve = helix(np.linspace(0.0, 1.0, n + 1), r, pitch)
    return twist.twist(curve, curve * [0.0, -1.0, -1.0])


def _held(r: float, pitch: float, n: int) -> float:
    """The director towards the axis, turned back about the tangent by a turn a lay."""
    t = np.linspace(0.0, 1.0, n + 1)
    frames = _frenet(r, pitch, t)
    φ = 2.0 * np.pi * t[:, None]
    return twist.twist(helix(t, r, pitch), np.cos(φ) * frames[:, :, 1] - np.sin(φ) * frames[:, :, 2])


def _frames(r: float, pitch: float, n: int) -> float:
    return twist.frame_twist(_frenet(r, pitch, np.linspace(0.0, 1.0, n + 1)))


def _frenet(r: float, pitch: float, t: Array) -> Array:
    """Tangent, principal normal and binormal as columns, shape (n, 3, 3)."""
    φ, k = 2.0 * np.pi * t, 2.0 * np.pi * r
    tangent = np.stack([pitch + 0.0 * t, -k * np.sin(φ), k * np.cos(φ)], axis=1) / np.hypot(pitch, k)
    normal = np.stack([0.0 * t, -np.cos(φ), -np.sin(φ)], axis=1)
    return np.stack([tangent, normal, np.cross(tangent, normal)], axis=2)


def _left(r: float, pitch: float, n: int) -> float:
    curve = helix(np.linspace(0.0, 1.0, n + 1), r, pitch)
    return twist.winding(curve, curve * [1.0, 0.0, 0.0]).turns - _laid(r, pitch, n)


def _rope(r: float, lay: float, n: int) -> float:
    t = np.linspace(0.0, 1.0, n + 1)
    return twist.winding(helix(t, r, lay), helix(t, r, lay, np.pi)).turns


def _knots() -> Iterator[TwistCase]:
    shapes: tuple[tuple[str, str, str, Callable[[Array], Array]], ...] = (
        *((f"torus-{p[2]}-{p[3]}", f"torus-{p}", f"Torus curve {p[2]}, {p[3]}", partial(_torus, p)) for p in TORUS),
        ("eight", f"eight-{EIGHT}", "Eight", lambda t: eight(t, *EIGHT)),
        ("trefoil", f"trefoil-{TREFOIL}", "Trefoil", lambda t: trefoil(t, *TREFOIL)),
    )
    for name, entry, title, shape in shapes:
        known = coil(f"M3-writhe-{entry}", "writhe")
        yield TwistCase(name, f"{title}: writhe", "writhe", known, partial(_writhe, shape), theory=2)
    known = coil(f"M3-writhe-wave-{WAVE}", "writhe")
    even = partial(_writhe, lambda t: wave(t, *WAVE))
    yield TwistCase("wave", "Waving circle, as much left as right: writhe", "writhe", known, even)


def _torus(par: tuple[float, float, int, int], t: Array) -> Array:
    return torus(t, *par)


def _writhe(shape: Callable[[Array], Array], n: int) -> float:
    return twist.writhe(shape(round_about(n)), closed=True)


def _ribbon(n: int) -> tuple[Array, Array]:
    """A torus curve and what leads from it to the core of the torus."""
    t, R = round_about(n), RIBBON[0]
    curve = torus(t, *RIBBON)
    core = R * np.stack([np.cos(2.0 * np.pi * t), np.sin(2.0 * np.pi * t), 0.0 * t], axis=1)
    return curve, core - curve


def _ribbons() -> Iterator[TwistCase]:
    name, title = "M4-ribbon-R1.0-a0.3-q4", "Ribbon on a torus"

    def Tw(n: int) -> float:
        return twist.twist(*_ribbon(n), closed=True)

    def Wr(n: int) -> float:
        return twist.writhe(_ribbon(n)[0], closed=True)

    def Lk(n: int) -> float:
        curve, across = _ribbon(n)
        return twist.link(curve, curve + across)

    for quantity, measure, read in (("Tw", "twist", Tw), ("Wr", "writhe", Wr)):
        yield TwistCase(f"ribbon-{quantity}", f"{title}: {quantity}", measure, coil(name, quantity), read, theory=2)
    yield TwistCase("ribbon-Lk", f"{title}: Lk with the core", "link", coil(name, "Lk"), Lk)
    yield TwistCase("ribbon-sum", f"{title}: Tw + Wr", "twist", coil(name, "Lk"), lambda n: Tw(n) + Wr(n))


CASES = (*_bundles(), *_lines(), *_helices(), *_knots(), *_ribbons())
