"""What the tests of pages share: the path of a subject's scripts, and the report of their checks. The test is skipped without matplotlib."""
import pathlib
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(sys.argv[1]).resolve()
try:
    import matplotlib  # noqa: F401
except ImportError:
    print("SKIPPED: matplotlib is not installed (apt-get install python3-matplotlib)")
    sys.exit(77)


def subject(name):
    sys.path[:0] = [str(ROOT / "tools" / "lab" / name), str(ROOT / "tools" / "lab")]


def end(checks, least):
    """`checks` are pairs of a sentence and whether it holds; there are at least `least`."""
    checks = list(checks)
    wrong = [sentence for sentence, holds in checks if not holds]
    print("\n".join([*wrong, f"{len(checks)} checks, {len(wrong)} wrong"]))
    sys.exit(1 if wrong or len(checks) < least else 0)


def rows_of_table(page, heading=""):
    """The cells of the first table after a heading, without its rule."""
    lines = page[page.index(heading):].splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("|"))
    table = []
    for line in lines[first:]:
        if not line.startswith("|"):
            break
        table.append([cell.strip() for cell in line.strip("|").split("|")])
    return table[:1] + table[2:]


def overlaps(figure, texts):
    """Pairs of texts whose boxes overlap where they are drawn."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts if text.get_text() and text.get_visible()]
    return [(a, b) for i, (a, one) in enumerate(boxes) for b, other in boxes[i + 1:] if one.overlaps(other)]
