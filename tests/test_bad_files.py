"""Files that hold no scene: one line on stderr, exit code 2, within seconds, and nothing is written."""

from __future__ import annotations

import errno
import os
import time
from pathlib import Path
from typing import NoReturn

import pytest

from dolfinrod import cli
from dolfinrod.scene import source
from tests.conftest import world

MB = 1_000_000
BARE = b"""
[section.a]
GJ = 1.0
EI = 1.0
rigid = ["shear", "extension"]
[[rods]]
straight = { length = 1.0 }
section = "a"
"""
CLAMPED = BARE + b'[[supports]]\nclamp = { at = "start" }\n'

CONTENTS = {
    "empty": (b"", "rods must hold at least one rod, got none"),
    "blank": (b"\n \t\n", "rods must hold at least one rod, got none"),
    "zeros": (b"\0" * 10_000, "a scene must be a TOML file"),
    "binary": (bytes(range(256)) * 100, "must be text in UTF-8"),
    "picture": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "must be text in UTF-8"),
    "UTF-16": (CLAMPED.decode().encode("utf-16"), "must be text in UTF-8"),
    "Latin-1": ("# Länge\n".encode("latin-1") + CLAMPED, "must be text in UTF-8"),
    "prose": (b"Dear Sir or Madam,\n", "a scene must be a TOML file"),
    "5 MB of keys": (b"".join(b"key%d = 1\n" % i for i in range(400_000)), "at most 4000000 bytes"),
    "5 MB of brackets": (b"rods = " + b"[" * 5 * MB, "at most 4000000 bytes"),
    "5 MB of names": (b"a." * (5 * MB // 2) + b"a = 1", "at most 4000000 bytes"),
    "brackets": (b"rods = " + b"[" * MB, "must not nest lists and tables so deeply"),
    "closed brackets": (b"rods = " + b"[" * 5000 + b"]" * 5000, "must not nest lists and tables so deeply"),
    "tables in tables": (b"rods = " + b"{ a = " * 100_000, "must not nest lists and tables so deeply"),
    "brackets in a force": (
        CLAMPED + b'[[loads]]\npoint_force = { at = "end", force = ' + b"[" * 900 + b"]" * 900 + b" }",
        "must not nest lists and tables so deeply",
    ),
    "dotted names": (b"a." * 100_000 + b"a = 1", "must not nest tables so deeply"),
    "dotted quoted names": (b'"a b" . ' * 100_000 + b"a = 1", "must not nest tables so deeply"),
    "dotted header": (b"[" + b"a." * 100_000 + b"a]", "must not nest tables so deeply"),
    "one long word": (b'rods = "' + b"a" * MB + b'"', "rods must be a list of tables"),
    "many digits": (CLAMPED.replace(b"1.0", b"1" * 5000), "a scene must be a TOML file: Exceeds the limit"),
    "20000 rods": (
        BARE + b'[[rods]]\nstraight = { length = 1 }\nsection = "a"\n' * 20_000,
        "rods must be at most 10000",
    ),
    "20000 supports": (
        BARE + b"[[supports]]\npin = { at = 0 }\n" * 20_000,
        "supports must be at most 10000, got 20000",
    ),
    "20000 contacts": (
        BARE + b"[[contacts]]\nplane = {}\n" * 20_000,
        "contacts must be at most 10000, got 20000",
    ),
    "20000 points": (
        BARE + b'[[rods]]\nsection = "a"\nthrough = { points = [' + b"[0, 0, 1]," * 20_000 + b"] }",
        "rods[1].through.points must be at most 10000, got 20000",
    ),
    "long list": (b"rods = [" + b"1," * 100_000 + b"]", "rods must be at most 10000, got 100000"),
    "duplicate key": (CLAMPED.replace(b"GJ = 1.0", b"GJ = 1.0\nGJ = 2.0"), "Cannot overwrite a value"),
    "duplicate section": (CLAMPED + b"[section.a]\nGJ = 2.0", "Cannot declare ('section', 'a') twice"),
    "duplicate list": (CLAMPED + b"[rods]\n", "a scene must be a TOML file"),
    "escape sequence in a name": (b'"\\u001b[31m\\u202e" = 1\n' + CLAMPED, "\\x1b[31m\\u202e is unknown"),
    "line break in a name": (b'"one\\ntwo\\r" = 1\n' + CLAMPED, "one two is unknown"),
    "raw control character": (b"a\x1b = 1\n" + CLAMPED, "a scene must be a TOML file"),
    "lone surrogate": (b'"\\ud800" = 1\n' + CLAMPED, "not a Unicode scalar value"),
}


@pytest.fixture
def refused(capfd, shared_path):
    """Runs `dolfinrod run` on something that is no scene; what the speaking rank said, checked for good manners."""

    def command(scene: str | Path) -> str:
        out = shared_path / "out"
        begun = time.perf_counter()
        assert cli.main(["run", str(scene), "--out", str(out)]) == 2
        assert time.perf_counter() - begun < 10.0
        said = capfd.readouterr()
        assert (said.out, out.exists()) == ("", False)
        comm = world()
        if comm is not None and comm.rank != 0:
            assert said.err == ""
        err = said.err if comm is None else comm.bcast(said.err, root=0)
        assert err.startswith("dolfinrod: ")
        assert err.index("\n") == len(err) - 1
        assert err[:-1].isprintable()
        assert len(err) < 1500
        return err

    return command


def written(path: Path, content: bytes) -> Path:
    """A file that every rank reads."""
    comm = world()
    if comm is None or comm.rank == 0:
        path.write_bytes(content)
    if comm is not None:
        comm.barrier()
    return path


@pytest.mark.parametrize("name", CONTENTS)
def test_what_is_no_scene_is_refused_in_one_line(refused, shared_path, name):
    content, words = CONTENTS[name]
    assert words in refused(written(shared_path / "scene.toml", content))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("absent.toml", "absent.toml cannot be read: No such file or directory"),
        (".", "cannot be read: Is a directory"),
        ("scene.toml/scene.toml", "cannot be read: Not a directory"),
        ("scene\0.toml", "scene\\x00.toml cannot be read: embedded null byte"),
        ("\x1b[2J\n.toml", "\\x1b[2J .toml cannot be read: No such file or directory"),
        ("a" * 300, "cannot be read: File name too long"),
    ],
)
def test_what_is_no_file_is_refused_in_one_line(refused, shared_path, name, words):
    written(shared_path / "scene.toml", CLAMPED)
    assert words in refused(f"{shared_path}/{name}")


def test_an_endless_device_is_refused(refused):
    assert "at most 4000000 bytes" in refused("/dev/zero")


def test_a_device_without_content_is_an_empty_file(refused):
    assert "rods must hold at least one rod, got none" in refused("/dev/null")


def test_a_file_of_100_megabytes_is_refused_unread(refused, shared_path):
    file = written(shared_path / "scene.toml", CLAMPED)
    os.truncate(file, 100 * MB)
    assert "at most 4000000 bytes" in refused(file)


@pytest.mark.serial
def test_a_pipe_that_nobody_writes_to_is_refused(refused, shared_path, monkeypatch):
    monkeypatch.setattr(source, "PATIENCE", 0.1)
    os.mkfifo(shared_path / "pipe.toml")
    assert "nothing came out of this one for 0.1 s" in refused(shared_path / "pipe.toml")


@pytest.mark.serial
def test_a_pipe_that_is_written_to_is_a_file():
    """As the shell makes one of `<(command)`."""
    read_end, write_end = os.pipe()
    os.write(write_end, CLAMPED)
    os.close(write_end)
    try:
        assert cli.main(["info", f"/dev/fd/{read_end}"]) == 0
    finally:
        os.close(read_end)


def test_a_file_without_permission_is_refused(refused, shared_path, monkeypatch):
    """Refused by the system, which lets root read whatever the mode says."""

    def closed(*_: object) -> NoReturn:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    file = written(shared_path / "scene.toml", CLAMPED)
    monkeypatch.setattr(source, "_at_once", closed)
    assert "cannot be read: Permission denied" in refused(file)


def test_a_link_to_itself_is_refused(refused, shared_path):
    comm = world()
    if comm is None or comm.rank == 0:
        (shared_path / "loop.toml").symlink_to("loop.toml")
    if comm is not None:
        comm.barrier()
    assert "cannot be read: Too many levels of symbolic links" in refused(shared_path / "loop.toml")


def test_the_mark_that_some_editors_put_first_is_no_fault(shared_path):
    file = written(shared_path / "scene.toml", b"\xef\xbb\xbf" + CLAMPED)
    assert cli.main(["info", str(file)]) == 0
