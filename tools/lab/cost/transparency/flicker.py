"""How much the error of an algorithm changes from frame to frame, for transparency.py.

A camera turns around the scene in equal steps. e(t) is the picture of frame t minus the exact one, in codes; the flicker is the root mean square of
e(t + 1) - e(t) over all frames, pixels and channels. An error that stays where it is does not flicker.
"""
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "docs"))
from gallery import rows_of_png  # noqa: E402

FRAMES, STEP, SIZE = 12, 0.25, "128x128"


def frame(strata, words, algorithm, degrees):
    """The bytes of a picture."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "frame.png"
        subprocess.run([str(strata), "render", *map(str, words), "--size", SIZE, "--orbit", f"{degrees},20", "--profile", "ideal", "--color-format", "rgba8",
                        "--no-audit", "-q", "--algorithm", *algorithm.split(), "-o", str(path)], check=True, stdout=subprocess.DEVNULL)
        return b"".join(rows_of_png(path)[1])


def path_of(strata, words, algorithm):
    return [frame(strata, words, algorithm, 30 + STEP * t) for t in range(FRAMES)]


def flicker_of(pictures, exact):
    total = count = 0
    for t in range(FRAMES - 1):
        total += sum(((b - y) - (a - x)) ** 2 for a, b, x, y in zip(pictures[t], pictures[t + 1], exact[t], exact[t + 1]))
        count += len(pictures[t])
    return math.sqrt(total / count)


def flickers(strata, words, algorithms):
    """The flicker of each algorithm, in codes."""
    exact = path_of(strata, words, "a_buffer")
    return {algorithm: flicker_of(path_of(strata, words, algorithm), exact) for algorithm in algorithms}
