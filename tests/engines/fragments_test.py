#!/usr/bin/python3
"""Compares the fragments and exact colours that tools/port/engines computes without Strata with Strata's, at every pixel that is not near a tie:
fragments_test.py STRATA. Skips with a message and exit status 77 without NumPy."""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ENGINES = pathlib.Path(__file__).resolve().parents[2] / "tools" / "port" / "engines"
sys.path.insert(0, str(ENGINES))
FEWEST_DECIDED = 0.7  # fraction of the frame's pixels
MOST = 0.001  # largest difference, in 8-bit codes, from a picture in binary32


def pictures_differ(strata, folder, name):
    """A description of the differences of a scene; "" if there are none."""
    import pictures
    import rules
    import table
    pack = folder / name
    subprocess.run([strata, "golden", *table.words_of(name, folder), "--background", "0.2,0.2,0.4", "--algorithm", "a_buffer", "--color-format", "rgba32f",
                    "-o", pack, "-q"], check=True, stdout=subprocess.DEVNULL)
    frame = table.Frame(pack)
    drawn = pictures.read(pack / "expected" / "a_buffer" / "picture.npy")
    decided = [(x, y) for y, row in enumerate(frame.pixels[False]) for x, pixel in enumerate(row) if pixel is not None]
    if len(decided) < FEWEST_DECIDED * frame.scene.width * frame.scene.height:
        return f"{name}: {len(decided)} pixels are decided, expected more"
    worst = max((min(rules.distance(drawn[y][x], color) for color in frame.right[y][x]), x, y) for x, y in decided)
    return f"{name}: at {worst[1]},{worst[2]} the pictures are {worst[0]:.4f} codes apart" if worst[0] > MOST else ""


def main(strata):
    try:
        import numpy  # noqa: F401
    except ImportError:
        print("SKIPPED: python3-numpy was not found; tools/port/engines/install.sh installs it with python3-vtk9")
        return 77
    import scenes
    with tempfile.TemporaryDirectory() as folder:
        scenes.main(folder)
        wrong = [found for name in ("hidden", "gradient", "torus", "inside-out") if (found := pictures_differ(strata, pathlib.Path(folder), name))]
    print("\n".join(wrong) or "Strata draws the fragments that fragments.py computes")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
