"""The plots of the page."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import plots  # noqa: E402


def lines_plot(title, x_label, y_label, series, log_x=False):
    """`series`: {name: [(x, y), ...]}. Returns the text of the SVG."""
    figure, (axes,) = plots.axes_of(7, 4, title, x_label, y_label)
    plots.draw_series(axes, series)
    axes.set_ylim(bottom=0)
    if log_x:
        axes.set_xscale("log")
    return plots.svg_of(figure)


def zero_and_powers_plot(title, x_label, y_label, series, shaded=None):
    """Both axes are logarithmic above 1 and reach 0; `shaded`: (x0, x1), an interval of x to mark."""
    figure, (axes,) = plots.axes_of(7, 4, title, x_label, y_label)
    plots.draw_series(axes, series)
    xs = sorted({x for points in series.values() for x, _ in points} | set(shaded or ()))
    axes.set_xscale("symlog", linthresh=1)
    axes.set_yscale("symlog", linthresh=1)
    axes.set_xlim(min(xs), max(xs))
    axes.set_ylim(bottom=0)
    axes.set_xticks(xs, [f"{x:g}" for x in xs])
    if shaded:
        axes.axvspan(*shaded, color="#cfe8cf", zorder=0)
    return plots.svg_of(figure)
