"""The section of the page on the chip's depth formats, from the sweep of formats.json."""
import figures
import sections
from sections import groups, measured, total

SHOWN = [("window_z", "d16"), ("window_z", "d16f"), ("window_z", "d24"), ("window_z", "d24f"),
         ("w_buffer", "d16"), ("w_buffer", "d16f"), ("w_buffer", "d24"), ("w_buffer", "d24f")]


def ratio(row):
    """far / near as in the plan: the planes are rounded, so that their quotient differs slightly."""
    return float(f"{sections.ratio(row):.4g}")


def name_of(kind):
    return f"{kind[0]} {kind[1]}"


def merged(row):
    """Fragments that are not layers of their own: another fragment of their pixel has their code, or it is the code of the cleared buffer."""
    return row["fragments"] - row["layers"]


def kept_apart(rows):
    """{(scene, far/near): {(path, format): row}} of peels that store and compare one path."""
    table = {}
    for row in rows:
        if row["write_path"] == row["compare_path"]:
            table.setdefault((row["scene"], ratio(row)), {})[(row["write_path"], row["depth_format"])] = row
    return table


def reaches(table):
    """A sentence per scene: up to which far/near each format distinguishes layers."""
    said = []
    for scene in dict.fromkeys(scene for scene, _ in table):
        ranges = sorted(far for s, far in table if s == scene)
        parts = []
        for kind in SHOWN:
            reach = None
            for far in ranges:
                kinds = table[scene, far]
                if 1000 * merged(kinds[kind]) > kinds[kind]["fragments"]:
                    break
                reach = far
            parts.append(f"`{name_of(kind)}` " + ("never" if reach is None else f"{reach:.4g}"))
        said.append(f"{scene}: " + ", ".join(parts) + ".")
    return said


def merging(rows):
    table = kept_apart(rows)
    lines = [[scene, f"{far:.4g}", f"{max(r['fragments'] for r in kinds.values()):,}",
              *(f"{merged(kinds[k]):,}" if k in kinds else "-" for k in SHOWN)] for (scene, far), kinds in table.items()]
    blocks = [("text", "Peels by `depth_units` that store and compare one path: no layer comes twice, but fragments of one pixel whose depths get one "
                       "code are one layer, and one whose code is that of the cleared buffer is none. The table counts the fragments that vanish so, "
                       "of all fragments of the frame. The float formats spend their finest steps on what lies nearest, where z of a wide range hardly is: "
                       "16 bits of w distinguish layers that 24 bits of z merge. The ratio moves only the near plane, on which w does not depend."),
              ("text", "Greatest far/near of those tried up to which a format loses at most one fragment in a thousand:"),
              ("list", reaches(table)),
              ("table", ["scene", "far/near", "fragments", *(f"`{name_of(k)}`" for k in SHOWN)], lines)]
    for scene in dict.fromkeys(scene for scene, _ in table):
        series = {}
        for far, kinds in ((far, kinds) for (s, far), kinds in table.items() if s == scene):
            for kind, row in kinds.items():
                name = name_of(kind) if kind[0] == "window_z" else "w_buffer, the worst format"
                points = series.setdefault(name, {})
                points[far] = max(points.get(far, 0), 100 * merged(row) / row["fragments"])
        file = "".join(c if c.isalnum() else "-" for c in scene)
        blocks.append(("plot", f"formats-{file}", f"{scene}: fragments that are no layer of their own, by depth format",
                       figures.lines_plot(scene, "far / near", "fragments merged, %", {name: sorted(points.items()) for name, points in series.items()}, log_x=True)))
    return blocks


def least_bias(own):
    """The smallest tested bias that peels without error."""
    right = [r for r in own if r["outcome"] == "done" and total(r) == 0]
    if not right:
        return "none"
    return f"{min(r['bias_constant'] for r in right):g}"


def biases(rows):
    rows = [r for r in rows if r["write_path"] != r["compare_path"]]
    lines = []
    for (scene, depth), own in groups(rows, "scene", "depth_format"):
        cells = []
        for far in sorted({ratio(r) for r in own}):
            tried = [r for r in own if ratio(r) == far]
            plain = next(r for r in tried if r["remedy"] == "none")
            cells.append("nothing left" if plain["layers"] == 0 else f"{total(plain):,} of {plain['layers']:,}; {least_bias(tried)}")
        lines.append([scene, f"`{depth}`", *cells])
    ratios = sorted({ratio(r) for r in rows})
    return [("text", "Shadow maps by `window_z` written and `perspective_rq` compared: layers twice or lost without a remedy, of all that the format has; then the least "
                     "of the biases that `formats.json` tries which peels without error (none: each loses or repeats a layer), in units of polygon "
                     "offset, which the chip takes in the buffer's own units: codes of `d16` and "
                     "`d24`, parts of 511.9375 of `d16f`, parts of 1e30 of `d24f`. A bias of 0 means that none is needed. "
                     "A w buffer is compared with w alone, and needs none."),
            ("table", ["scene", "depth", *(f"far/near {r:.4g}" for r in ratios)], lines)]


def section(rows):
    """Blocks for the page, or none without rows."""
    rows = measured(rows)
    return [("heading", "The chip's depth formats, z and w"), *merging(rows), *biases(rows)] if rows else []


def short_section(rows):
    """Blocks for the short page: up to which far/near each format distinguishes the layers of the first scene."""
    rows = measured(rows)
    return [("text", "Depth formats, stored and compared along one path: the greatest far/near of those tried at which a format merges at most one fragment in a "
                     "thousand with another layer. 16 bits of w distinguish more layers than 24 bits of z."),
            ("list", reaches(kept_apart(rows))[:1])] if rows else []
