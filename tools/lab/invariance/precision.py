#!/ usr / bin / env python3
"""Makes tools/lab/invariance/PRECISION.md and its plot: how close two surfaces may be for each depth buffer, by their distance from the eye.

    tools/lab/invariance/precision.py build/release/strata      (needs python3-matplotlib)

The numbers are those of `strata invariance --precision NEAR:FAR`, and of the sweep of written.json.
"""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))
import pages  # noqa: E402
import plots  # noqa: E402

SPAN = "0.1:10000"
ABOUT = """Two surfaces parallel to the image are told apart by a depth buffer if their codes differ. The table has the least distance between them, in
metres, for a near plane at 0.1 m and a far plane at 10 km: the largest of sixteen places at each distance. An empty cell: no two surfaces up to the far plane
are told apart. Positions and their transform are binary32, as a device has them: at 1 km a position has steps of 0.06 mm. How it is measured:
[precision.h](precision.h). Other planes: `strata invariance --precision NEAR:FAR`."""
CHOICES = [
    "`d16`, `d24`, `d32f`: linear in the window. A step grows with the square of the distance; 32 bits are hardly better than 24, because floats are dense near 0 "
    "and depths of distant surfaces are near 1.",
    "`d32f reversed`: `--depth-format d32f --depth-order greater --clip-depth zero-to-one`. The dense floats are at the far plane: a step grows with the distance.",
    "logarithmic: `--depth-path logarithmic`, log2(1 + w) / log2(1 + far), written by a program. The best that 24 bits can do over such a range; programs that "
    "write depth switch a device's early depth test off.",
    "`packed_rgba8`: `--depth-path packed_rgba8`, z as four bytes of a colour, read back by a program: the same steps as `d32f`.",
    "`d24 w buffer`: `--profile geforce3 --depth-path w_buffer`, w itself: the same step at every distance.",
]


SWEPT = """What a peel loses by these depths, swept like every pair of paths: `strata invariance --plan tools/lab/invariance/written.json -o FOLDER`, the teapot at
256x192 by `front_to_back` on `geforce8`, stored as `d32f`. Nothing is lost: a depth that three.js (r160 and later) packs into four bytes is read back as it was from 2^-7 on, so z may
even be compared with it; below, it is off by at most 2^-32 (`tests/peeling/written_depths_test.cpp` shows a peel that repeats layers there)."""


def sweep_rows(program, folder):
    """The rows of written.json: pair of paths, far / near, remedy, and what went wrong."""
    plan = FOLDER / "written.json"
    subprocess.run([program, "invariance", "--plan", str(plan), "--no-images", "-o", folder], check=True, stdout=subprocess.DEVNULL)
    for row in pages.records_in(pathlib.Path(folder) / "results.csv"):
        ratio = float(row["far"]) / float(row["near"])
        yield [f"`{row['write_path']}`", f"`{row['compare_path']}`", f"{ratio:.3g}", row["remedy"], row["differing"], row["duplicated"], row["lost"], row["outcome"]]


def numbers(row):
    return {
name: float(text) for name, text in row.items() if text
}

def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "invariance", "--precision", SPAN, "-o", folder], check=True, stdout=subprocess.DEVNULL)
        rows = pages.records_in(pathlib.Path(folder) / "precision.csv")
        swept = list(sweep_rows(sys.argv[1], str(pathlib.Path(folder) / "sweep")))
    names = [name for name in rows[0] if name != "distance"]
    series = {name: [(at["distance"], at[name]) for at in map(numbers, rows) if name in at] for name in names}
    figure, (axes,) = plots.axes_of(7, 4.5, "The least distance that a depth buffer tells, near 0.1 m, far 10 km", "distance from the eye, m", "step, m")
    plots.draw_series(axes, series)
    axes.set_xscale("log")
    axes.set_yscale("log")
    page = FOLDER / "PRECISION.md"
    blocks = [("title", "Precision by distance"), ("text", ABOUT),
              ("table", ["distance, m", *names], [[row["distance"], *(row[name] for name in names)] for row in rows], range(len(names) + 1)),
              ("plot", "steps", "Steps of every depth buffer by distance", plots.svg_of(figure)), ("list", CHOICES),
              ("heading", "Peels by depths that programs write"), ("text", SWEPT),
              ("table", ["stored", "compared", "far / near", "remedy", "depths that differ", "layers repeated", "lost", "outcome"], swept, range(2, 7)),
              ("text", "A decal, reversed and logarithmic depth beside one another: [how to](../../docs/how-to.md#13-choose-a-depth-buffer-for-distant-surfaces).")]
    page.write_text(pages.markdown_of(blocks, page), encoding="utf-8")


main()
