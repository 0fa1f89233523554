"""The README's files in and out are those of the package."""

from __future__ import annotations

import re
from pathlib import Path

import meshio
import numpy as np
import pytest

import dolfinrod as dr
from tests.output.results import identical

pytestmark = pytest.mark.serial

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_the_example_runs_from_a_mesh_in_millimetres_to_a_picture(tmp_path, monkeypatch):
    section = README.split("## Files in, files out")[1].split("\n## ")[0]
    (example,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    x = np.linspace(0.0, 40.0, 9)
    points = np.stack([x, 0.01 * x**2, 0 * x], axis=1)
    monkeypatch.chdir(tmp_path)
    meshio.write("curve.vtu", meshio.Mesh(points, [("line", np.stack([np.arange(8), np.arange(1, 9)], axis=1))]))
    names: dict[str, object] = {"dr": dr}
    exec(compile(example, "README.md", "exec"), names)
    assert identical(names["again"], names["result"])
    assert names["fibre"] == dr.Rod.through(points / 1e3, dr.Section.ramie())
    for file in re.findall(r"`([\w-]+\.\w+)`", section):
        assert (tmp_path / "out" / file).exists()
    assert (tmp_path / "out" / "result.png").stat().st_size > 0
