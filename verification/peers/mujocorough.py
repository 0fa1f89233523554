"""MuJoCo's cable on rough surfaces: a chain of cylinders on a plane, and of capsules drawn over a long fixed one.

Implicit integrator, elliptic friction cones; contacts are soft, so that what sticks creeps. The rope is drawn by a
stiff velocity actuator, whose force is the pull. MuJoCo's documentation, "Composite objects" (cable), "Contact"
(condim, impratio, solref), "Actuators" (velocity, motor, refsite).
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi
from typing import Any

import mujoco
import numpy as np

from verification.peers.rodshape import round_drum

__all__ = ["POSED"]

# Contacts give way for so many steps, the least that is stable, and slip so many times less easily than they sink in.
STEPS, FIRM = 2.0, 100.0
# Force of the actuator over counterpull and shortfall of speed, and the part of the time over which it is averaged.
STIFF, LAST = 1e3, 0.2
BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
MODEL = """
<mujoco>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <option timestep="{step!r}" gravity="0 0 {gravity!r}" integrator="implicit" cone="elliptic" impratio="{firm!r}">
    <flag autoreset="disable"/></option>
  <worldbody>
    <site name="axes"/> <geom {surface} {rough}/>
    <composite type="cable" vertex="{places}" initial="free">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{E!r}"/><config key="twist" value="{G!r}"/><config key="flat" value="true"/>
      </plugin>
      <joint kind="main" damping="0" armature="0"/>
      <geom type="{shape}" size="{radius!r}" mass="{mass!r}" {rough}/>
    </composite>
  </worldbody>
  {actuators}
</mujoco>
"""
ACTUATORS = """<actuator>
    <motor site="S_first" refsite="axes" gear="0 -1 0 0 0 0"/>
    <velocity site="S_last" refsite="axes" gear="0 -1 0 0 0 0" kv="{kv!r}"/>
  </actuator>"""


def made(problem: dict[str, Any], settings: dict[str, Any], places: np.ndarray, **words: Any) -> mujoco.MjModel:
    """A cable through places (n + 1, 3) at a surface."""
    moment = 0.25 * pi * problem["radius"] ** 4
    text = MODEL.format(
        step=settings["step"],
        firm=FIRM,
        # A composite takes no defaults.
        rough=f'friction="{problem["mu"]!r} 0 0" condim="3" solref="{STEPS * settings["step"]!r} 1"',
        places=" ".join(repr(float(c)) for place in places for c in place),
        E=problem["EI"] / moment,
        # The plugin's twisting stiffness is that of the polar moment, twice the other.
        G=problem["GJ"] / (2.0 * moment),
        radius=problem["radius"],
        mass=problem["rhoA"] * problem["length"] / (len(places) - 1),
        **words,
    )
    return mujoco.MjModel.from_xml_string(text)


def plane(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A cable along x on the plane z = 0, pushed."""
    n, length, radius = settings["elements"], problem["length"], problem["radius"]
    places = np.linspace([0.0, 0.0, radius], [length, 0.0, radius], n + 1)
    surface = 'type="plane" size="9 9 1"'
    model = made(problem, settings, places, gravity=-problem["g"], surface=surface, shape="cylinder", actuators="")
    data = mujoco.MjData(model)
    data.qvel[:3] = problem["velocity"]

    def solve() -> list[list[float]]:
        found = []
        for until in problem["times"]:
            mujoco.mj_step(model, data, round((until - data.time) / settings["step"]))
            checked(data)
            mujoco.mj_kinematics(model, data)
            x, y, z = data.xipos[1:].mean(axis=0) - places.mean(axis=0)
            found.append([float(x), float(y), float(z)])
        return found

    return solve


def capstan(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A cable drawn over a drum; so many elements lie on it."""
    n, force = settings["elements"], problem["force"]
    places, actuators = np.array(round_drum(n, problem["tail"])), ACTUATORS.format(kv=STIFF * force)
    drum = f'type="capsule" size="{cos(0.5 * pi / n) - problem["radius"]!r} 1"'
    model = made(problem, settings, places, gravity=0.0, surface=drum, shape="capsule", actuators=actuators)
    data = mujoco.MjData(model)
    data.ctrl[:] = force, problem["speed"]
    steps = round(problem["times"][0] / settings["step"])

    def solve() -> list[list[float]]:
        mujoco.mj_step(model, data, round((1.0 - LAST) * steps))
        pulls = []
        for _ in range(round(LAST * steps)):
            mujoco.mj_step(model, data)
            pulls.append(data.actuator_force[1])
        checked(data)
        return [[float(np.mean(pulls)) / force, 0.0, 0.0]]

    return solve


def checked(data: mujoco.MjData) -> None:
    """It has not diverged."""
    if any(data.warning[kind].number for kind in BAD):
        raise ArithmeticError(f"unstable before t = {data.time:g} s")


POSED = {"plane": plane, "capstan": capstan}
