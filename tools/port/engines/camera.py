#!/usr/bin/python3
"""Writes the matrices of an engine's own camera as a camera file of Strata, for --camera of every command.

    camera.py ENGINE LOOK.json --size WxH -o CAMERA.json

LOOK.json is a camera file of the first form (tools/docs/files.md): eye, center, up, fovy_degrees, near, far. Exit status 77 if a program or a
package is missing.
"""
import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import draw  # noqa: E402
import vtk_driver  # noqa: E402
import web  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0], usage=__doc__.split("\n\n")[1].strip())
    parser.add_argument("engine", choices=draw.WAYS)
    parser.add_argument("look", type=pathlib.Path)
    parser.add_argument("--size", required=True)
    parser.add_argument("-o", dest="output", required=True, type=pathlib.Path)
    given = parser.parse_args()
    if draw.missing(given.engine):
        print(draw.missing(given.engine))
        return draw.SKIPPED
    width, height = map(int, given.size.split("x"))
    look = json.loads(given.look.read_text())
    try:
        with draw.browser_for(given.engine) as browser:
            made = vtk_driver.matrices(look, width, height) if given.engine == "vtk" else browser.matrices(given.engine, look, width, height)
    except web.WebError as error:
        print(f"camera.py: {error}", file=sys.stderr)
        return 2
    given.output.write_text(json.dumps(made) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
