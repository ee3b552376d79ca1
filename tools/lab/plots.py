"""Plots as SVG by matplotlib (Debian package python3-matplotlib). The same data give the same bytes."""
import io
import sys

try:
    import matplotlib
except ImportError:
    sys.exit("plots.py: expected matplotlib (apt-get install python3-matplotlib), found none")
matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "strata", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 9, "axes.spines.top": False,
                            "axes.spines.right": False, "axes.grid": True, "grid.color": "#dddddd", "axes.axisbelow": True, "figure.facecolor": "white"})
from matplotlib.figure import Figure  # noqa: E402

# By Okabe and Ito: distinct with any colour vision.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9", "#f0e442"]
MARKS = "os^Dv<>P"


def svg_of(figure):
    """The text of the plot; the labels may take more room than the axes leave."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None}, bbox_inches="tight")
    return text.getvalue()


def axes_of(width, height, title, x_label, y_label, columns=1):
    """A figure in inches, and its axes."""
    figure = Figure(figsize=(width, height), layout="constrained")
    axes = figure.subplots(1, columns, sharey=columns > 1, squeeze=False)[0]
    figure.suptitle(title)
    axes[0].set_xlabel(x_label)
    axes[0].set_ylabel(y_label)
    return figure, axes


def draw_series(axes, series):
    """Lines with marks: {name: [(x, y), ...]}, and their legend below."""
    for number, (name, points) in enumerate(series.items()):
        axes.plot(*zip(*points), label=name, color=COLORS[number % len(COLORS)], marker=MARKS[number % len(MARKS)], markersize=4)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, frameon=False)
