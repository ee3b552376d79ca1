"""Plots as SVG by gnuplot (Debian package gnuplot-nox), independent of time and host."""
import shutil
import subprocess
import sys

HEAD = """set terminal svg size 760,420 font "sans-serif,13" background "white" linewidth 1.2
set encoding utf8
set border 3
set tics nomirror
set grid ytics lc rgb "#dddddd"
set key below Left reverse
"""
ZERO = 0.5  # the position of zero on a logarithmic axis: all other counts are at least 1
# Distinct in hue and in lightness.
COLORS = ["#0b3c8c", "#d95f02", "#1b9e77", "#7b3294", "#666666", "#e7298a", "#66a61e", "#a6761d"]


def quoted(text):
    return '"' + str(text).replace("\\", "\\\\").replace('"', '\\"').replace("_", "\\\\_") + '"'


def run_gnuplot(script):
    if shutil.which("gnuplot") is None:
        sys.exit("report.py: expected gnuplot (apt-get install gnuplot-nox), found none")
    done = subprocess.run(["gnuplot"], input=script, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"report.py: gnuplot failed: {done.stderr.strip()}")
    return done.stdout


def lines_plot(title, x_label, y_label, series, log_x=False):
    """`series`: {name: [(x, y), ...]}. Returns the SVG's text."""
    script = [HEAD, f"set title {quoted(title)}", f"set xlabel {quoted(x_label)}", f"set ylabel {quoted(y_label)}", "set yrange [0:*]"]
    if log_x:
        script += ["set logscale x", 'set format x "10^{%L}"']
    return run_gnuplot("\n".join(script + drawn(series)) + "\n")


def zero_and_powers_plot(title, x_label, y_label, series, shaded=None):
    """Both axes are logarithmic, with a position for zeros; `shaded`: (x0, x1), an interval of x to mark."""
    xs = sorted({x for points in series.values() for x, _ in points})
    ends = [shaded[1]] if shaded else []
    script = [HEAD, f"set title {quoted(title)}", f"set xlabel {quoted(x_label)}", f"set ylabel {quoted(y_label)}", "set logscale xy",
              f"set xrange [{ZERO}:{max(xs + ends)}]", f"set yrange [{ZERO}:*]", f'set ytics ("0" {ZERO}, "1" 1, "10" 10, "100" 100, "1000" 1000, "10^4" 1e4, "10^5" 1e5)']
    script.append("set xtics (" + ", ".join(f'"{x:g}" {max(x, ZERO)}' for x in sorted({*xs, *ends})) + ")")
    if shaded:
        script.append(f"set object 1 rectangle from {max(shaded[0], ZERO)}, graph 0 to {shaded[1]}, graph 1 behind fc rgb '#cfe8cf' fs noborder")
    above = {name: [(max(x, ZERO), max(y, ZERO)) for x, y in points] for name, points in series.items()}
    return run_gnuplot("\n".join(script + drawn(above)) + "\n")


def drawn(series):
    """The commands that draw {name: [(x, y), ...]}."""
    data, plots = [], []
    for number, (name, points) in enumerate(series.items()):
        data += [f"$data{number} << EOD", *(f"{x} {y}" for x, y in points), "EOD"]
        color = COLORS[number % len(COLORS)]
        plots.append(f"$data{number} using 1:2 with linespoints pt {4 + number} ps 0.7 lc rgb '{color}' title {quoted(name)}")
    return data + ["plot " + ", ".join(plots)]
