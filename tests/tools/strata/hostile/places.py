"""An attempt, and its folder: here/ with the files of a hostile user, outside/ with files that they may not use."""
import dataclasses
import json
import os
import pathlib
import typing

from formats import CAMERA, CORNERS, PANES, png

SIZE = ["--size", "8x8"]
ESCAPES = "\x1b]0;pwned\x07\x1b[2J\x9b31m\x7f\r\nstrata: done\u202e"
MARKUP = "</script><script>pwned()</script>\"'><img src=x onerror=\"pwned()\">&lt;]]>--><svg onload='pwned()'>"
LONG, LONG_WORD = "n" * 1_000_000, "n" * 100_000  # Linux takes words of at most 128 KiB


@dataclasses.dataclass
class Attempt:
    kind: str
    what: str
    make: typing.Callable  # (place, program): writes the files; may return an object with was_asked()
    commands: list  # words after "strata"
    must_fail: bool  # the command could succeed only by using the file
    harmless: bool = False  # the valid form of the file: the command must succeed, otherwise the attempts of this kind prove nothing


def write(place, name, content):
    path = place / "here" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def write_json(place, name, value):
    write(place, name, json.dumps(value).encode())


def link(place, name, target):
    path = place / "here" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def pipe(place, name):
    os.mkfifo(place / "here" / name)


def write_outside(place):
    """Writes usable files outside of the folder, and files that no command may touch."""
    outside: pathlib.Path = place / "outside"
    for name, content in (("triangle.bin", CORNERS), ("picture.png", png()), ("panes.json", json.dumps(PANES).encode()),
                          ("camera.json", json.dumps(CAMERA).encode()), ("line.txt", b"a line\n"), ("word.txt", b"a word"),
                          ("victim.png", b"old"), ("victim.html", b"old")):
        (outside / name).write_bytes(content)
