"""MuJoCo before 4.0: its cable, a chain of rigid bodies that neither stretches nor shears, with the elasticity plugin.

The bodies are thin boxes of the given mass; the plugin takes Young's and shear modulus of a square section of that
size. Fourth-order Runge-Kutta; MuJoCo's documentation, "Composite objects" (cable) and "Numerical integration".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco

__all__ = ["POSED"]

# Half the side of the square section over the length: thin enough for its rotary inertia not to count.
THIN = 1e-3
BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)

MODEL = """
<mujoco>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <option timestep="{step!r}" gravity="0 {gravity!r} 0" integrator="RK4">
    <flag contact="disable" autoreset="disable"/>
  </option>
  <worldbody>
    <composite type="cable" curve="s" count="{nodes} 1 1" size="{length!r} 0 0" initial="ball">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{E!r}"/><config key="twist" value="{G!r}"/><config key="flat" value="true"/>
      </plugin>
      <joint kind="main" damping="0" armature="0"/>
      <geom type="box" size="{half!r} {thin!r} {thin!r}" mass="{mass!r}"/>
    </composite>
  </worldbody>
</mujoco>
"""


def swing(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A rod pinned at one end, released from the horizontal."""
    n, length = settings["elements"], problem["length"]
    thin = THIN * length
    moment = (2.0 * thin) ** 4 / 12.0
    text = MODEL.format(
        step=settings["step"],
        gravity=-problem["g"],
        nodes=n + 1,
        length=length,
        E=problem["EI"] / moment,
        # The plugin's twisting stiffness is that of the polar moment, twice the other.
        G=problem["GJ"] / (2.0 * moment),
        half=0.5 * length / n,
        thin=thin,
        mass=problem["rhoA"] * length / n,
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    end = model.site("S_last").id

    def solve() -> list[list[float]]:
        tip: list[list[float]] = []
        done = 0
        for until in problem["times"]:
            steps = round(until / settings["step"])
            mujoco.mj_step(model, data, steps - done)
            done = steps
            if any(data.warning[kind].number for kind in BAD):
                raise ArithmeticError(f"unstable before t = {until:g} s")
            mujoco.mj_kinematics(model, data)
            tip.append([float(c) for c in data.site_xpos[end]])
        return tip

    return solve


POSED = {"swing": swing}
