"""MuJoCo's cable in equilibrium: a chain of rigid bodies that neither stretches nor shears.

There is no static solver: the cable is held at its first body, loaded by a motor in fixed axes at its end and damped at
its joints until it does not move any more; implicit integrator. MuJoCo's documentation, "Composite objects" (cable),
"Numerical integration" and "Actuators" (refsite).
"""

from __future__ import annotations

from collections.abc import Callable
from math import dist
from typing import Any

import mujoco

__all__ = ["POSED"]

# Half the side of the square section over the length, the damping of a joint over EI/L s, and the step times n².
THICK, DAMPED, STEP = 1e-2, 0.2, 0.2
# Steps looked at together, at most so many times, and the movement over the length meanwhile that counts as rest.
LOOK, MOST, REST = 500, 400, 1e-7
MODEL = """
<mujoco>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <option timestep="{step!r}" gravity="0 0 0" integrator="implicit">
    <flag contact="disable" autoreset="disable"/>
  </option>
  <worldbody>
    <site name="axes"/>
    <composite type="cable" curve="s" count="{nodes} 1 1" size="{length!r} 0 0" initial="none">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{E!r}"/><config key="twist" value="{G!r}"/><config key="flat" value="true"/>
      </plugin>
      <joint kind="main" damping="{damping!r}" armature="0"/>
      <geom type="box" size="{half!r} {thin!r} {thin!r}" mass="{mass!r}"/>
    </composite>
  </worldbody>
  <actuator><motor site="S_last" refsite="axes" gear="{x!r} {y!r} {z!r} 0 0 0"/></actuator>
</mujoco>
"""


def rod(problem: dict[str, Any], settings: dict[str, Any]) -> Callable[[], list[list[float]]]:
    """A clamped rod under a force at its end, let go and damped."""
    if problem["angle"] != 0.0 or any(problem["moment"]):
        raise ArithmeticError("the adapter poses straight rods under tip forces only")
    n, length = settings["elements"], problem["length"]
    thin = THICK * length
    moment = (2.0 * thin) ** 4 / 12.0
    # The mass does not matter at rest: one that makes L²√(ρA/EI) a second.
    text = MODEL.format(
        step=STEP / n**2,
        nodes=n + 1,
        length=length,
        E=problem["EI"] / moment,
        # The plugin's twisting stiffness is that of the polar moment, twice the other.
        G=problem["GJ"] / (2.0 * moment),
        damping=DAMPED * problem["EI"] / length,
        half=0.5 * length / n,
        thin=thin,
        mass=problem["EI"] / length**3 / n,
        **dict(zip("xyz", problem["force"], strict=True)),
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.ctrl[:] = 1.0
    end = model.site("S_last").id

    def solve() -> list[list[float]]:
        before = [0.0, 0.0, 0.0]
        for _ in range(MOST):
            mujoco.mj_step(model, data, LOOK)
            mujoco.mj_kinematics(model, data)
            tip = [float(c) for c in data.site_xpos[end]]
            if dist(tip, before) < REST * length:
                return [tip]
            before = tip
        raise ArithmeticError(f"not at rest after {MOST * LOOK} steps")

    return solve


POSED = {"rod": rod}
