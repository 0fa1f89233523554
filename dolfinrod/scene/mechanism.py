"""What the supports of a scene leave free to move as a rigid body."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dolfinrod.scene.history import factor, kinks
from dolfinrod.scene.loads import PointMoment
from dolfinrod.scene.supports import ROTATIONS, TRANSLATIONS, Prescribed

if TYPE_CHECKING:
    from dolfinrod.scene.scene import Scene

__all__ = ["free_motions", "named", "null_space", "overheld", "turned_away"]

# A rigid motion that supports resist with less than this fraction of their full grip is free.
FREE = 1e-9
# What a straight rod misses of its length between its ends, and what of an axis is along it, are no less than this.
ALIGNED = 1e-9
# Moments that sum up to less than this fraction of their magnitudes are balanced.
BALANCED = 1e-9


def free_motions(scene: Scene) -> tuple[str, ...]:
    """Rigid motions of single rods that no support resists, in words.

    A support that holds x at the place r resists the velocity v + ω × r along x; one that holds rx resists ω along x.
    The motions (v, ω) in the null space of all these are free: first the translations, then the turns left over.

    Args:
        scene: Any scene.

    Returns:
        One sentence a motion, such as "rods[0] is free to turn about (1, 0, 0)"; none where all is held. A free
        motion need not be fatal: loads may hold a rod in equilibrium, as gravity holds a pendulum, and so may what it
        touches.
    """
    sentences = []
    for k in range(len(scene.rods)):
        rows = _resisted(scene, k)
        if not len(rows):
            sentences.append(f"rods[{k}] is held nowhere")
            continue
        sentences += named(k, null_space(rows))
    return tuple(sentences)


def turned_away(scene: Scene) -> tuple[str, ...]:
    """Free turns of single resting rods that dead moments do work on in whatever shape.

    With δθ = ω all along a rod, δW = ω·ΣM must vanish. Only rods that nothing but dead moments acts on, and that
    have nothing to touch, are judged: forces may find lever arms, and followers turn along.

    Args:
        scene: Any scene.

    Returns:
        One sentence a rod: about which axis it is free to turn and the moment about it, where that is first out of
        balance among the times at which tables have a row and the end.
    """
    t_end = scene.motion.t_end
    sentences = []
    for k in range(len(scene.rods)):
        loads = [load for load in scene.loads if getattr(load, "rod", None) in (None, k)]
        moments = [load for load in loads if isinstance(load, PointMoment)]
        if not moments or len(moments) < len(loads) or scene.may_touch(k):
            continue
        axes = _span(_lasting(scene, k)[:, 3:])
        for t in (*sorted({t for load in moments for t in kinks(load.history) if 0.0 < t < t_end}), t_end):
            acting = np.array([factor(load.history, t, t_end) * np.asarray(load.moment) for load in moments])
            push = acting.sum(axis=0) @ axes.T
            net = float(np.linalg.norm(push))
            if net > BALANCED * float(np.linalg.norm(acting, axis=1).sum()):
                when = f" at t = {t:g}" if t < t_end else ""
                about = _direction(push @ axes)
                sentences.append(
                    f"rods[{k}] is free to turn about {about}, and its loads turn it with {net:.6g} N m{when}"
                )
                break
    return tuple(sentences)


def overheld(scene: Scene) -> tuple[str, ...]:
    """Straight rods that cannot stretch and are held along themselves more than once: their axial force is anything.

    Args:
        scene: Any scene.

    Returns:
        One sentence a rod.
    """
    sentences = []
    for k, rod in enumerate(scene.rods):
        chord = np.asarray(rod.centerline(rod.length) - rod.centerline(0.0)) / rod.length
        if "extension" not in rod.section.rigid or np.linalg.norm(chord) < 1.0 - ALIGNED:
            continue
        along = {a for a, part in zip(TRANSLATIONS, chord, strict=True) if abs(part) > ALIGNED}
        held = [scene.location(support.at, support.rod) for support in scene.supports if along & support.held()]
        places = {s for found in held for j, s in found if j == k}
        if len(places) > 1:
            sentences.append(f"rods[{k}] is straight, cannot stretch and is held along itself at {len(places)} places")
    return tuple(sentences)


def _lasting(scene: Scene, k: int) -> np.ndarray:
    """Rigid motions of rod k that stay free however it bends and slides in its supports, shape (n, 6)."""
    supports = [support for support in scene.supports if support.rod in (None, k)]
    if any(isinstance(support, Prescribed) and any(support.displacement or ()) for support in supports):
        return np.zeros((0, 6))
    free = null_space(_resisted(scene, k)) if supports else np.eye(6)
    # A place that slid along f is held in e still: e·(ω × f) = ω·(f × e) must vanish.
    rows = [np.zeros((0, 3))]
    for support in supports:
        held = np.array([a in support.held() for a in TRANSLATIONS])
        rows += [np.cross(f, np.eye(3)[held]) for f in np.eye(3)[~held]]
    return np.asarray(null_space(np.concatenate(rows) @ free[:, 3:].T) @ free)


def named(rod: int, free: np.ndarray) -> list[str]:
    """Rigid motions in words.

    Args:
        rod: Number of the rod.
        free: Independent motions (v, ω), shape (n, 6).

    Returns:
        One sentence a motion: the translations among them, then the turns left over.
    """
    translations = null_space(free[:, 3:].T) @ free
    moved = [f"rods[{rod}] is free to move along {_direction(motion[:3])}" for motion in translations]
    return moved + [f"rods[{rod}] is free to turn about {_direction(axis)}" for axis in _span(free[:, 3:])]


def _resisted(scene: Scene, k: int) -> np.ndarray:
    """Rows (e, r × e) or (0, e) that a rigid motion of rod k must be normal to, shape (rows, 6), lengths in its own."""
    rod = scene.rods[k]
    rows = []
    for support in scene.supports:
        places = [s for j, s in scene.location(support.at, support.rod) if j == k]
        for r in (np.asarray(rod.centerline(s) - rod.centerline(0.0)) / rod.length for s in places):
            held = support.held()
            moved = [e for e, a in zip(np.eye(3), TRANSLATIONS, strict=True) if a in held]
            turned = [e for e, a in zip(np.eye(3), ROTATIONS, strict=True) if a in held]
            rows += [np.concatenate([e, np.cross(r, e)]) for e in moved]
            rows += [np.concatenate([np.zeros(3), e]) for e in turned]
    return np.array(rows).reshape(-1, 6)


def null_space(rows: np.ndarray) -> np.ndarray:
    """Orthonormal rows that all `rows`, shape (any, n), are normal to, shape (n − rank, n)."""
    _, grip, right = np.linalg.svd(rows)
    return np.asarray(right[int((grip > FREE).sum()) :])


def _span(rows: np.ndarray) -> np.ndarray:
    """Orthonormal rows that span the same."""
    _, size, right = np.linalg.svd(rows)
    return np.asarray(right[: int((size > FREE).sum())])


def _direction(v: np.ndarray) -> str:
    """A direction to six digits, its largest component positive."""
    v = v / np.linalg.norm(v) * np.sign(v[np.argmax(np.abs(v))])
    return "(" + ", ".join(f"{round(c, 6) + 0.0:g}" for c in v) + ")"
