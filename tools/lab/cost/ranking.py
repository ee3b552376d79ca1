"""The plot of a ranking: a line of text and its marks for each choice, best at the top, so that every point has its name."""
import pathlib
import sys

from rows import frontier_of, name_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import plots  # noqa: E402

LINE = 0.17  # inches


def ranking_plot(rows, title, time_of, time_label):
    """`rows` are ranked; time_of gives a row's time or None. The choices that no other beats in error and time have filled
    marks and bold names."""
    timed = [i for i, row in enumerate(rows) if time_of(row) is not None]
    best = {timed[i] for i in frontier_of([(time_of(rows[i]), rows[i]["rmse"]) for i in timed])}
    figure, (errors, times) = plots.axes_of(9, 1.5 + LINE * len(rows), title, "RMSE, in 1/255", "", columns=2)
    places = range(len(rows))
    errors.scatter([row["sorted_rmse"] for row in rows], places, marker="o", s=16, color=plots.COLORS[1], label="from the sorted picture")
    errors.scatter([row["rmse"] for row in rows], places, marker="|", s=40, color=plots.COLORS[0], label="from the exact picture")
    errors.set_xscale("symlog", linthresh=0.1)
    errors.set_xlim(left=0)
    errors.set_yticks(places, [name_of(row) for row in rows])
    for i, label in enumerate(errors.get_yticklabels()):
        label.set_fontweight("bold" if i in best else "normal")
    errors.set_ylim(len(rows) - 0.3, -0.7)
    for filled, label in ((True, "no choice has less error in less time"), (False, "another has")):
        shown = [i for i in timed if (i in best) == filled]
        times.scatter([time_of(rows[i]) for i in shown], shown, marker="s", s=16, color=plots.COLORS[2], facecolor=plots.COLORS[2] if filled else "none",
                      label=label)
    times.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False)
    times.set_xscale("log")
    for axes in (errors, times):
        axes.xaxis.set_major_formatter("{x:g}")
    times.set_xlabel(time_label)
    errors.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False)
    return plots.svg_of(figure)
