"""`./run` says in one line what it cannot do, installs only what is missing, and starts at once when nothing is.

Each test runs a copy of the script in a folder of its own, where the commands it calls are stand-ins.
"""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

pytestmark = pytest.mark.serial

ROOT = Path(__file__).parents[1]
REAL_COMMANDS = ["cat", "dirname", "env", "grep", "id", "mktemp", "rm", "sed", "sh", "sha256sum", "tail", "dpkg-query"]
# Python of the virtual environment: notes its arguments, and finds Debian's NumPy.
PYTHON = """
echo "$*" >>calls
case $* in *numpy*) echo /usr/lib/python3/dist-packages/numpy/__init__.py ;; esac
"""
# dpkg-query of a machine that has every package it is asked for.
ALL_INSTALLED = 'for word; do echo " installed $word "; done'


@dataclass
class Machine:
    """A folder with the project's set-up files, and a PATH on which everything can be faked."""

    path: Path

    def fake(self, name: str, script: str) -> None:
        """Put a stand-in for a command on the PATH."""
        self.write(self.path / "bin" / name, script)

    def write(self, file: Path, script: str) -> None:
        """Make an executable shell script."""
        file.unlink(missing_ok=True)
        file.write_text(f"#!/bin/sh\n{script}\n")
        file.chmod(0o755)

    def run(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """Run `./run` there."""
        return subprocess.run(
            [self.path / "run", *arguments],
            env={"PATH": str(self.path / "bin"), "SHELL": "/bin/sh", "HOME": str(self.path), **environment},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )

    @property
    def calls(self) -> list[str]:
        """What the Python of the virtual environment was asked to do so far."""
        file = self.path / "calls"
        return file.read_text().splitlines() if file.exists() else []


@pytest.fixture
def machine(tmp_path):
    """Debian 12 with every package, and a virtual environment whose tools are not installed yet."""
    for name in ("run", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    (tmp_path / "bin").mkdir()
    for name in REAL_COMMANDS:
        (tmp_path / "bin" / name).symlink_to(shutil.which(name, path="/usr/bin:/bin"))
    venv = tmp_path / ".venv"
    (venv / "bin").mkdir(parents=True)
    made_by = f"command = /usr/bin/python3 -m venv --system-site-packages --clear {venv}"
    (venv / "pyvenv.cfg").write_text(f"home = /usr/bin\n{made_by}\n")
    made = Machine(tmp_path)
    made.write(venv / "bin" / "python", PYTHON)
    return made


def complaint(done: subprocess.CompletedProcess[str]) -> str:
    """The one line in which a run that cannot go on says why."""
    assert done.returncode == 1
    assert done.stdout == ""
    *announcements, last = done.stderr.splitlines()
    assert all("installing" in line or "making" in line for line in announcements)
    return last


def test_without_root_and_sudo_the_missing_packages_are_named(machine):
    machine.fake("id", "echo 1000")
    machine.fake("dpkg-query", "echo ' not-installed python3-dolfinx '; exit 1")
    line = complaint(machine.run("test"))
    assert "neither root nor sudo" in line
    assert "python3-dolfinx " in line


def test_sudo_installs_what_is_missing_and_nothing_else(machine):
    machine.fake("id", "echo 1000")
    machine.fake("sudo", 'echo "sudo $*" >>asked; exec "$@"')
    machine.fake("apt-get", 'echo "apt-get $*" >>asked')
    machine.fake("dpkg-query", '/usr/bin/dpkg-query "$@" | grep -v " shellcheck "')
    done = machine.run("shell", "-c", "exit 0")
    assert done.returncode == 0
    assert "installing Debian packages" in done.stderr
    first, *_, install = (machine.path / "asked").read_text().splitlines()
    assert first.startswith("sudo")
    assert install.split("300 ")[1] == "shellcheck"


def test_unreachable_archive_is_named_with_its_last_words(machine):
    machine.fake("id", "echo 0")
    machine.fake("dpkg-query", "exit 1")
    machine.fake("apt-get", "echo 'E: Unable to fetch some archives'; exit 100")
    line = complaint(machine.run("test"))
    assert "is Debian's package archive reachable?" in line
    assert "E: Unable to fetch some archives" in line


def test_unreachable_pypi_is_named_with_its_last_words(machine):
    machine.write(machine.path / ".venv/bin/python", "case $* in *pip*) echo 'ERROR: no route to host'; exit 1 ;; esac")
    line = complaint(machine.run("test"))
    assert "is PyPI reachable?" in line
    assert "ERROR: no route to host" in line


def test_another_numpy_is_refused(machine):
    machine.write(machine.path / ".venv/bin/python", "echo /home/me/.local/numpy/__init__.py")
    assert "NumPy must be Debian's" in complaint(machine.run("test"))


def test_another_system_is_refused(machine):
    machine.fake("grep", "exit 1")
    assert "not Debian 12" in complaint(machine.run("test"))


def test_second_run_installs_nothing_until_the_project_changes(machine):
    first = machine.run("shell", "-c", "exit 0")
    installed = machine.calls
    assert first.returncode == 0
    assert [call for call in installed if "pip install" in call and "--no-deps" in call]
    assert {"-m dolfinrod.continuum.precompile", "-m dolfinrod.groove.precompile"} <= set(installed)
    second = machine.run("shell", "-c", "exit 0")
    assert (second.returncode, second.stdout, second.stderr) == (0, "", "")
    assert machine.calls == installed
    with (machine.path / "pyproject.toml").open("a") as file:
        file.write("# changed\n")
    assert "making .venv" in machine.run("shell", "-c", "exit 0").stderr
    assert len(machine.calls) == 2 * len(installed)


def test_failed_set_up_is_tried_again(machine):
    machine.write(machine.path / ".venv/bin/python", "exit 1")
    complaint_or_exit = machine.run("shell", "-c", "exit 0")
    machine.write(machine.path / ".venv/bin/python", PYTHON)
    assert complaint_or_exit.returncode != 0
    assert "making .venv" in machine.run("shell", "-c", "exit 0").stderr


@pytest.mark.parametrize(
    ("arguments", "asked"),
    [
        (["report", "--quick"], "-m verification --jobs 2 --quick"),
        (["test", "-k", "elastica"], "-m pytest --numprocesses=auto --maxprocesses=4 -k elastica"),
        (["report", "elastica*", "--out", "there"], "-m verification --jobs 2 elastica* --out there"),
        (["test", "--all", "-x"], "-m pytest --numprocesses=auto --maxprocesses=4 -m  -x"),
    ],
)
def test_commands_go_to_the_python_of_the_virtual_environment(machine, arguments, asked):
    machine.fake("dpkg-query", ALL_INSTALLED)
    machine.fake("nproc", "echo 2")
    assert machine.run(*arguments).returncode == 0
    assert machine.calls[-1] == asked


@pytest.mark.parametrize(("cores", "jobs"), [(1, 1), (4, 4), (64, 4)])
def test_a_report_does_as_many_units_at_once_as_there_are_cores_up_to_four(machine, cores, jobs):
    machine.fake("dpkg-query", ALL_INSTALLED)
    machine.fake("nproc", f"echo {cores}")
    assert machine.run("report", "--jobs", "1").returncode == 0
    assert machine.calls[-1] == f"-m verification --jobs {jobs} --jobs 1"


def test_compile_makes_forms_of_the_degrees_asked_for_and_kernels(machine):
    machine.fake("dpkg-query", ALL_INSTALLED)
    assert machine.run("compile", "4", "5").returncode == 0
    assert machine.calls[-2:] == ["-m dolfinrod.continuum.precompile 4 5", "-m dolfinrod.groove.precompile"]


def test_a_browser_is_installed_for_all_tests_only(machine):
    machine.fake("id", "echo 0")
    machine.fake("apt-get", 'echo "$*" >>asked')
    machine.fake("dpkg-query", 'for word; do case $word in chromium) ;; *) echo " installed $word " ;; esac; done')
    assert machine.run("test").returncode == 0
    assert not (machine.path / "asked").exists()
    assert machine.run("test", "--all").returncode == 0
    assert (machine.path / "asked").read_text().splitlines()[-1].split("300 ")[1] == "chromium"


def test_mpi_starts_the_asked_number_of_ranks(machine):
    machine.fake("mpirun", 'echo "$*"')
    done = machine.run("mpi", "3", "-m", "pytest")
    assert done.stdout == f"-n 3 {machine.path}/.venv/bin/python -m mpi4py -m pytest\n"


def test_environment_is_one_thread_and_root_may_start_ranks(machine):
    machine.fake("id", "echo 0")
    found = dict(line.split("=", 1) for line in machine.run("shell", "-c", "env").stdout.splitlines())
    assert found["OMP_NUM_THREADS"] == "1"
    assert found["PYTHONNOUSERSITE"] == "1"
    assert found["OMPI_ALLOW_RUN_AS_ROOT"] == found["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] == "1"
    assert found["VIRTUAL_ENV"] == f"{machine.path}/.venv"
    machine.fake("id", "echo 1000")
    other = machine.run("shell", "-c", "env", OMP_NUM_THREADS="4").stdout
    assert "OMP_NUM_THREADS=4" in other
    assert "ALLOW_RUN_AS_ROOT" not in other


def test_help_sets_nothing_up_and_an_unknown_command_is_refused(machine):
    assert machine.run("help").stdout.startswith("usage: ./run")
    unknown = machine.run("tset")
    assert unknown.returncode == 1
    assert unknown.stderr.splitlines()[-1] == "run: unknown command: tset"
    assert machine.calls == []


def test_peers_makes_their_environment_once(machine):
    requirements = machine.path / "verification" / "peers" / "requirements.txt"
    requirements.parent.mkdir(parents=True)
    requirements.write_text("# pinned\nexudyn == 1\n")
    python = machine.path / ".venv-peers" / "bin" / "python"
    script = (machine.path / "run").read_text()
    (machine.path / "run").write_text(script.replace('"$(peers_python)" -m venv --clear', "make-venv"))
    machine.fake("make-venv", 'echo "$1" >>made')
    python.parent.mkdir(parents=True)
    machine.write(python, 'echo "$*" >>made')
    first, second = machine.run("peers"), machine.run("peers")
    assert first.stdout == second.stdout == "exudyn == 1\n"
    assert "making .venv-peers" in first.stderr
    assert "making" not in second.stderr
    made, installed = (machine.path / "made").read_text().splitlines()
    assert made == str(machine.path / ".venv-peers")
    assert installed.endswith("-r verification/peers/requirements.txt")
    requirements.write_text("exudyn == 2\n")
    machine.write(python, "echo no such version >&2; exit 1")
    assert "no such version" in complaint(machine.run("peers"))
    assert "making .venv-peers" in machine.run("peers").stderr
