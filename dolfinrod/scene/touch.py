"""Points of rods that may touch one surface: what acts on them, and what they remember from step to step.

The rods may turn and the wall may move; everything is worked out in axes that move with the wall, in which it rests,
and turned into space at the end. Both models of this project ask here, each for its own points.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dolfinrod.scene.books import rubbed_off, wall_work
from dolfinrod.scene.creeping import against, creeping_gradient
from dolfinrod.scene.damped import in_step
from dolfinrod.scene.friction import Coulomb, CreepingCoulomb, anchoring
from dolfinrod.scene.motion import Dynamic
from dolfinrod.scene.outward import felt, into_space, onto_wall
from dolfinrod.scene.piercing import pierces
from dolfinrod.scene.pivoting import Outlook
from dolfinrod.scene.pressing import Pressing
from dolfinrod.scene.pressure import SmoothPenalty
from dolfinrod.scene.pushing import GRAZING, gathered
from dolfinrod.scene.reply import OPEN, SLIDES, Booked, Gradient, Reply
from dolfinrod.scene.rubbing import Pressed, Step, rubbed, rubbing_slopes
from dolfinrod.scene.sliding import passed, torn
from dolfinrod.scene.surfaces import REST, Pose

if TYPE_CHECKING:
    from collections.abc import Mapping

    from dolfinrod.scene.contact import Contact
    from dolfinrod.scene.motion import Motion

__all__ = ["Touch"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


class Touch:
    """Points of rods against one surface.

    Args:
        contact: The surface and its laws.
        radius: Of the rod at each point, shape (n,) [m].
        motion: Of the scene.
        level: Where in a step forces act: 1 at its end, ½ in the middle.

    Attributes:
        slip: Way of the anchors under pressure so far, shape (n,) [m].
    """

    def __init__(self, contact: Contact, radius: Array, motion: Motion, level: float = 1.0) -> None:
        self.contact, self._radius, self._motion, self._level = contact, radius, motion, level
        self._friction, self._pressing = contact.friction, Pressing(contact.law, radius)
        self.open = len(radius) if self._friction is None and not isinstance(contact.law, SmoothPenalty) else 0
        self._none, self._all = np.zeros(len(radius), dtype=bool), np.ones(len(radius), dtype=bool)
        self.adopt, self.settle = self._pressing.adopt, self._pressing.settle
        self._stiffness = anchoring(self._friction, contact.law)
        self._arm = self._friction.arm(radius) if isinstance(self._friction, Coulomb) else np.zeros_like(radius)
        self.changed, self.forced, self.turns = False, False, bool(self._arm.any())

    def place(self, x: Array, t: float) -> None:
        """The rods are at x; nothing is remembered."""
        self._t_0, self._x_0, self._X_0 = t, x.copy(), self._pose(t).back(x)
        closest = self.contact.surface.closest(self._X_0)
        self._gap_0, self._n_0 = closest.distance - self._radius, closest.normal
        n = len(x)
        self._λ_0, self.slip, self._u = np.zeros(n), np.zeros(n), np.zeros((n, 3))
        self._state = self._state_0 = np.full(n, OPEN, dtype=np.int8)
        self.begin(t)

    def begin(self, t: float) -> None:
        """A step from where the rods were last accepted leads to time t."""
        self._λ, law = self._λ_0.copy(), self.contact.law
        self._slid, self._ε_T = np.zeros((len(self._radius), 3)), self._stiffness
        self._clings = self._glides = self._stuck = self._none
        # A gap under load, as multipliers leave it within their tolerance, is no way yet to go.
        unloaded = law.pressure(self._gap_0, self._λ)[0] == 0.0
        self._afar = unloaded & (self._gap_0 - law.g_0 > GRAZING * self._radius)
        # Where the rods were placed nothing moves yet.
        self._t, dt = t, t - self._t_0
        self._rate = 1.0 / dt if dt > 0.0 else 0.0
        self._pressing.begin(in_step(law, self._gap_0, self._rate if isinstance(self._motion, Dynamic) else 0.0))
        self._end, self._acting = self._pose(t), self._pose(self._t_0 + self._level * dt)
        motion, end = self.contact.surface.motion, self._motion.t_end
        self._wall_turn = np.zeros(3) if motion is None else motion.turn(t, end) - motion.turn(self._t_0, end)

    def _pose(self, t: float) -> Pose:
        motion = self.contact.surface.motion
        return REST if motion is None else motion.pose(t, self._motion.t_end)

    def respond(self, x: Array, turn: Array) -> Reply:
        """What acts where the step has led.

        Args:
            x: Points in space at its end, shape (n, 3) [m].
            turn: Rotation vectors of the sections over the step, in space, shape (n, 3) [rad].

        Returns:
            Forces and moments per length.
        """
        self._x, self._turn = np.array(x, order="C"), np.array(turn, order="C")
        end = self._end
        step = self._step = self._led(*onto_wall(self._x, self._turn, end.Q, end.c, self._wall_turn))
        pressed, on = step.pressed, step.on
        rubs = (step.w, self._all[: len(on)])
        if step.rubbing is not None:
            rubs = (step.rubbing.traction, step.rubbing.slides)
        pushed = (pressed.p, pressed.n, pressed.radius, *rubs, self._acting.Q)
        p, n, t, m, self._state, self._stuck, changed = felt(self._state, on, *pushed)
        if isinstance(self._friction, CreepingCoulomb):
            v, speed = against((self._x - self._x_0)[on], self._rate, self._friction.v_0)
            t[on] = -self._friction.mu * (pressed.p / speed)[:, None] * v
        self.forced = step.rubbing is not None and step.rubbing.forced
        self.changed = self.forced or changed
        self._clings = self._glides = self._none
        self._reply = Reply(step.gap, p, n, t, m, self._state)
        return self._reply

    def _led(self, X: Array, turned: Array) -> Step:
        """Pressures and tractions, in the axes of the wall."""
        closest = self.contact.surface.closest(X)
        gap, at_end = closest.distance - self._radius, closest.normal
        if self._level == 1.0:
            p, slope, touch, expected = self._pressing.at(X, gap, self._λ, self._torn(X, turned, at_end))
        else:
            p, slope, touch, expected = self._pressing.mean(self._gap_0, gap, self._λ)
            closest = self.contact.surface.closest((1.0 - self._level) * self._X_0 + self._level * X)
        wall = (at_end, closest.normal, closest.curvature, self._level)
        p_X, on, *few = gathered(touch, p, slope, *wall, self._arm, expected)
        self._pressing.led(X, p, p_X, touch)
        pressed, none = Pressed(*few), np.zeros((len(on), 3))
        if not isinstance(self._friction, Coulomb) or not len(on):
            return Step(X, turned, gap, at_end, on, pressed, none[:, 0], none, none, None)
        past = (self._u, self._afar, gap, self._gap_0, self.contact.law.g_0)
        share, w, v = passed(on, X, self._X_0, turned, pressed.n, pressed.radius, *past)
        rubbing = rubbed(pressed, v, self._friction.mu, self._ε_T, self._clings[on], self._glides[on], self._slid[on])
        self._slid[:] = 0.0
        self._slid[on] = np.where(rubbing.slides[:, None], rubbing.u, 0.0)
        return Step(X, turned, gap, at_end, on, pressed, share, w, v, rubbing)

    def _torn(self, X: Array, turned: Array, n: Array) -> Flags:
        """Points that stuck in the last answer, harder than the pressure there allows: they slide before they leave."""
        if not isinstance(self._friction, Coulomb) or not self._stuck.any():
            return self._none
        reach = self._friction.mu * self._reply.pressure / self._ε_T
        return np.asarray(torn(self._stuck, X, self._X_0, turned, n, self._radius, self._u, reach))

    def gradient(self) -> Gradient:
        """Derivatives of the last reply."""
        step, pressed = self._step, self._step.pressed
        f_x = pressed.gradient()
        none = np.zeros_like(f_x)
        if not len(f_x):
            return Gradient(step.on, none, none, none, none)
        if step.rubbing is not None:
            assert isinstance(self._friction, Coulomb)
            law = self._friction.mu, self._ε_T
            t_x, *turning = rubbing_slopes(step, self._gap_0[step.on], self.contact.law.g_0, *law)
            return self._in_space(f_x + t_x, *turning)
        if isinstance(self._friction, CreepingCoulomb):
            v, speed = against((self._x - self._x_0)[step.on], self._rate, self._friction.v_0)
            Q, end, μ = self._acting.Q, self._end.Q, self._friction.mu
            f_x = f_x + creeping_gradient(pressed, v, speed, self._rate, μ, Q, end)
        return self._in_space(f_x, none, none, none)

    def _in_space(self, *blocks: Array) -> Gradient:
        Q, E = self._acting.Q, self._end.Q
        return Gradient(self._step.on, *(into_space(Q, block, E) for block in blocks))

    def cling(self) -> None:
        """Begin the iteration with what was pressed and stuck before, wherever the wall has gone meanwhile."""
        pressed = self._state_0 > OPEN
        kept = self._pressing.cling(pressed, self._gap_0) if self._level == 1.0 else pressed
        self._clings = kept & (self._state_0 != SLIDES)

    def glide(self) -> None:
        """Begin it with what slid before sliding on, as it does where the loads go on as they did."""
        self._glides = self._state_0 == SLIDES

    def foresee(self, x: Array) -> bool:
        """Whether a linear step to x presses other points than it was taken with: `adopt` lets them be pressed here."""
        return self._pressing.foresee(self._end.back(x), self._step.gap, self._step.normal)

    def ahead(self, x: Array, share: Array) -> Outlook:
        """Where a linear step to x leads the points that may be exchanged, for `settle`, by their shares of rod [m]."""
        step = self._step
        ways = self._pressing.ahead(self._end.back(x), step.gap, self._λ, step.normal)
        return Outlook(*ways, step.normal @ self._end.Q.T, share).first(self.open)

    def soften(self, by: float) -> None:
        """Let the wall be softer by a factor until the next `begin`: on the way to what is pressed."""
        self._pressing.soften(by)
        self._ε_T = self._stiffness / by

    def renew(self) -> bool:
        """Give the multipliers what has just acted; whether that was within the tolerance of the law already."""
        if not (done := self._pressing.enough(self._reply.pressure, self._reply.gap)):
            self._λ = self._reply.pressure.copy()
        return done

    def pierces(self) -> bool:
        """Whether the step has led into or through the wall: it was too long."""
        ways = (self._X_0, self._step.X), (self._n_0, self._step.normal)
        return pierces(self.contact.surface, *ways, self._step.gap + self._radius)

    def accept(self) -> Booked:
        """The step counts, with what has acted in it."""
        step, reply, moved = self._step, self._reply, self._x - self._x_0
        # What acts against velocities in space knows no wall.
        creeps = isinstance(self._friction, CreepingCoulomb)
        force = reply.pressure[:, None] * reply.normal if creeps else reply.force
        past = (moved, self._turn, step.X - self._X_0, step.turned)
        pushed = wall_work(force, reply.moment, self._acting.Q, *past)
        on, anchored, traction = step.on[:0], step.w, step.w
        if step.rubbing is not None:
            on, anchored, traction = step.on, step.rubbing.anchored, step.rubbing.traction
            self.slip[on] += step.rubbing.slipped
        rubbed, self._u = rubbed_off(self._u, self._ε_T, on, anchored, traction, step.w)
        rubbed = -np.einsum("ni,ni->n", reply.traction, moved) if creeps else rubbed
        damped = self._pressing.damped(self._gap_0, step.gap, reply.pressure, mean=self._level < 1.0)
        self._x_0, self._X_0, self._gap_0, self._t_0 = self._x, step.X, step.gap, self._t
        self._n_0 = step.normal
        self._λ_0, self._state_0 = self._λ.copy(), self._state
        return Booked(self.stored(), rubbed, pushed, damped)

    def stored(self) -> Array:
        """Energy per length in penetrations and anchors at the start of the step, shape (n,) [J/m]."""
        held = 0.5 * self._ε_T * np.einsum("ni,ni->n", self._u, self._u)
        return np.asarray(self._pressing.law.energy(self._gap_0, self._λ_0) + held)

    def memory(self) -> dict[str, Array]:
        """All that the points remember, one row a point: what `recall` takes."""
        return {
            "x": self._x_0.copy(),
            "anchored": self._u.copy(),
            "multiplier": self._λ_0.copy(),
            "slip": self.slip.copy(),
            "state": self._state_0.astype(float),
        }

    def recall(self, memory: Mapping[str, Array], t: float) -> None:
        """Go back, or on, to what was remembered at time t."""
        self.place(memory["x"], t)
        self._u, self._λ_0, self.slip = (memory[name].copy() for name in ("anchored", "multiplier", "slip"))
        self._state = self._state_0 = memory["state"].astype(np.int8)
        self.begin(t)
