"""What the README shows is what happens."""

import contextlib
import io
import re
from pathlib import Path

import numpy as np
import pytest

import dolfinrod as dr
from dolfinrod.scene import toml

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
NUMBER = r"-?\d+\.\d*"


def block(language: str) -> str:
    """The first code block of a language."""
    found = re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)
    assert found is not None
    return found.group(1)


def test_python_example_prints_what_is_shown():
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block("python"), "README.md", "exec"), {})
    shown = block("text")
    # Words and iteration counts to the letter, lengths in mm to a nanometre.
    assert re.sub(NUMBER, "#", printed.getvalue()).split() == re.sub(NUMBER, "#", shown).split()
    numbers = [np.array(re.findall(NUMBER, text), dtype=float) for text in (printed.getvalue(), shown)]
    assert numbers[0] == pytest.approx(numbers[1], abs=1e-6)


def test_python_example_is_short():
    assert len([line for line in block("python").splitlines() if line.strip()]) <= 10


def test_scene_file_poses_the_same_scene():
    scene, options = toml.loads(block("toml"))
    fibre = dr.Rod.straight(length=0.04, section=dr.Section.ramie())
    assert scene == dr.Scene(
        rods=[fibre], supports=[dr.Clamp(at="start")], loads=[dr.PointForce((0, -1e-6, 0), at="end")]
    )
    assert options == {"elements": 16, "degree": 3}


def test_every_name_of_the_package_exists():
    names = set(re.findall(r"`dr\.(\w+)", README))
    assert names
    assert all(hasattr(dr, name) for name in names)


def test_pictures_are_there():
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README)
    assert pictures
    assert all((Path(__file__).parents[1] / picture).stat().st_size > 0 for picture in pictures)


def test_stability_example_prints_what_its_comments_say():
    """The critical load is that of case F1-Pcr-EA1200.0-GA500.0 of the references, 2.460338954539246."""
    section = README.split("## Stability")[1].split("\n## ")[0]
    (example,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(example, "README.md", "exec"), {"dr": dr})
    critical, linearised, frequencies = printed.getvalue().splitlines()
    assert float(critical) == pytest.approx(2.460338954539246, rel=1e-7)
    assert np.array(re.findall(NUMBER, linearised), dtype=float) * 10.0 == pytest.approx([2.46, 2.46], abs=0.01)
    assert len(set(re.findall(NUMBER, frequencies))) == 1


def test_motion_example_prints_what_its_comments_say():
    """The fibre falls and is blown downwards; its ledger closes."""
    section = README.split("## Motion in time")[1].split("\n## ")[0]
    (example,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    names: dict[str, object] = {"dr": dr}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(example, "README.md", "exec"), names)
    t, *tip, _, v_y, _ = (float(number) for number in re.findall(NUMBER, printed.getvalue().splitlines()[0]))
    assert t == pytest.approx(0.01)
    assert tip == pytest.approx(names["result"].tip)
    assert v_y < -0.1
    energy = names["result"].energy
    gained = sum(energy[name] - energy[name][0] for name in ("kinetic", "strain", "potential"))
    works = sum(energy[name] for name in ("load work", "support work", "drag", "damping", "numerical"))
    np.testing.assert_allclose(gained, works, rtol=0, atol=1e-10 * np.abs(gained).max())


def contact_section() -> tuple[str, str]:
    """Its example in Python and its scene file."""
    section = README.split("## Contact and friction")[1].split("\n## ")[0]
    (python,), (table,) = (re.findall(rf"```{name}\n(.*?)```", section, re.DOTALL) for name in ("python", "toml"))
    return python, table


def test_contact_example_prints_what_its_comments_say():
    """The floor bears q L and holds 0.6 q L by sticking; gap g_0 − q/ε_N of Penalty.tight()."""
    names: dict[str, object] = {"dr": dr}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(contact_section()[0], "README.md", "exec"), names)
    force, numbers = printed.getvalue().splitlines()
    np.testing.assert_allclose(np.array(force.strip("[]").split(), dtype=float), [-2.4e-4, 4e-4, 0.0], atol=1e-10)
    gap, slip = (float(number) for number in numbers.split())
    assert gap == pytest.approx(1e-6 - 0.01 / 4e5, rel=1e-6)
    assert slip == 0.0
    for name in ("s", "share", "gap", "pressure", "normal", "traction", "slip", "state"):
        assert hasattr(names["touching"], name)


def test_contact_in_a_scene_file_is_that_of_the_example():
    rod = '[section.ramie.ramie]\n[[rods]]\nstraight = { length = "40 mm" }\nsection = "ramie"\n'
    scene, _ = toml.loads(rod + contact_section()[1])
    assert scene.contacts == (
        dr.Contact(dr.Plane(normal=(0, 1, 0)), law=dr.Penalty.tight(), friction=dr.Coulomb(mu=0.64)),
    )


def ran(title: str, number: int = 0) -> tuple[str, dict[str, object]]:
    """What an example of a section prints, and its names."""
    section = README.split(f"## {title}\n")[1].split("\n## ")[0]
    example = re.findall(r"```python\n(.*?)```", section, re.DOTALL)[number]
    names: dict[str, object] = {"dr": dr}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(example, "README.md", "exec"), names)
    return printed.getvalue(), names


def test_crossed_fibres_press_as_is_shown():
    printed, names = ran("Rods that touch rods")
    assert float(printed) == pytest.approx(-2.306e-6, rel=2e-3)
    for name in ("rod_a", "s_a", "rod_b", "s_b", "point", "gap", "length", "force", "normal", "traction", "state"):
        assert hasattr(names["met"], name)


def test_core_of_the_example_moves_across_and_rolls():
    _, names = ran("Rods that touch rods", 1)
    assert set.intersection(*(set(support.free) for support in names["scene"].supports)) == {"y", "z", "rx"}


def test_twist_example_prints_what_its_comments_say():
    """Three strands laid with 55 turns a metre, 2.2 in 40 mm."""
    of_the_bundle, of_two = ran("How much it twists")[0].splitlines()
    assert np.array(of_the_bundle.split(), dtype=float) == pytest.approx([55.0, 55.0], abs=2e-3)
    assert float(of_two) == pytest.approx(2.2, abs=1e-3)


@pytest.mark.serial
def test_groove_example_prints_what_its_comments_say(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    printed, names = ran("Groove scenarios")
    first, twists = printed.splitlines()
    found = names["found"]
    numbers = [found.winding[0, 1], found.T_pair, found.along.width.mean() * 1e3]
    assert np.array(re.findall(NUMBER, first), dtype=float) == pytest.approx(numbers, abs=6e-4)
    assert len(re.findall(NUMBER, twists)) == len(names["runs"].finished) == 4
    assert names["runs"].runs[1].T_pair == pytest.approx(found.T_pair)
    assert len((tmp_path / "runs" / "runs.csv").read_text(encoding="utf-8").splitlines()) == 5
