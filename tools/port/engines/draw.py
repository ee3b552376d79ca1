#!/usr/bin/python3
"""Renders the scene of a golden pack with an engine and writes the picture. The interpreter is Debian's, which has Debian's VTK.

    draw.py ENGINE PACK -o PICTURE [--way WAY] [--peels N] [--targets FOLDER]

PICTURE ends in .png or .npy; a picture of floats is .npy. --targets writes a candidate (tools/oracle/pack/PACK.md): Babylon's targets after
every pass. Exit status 2, and a sentence, if the pack has something that the engine cannot render here; 77 if a program or a package is missing.
"""
import argparse
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import pack_scene  # noqa: E402
import pictures  # noqa: E402
import vtk_driver  # noqa: E402
import web  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
PACKAGES = HERE.parents[2] / "build" / "engines"
WEB = {"babylon": ("@babylonjs/core", ["oit", "blended"]), "molstar": ("molstar", ["dpoit", "wboit", "blended"]),
       "three": ("three", ["blended", "no-depth-write", "float"])}
WAYS = {"vtk": vtk_driver.WAYS, **{engine: ways for engine, (_, ways) in WEB.items()}}
PEELS = [("vtk", "dual"), ("vtk", "peeling"), ("babylon", "oit"), ("molstar", "dpoit")]
SKIPPED = 77


def missing(engine):
    """The packages that this computer lacks for the engine, as a sentence; "" if none is missing."""
    if engine in WEB:
        package = WEB[engine][0]
        if not (PACKAGES / package / "package.json").is_file():
            return f"SKIPPED: the npm package {package} is not in {PACKAGES}; tools/port/engines/install.sh puts it there"
        return "" if shutil.which("chromium") else "SKIPPED: chromium was not found; tools/port/engines/install.sh installs it"
    try:
        import vtkmodules  # noqa: F401
    except ImportError:
        return "SKIPPED: python3-vtk9 was not found; tools/port/engines/install.sh installs it"
    return "" if os.environ.get("DISPLAY") or shutil.which("Xvfb") else "SKIPPED: Xvfb was not found; tools/port/engines/install.sh installs it"


def with_display():
    """Starts this program again under Xvfb if there is no display."""
    return subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24", sys.executable, *sys.argv]).returncode


def draw(engine, scene, way, browser, peels=None, wants_targets=False):
    """The targets that the engine rendered, as web.Drawn; `picture` is one of them. VTK's has three channels, because VTK's own alpha is 0 behind all
    surfaces. `browser` is a web.Browser, for VTK None."""
    if engine == "vtk":
        data = pictures.without_alpha(vtk_driver.draw(scene, way, peels))
        return [web.Drawn("picture", scene.width, scene.height, 3, "u1", data)]
    return browser.draw(scene, engine, way, peels, wants_targets)


def browser_for(engine):
    """The browser argument of draw(), as a context."""
    return web.Browser(PACKAGES) if engine in WEB else contextlib.nullcontext()


def write(drawn, picture, targets):
    for one in drawn:
        shape = (one.data, one.width, one.height, one.channels, one.element)
        if one.name == "picture":
            pictures.write(picture, *shape)
        if targets:
            pictures.write(pathlib.Path(targets) / "dual" / f"{one.name}.npy", *shape)


def options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0], usage=__doc__.split("\n\n")[1].strip())
    parser.add_argument("engine", choices=WAYS)
    parser.add_argument("pack")
    parser.add_argument("-o", dest="picture", required=True)
    parser.add_argument("--way", help="; ".join(f"{engine}: {', '.join(ways)}" for engine, ways in WAYS.items()) + " (default: the first)")
    parser.add_argument("--peels", type=int, help="of a peel; default: the engine's own")
    parser.add_argument("--targets", metavar="FOLDER", help="with babylon: every target after every pass")
    return parser


def main():
    parser = options()
    given = parser.parse_args()
    way = given.way or WAYS[given.engine][0]
    if way not in WAYS[given.engine]:
        parser.error(f"--way: expected one of {', '.join(WAYS[given.engine])} with {given.engine}, found {way}")
    if given.peels is not None and (given.engine, way) not in PEELS:
        parser.error(f"--peels: expected a way that peels, found {given.engine} with way {way}")
    if given.targets and (given.engine, way) != ("babylon", "oit"):
        parser.error("--targets: expected babylon with way oit; of the other engines the picture alone is read")
    if missing(given.engine):
        print(missing(given.engine))
        return SKIPPED
    if given.engine == "vtk" and not os.environ.get("DISPLAY"):
        return with_display()
    try:
        scene = pack_scene.read_scene(given.pack)
        with browser_for(given.engine) as browser:
            write(draw(given.engine, scene, way, browser, given.peels, bool(given.targets)), given.picture, given.targets)
    except pack_scene.PackError as error:
        print(f"draw.py: {given.pack}: {error}", file=sys.stderr)
        return 2
    except (web.WebError, ValueError) as error:
        print(f"draw.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
