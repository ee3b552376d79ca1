"""The sections of the page, from the rows of a sweep. Each function returns blocks, or none if it has no rows."""
import math

import figures

WHAT = ("scene", "profile", "algorithm", "write_path", "compare_path", "depth_format")


MOST_PICTURES = 24  # cells, in the order of the plan
MOST_SAFE = 8  # safe intervals in the head; the others are in the list below

# Options that most sweeps do not vary: rows and labels name those that vary in the whole page.
OTHER_KNOBS = [("size", lambda row: f"{row['width']}x{row['height']}"),
               ("orbit", lambda row: "-" if row["orbit"] is None else f"{row['orbit'][0]:g},{row['orbit'][1]:g}"),
               ("camera", lambda row: row.get("camera") or "-"),
               ("alpha", lambda row: f"{row['alpha']:g}"),
               ("subpixel bits", lambda row: str(row["subpixel_bits"])),
               ("max passes", lambda row: str(row["max_passes"]))]


def name_other_knobs(rows):
    """Gives each row `also`: (title, value) of every one of OTHER_KNOBS that differs between rows."""
    varying = [(title, value) for title, value in OTHER_KNOBS if len({value(row) for row in rows}) > 1]
    for row in rows:
        row["also"] = tuple((title, value(row)) for title, value in varying)


def also_titles(rows):
    return [title for title, _ in rows[0]["also"]] if rows else []


def also_values(row):
    return [value for _, value in row["also"]]


def also_text(row):
    return "".join(f", {title} {value}" for title, value in row["also"])


def pair(row):
    return f"{row['write_path']} : {row['compare_path']}"


def share(row):
    return row["differing"] / row["fragments"] if row["fragments"] else 0.0


def percent(value):
    return f"{100 * value:.1f} %" if value == 0 or value >= 0.001 else f"{100 * value:.2g} %"


def decibels(row):
    return "-" if row["psnr"] is None else f"{row['psnr']:.1f}"


def ratio(row):
    """far / near; nan for the scene's own view, whose planes are not known."""
    return row["far"] / row["near"] if row["near"] else math.nan


def planes(row):
    return f"far/near {ratio(row):.4g}" if row["near"] else "the scene's own view"


def groups(rows, *keys):
    """[(values of the keys, rows)] in order of first appearance."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[key] for key in keys), []).append(row)
    return list(found.items())


def measured(rows):
    return [row for row in rows if row["outcome"] != "refused"]


def plain(rows):
    """Rows that compare the unchanged paths: no remedy, one way of drawing, the profile's own hypothesis. Each once."""
    found = {}
    for r in alike(rows):
        if r["remedy"] == "none":
            found.setdefault((r["scene"], r["profile"], pair(r), r["depth_format"], r["near"], r["far"], r["also"]), r)
    return list(found.values())


def alike(rows):
    """Rows whose passes draw the same vertices, with the profile's own hypothesis."""
    return [r for r in measured(rows) if r["split"] == "none" and "+" not in r["vertex_path"] and r["hypothesis"] == "profile"]


def spread(rows):
    """The least and the greatest fraction that differs, and the largest difference, of one depth format."""
    shares = [share(r) for r in rows]
    return f"{percent(min(shares))} to {percent(max(shares))} of the fragments of `{rows[0]['depth_format']}` differ, by {max(r['ulp_max'] for r in rows):,} ulp at most"


def findings(rows, most_named=MOST_SAFE):
    """The three main results, computed from the rows; none if a kind of row is missing."""
    unlike = [r for r in alike(rows) if r["remedy"] == "none" and r["write_path"] not in ("depth_replace", r["compare_path"]) and r["differing"] > 0]
    replaced = [r for r in alike(rows) if "depth_replace" in (r["write_path"], r["remedy"])]
    judged = biases(rows)
    if not (unlike and replaced and judged):
        return []
    wrong, endless = sum(total(r) > 0 for r in unlike), sum(r["outcome"] == "never_ends" for r in unlike)
    by_format = "; ".join(spread(own) for _, own in groups(unlike, "depth_format"))
    safe = [r for r in judged if r["safe_bias"]["safe"]]
    named = "; ".join(f"{about(r)}: {codes(r['safe_bias'])}" for r in safe[:most_named]) + ("; ..." if len(safe) > most_named else "")
    return [("text", f"Of {len(unlike)} peels that compare another depth than they store, {wrong} lose layers or composite them twice, and {endless} never "
                     f"end: {by_format}."),
            ("text", f"If the written depth comes from the quotient that is compared (`depth_replace`), {sum(total(r) > 0 for r in replaced)} of {len(replaced)} peels "
                     "make such errors."),
            ("text", f"A constant bias peels {len(safe)} of {len(judged)} {'choice' if len(judged) == 1 else 'choices'} of scene, format and depth range without error"
                     + (f" ({named})" if safe else "") + ("." if len(safe) == len(judged) else "; for the others none is safe."))]


def biases(rows):
    """A row of each scene, profile, format and depth range that needs a bias."""
    return [r for r in plain(rows) if r["safe_bias"] and total(r) > 0]


def about(row):
    return f"{row['scene']} on {row['profile']}, `{row['depth_format']}`, {planes(row)}{also_text(row)}"


def codes(safe):
    """A safe interval in words; an end that is None is open."""
    if safe["lowest"] is None and safe["highest"] is None:
        return "any number of codes"
    if safe["highest"] is None:
        return f"{safe['lowest']} codes and more"
    return f"up to {safe['highest']} codes" if safe["lowest"] is None else f"{safe['lowest']} to {safe['highest']} codes"


def answers(rows):
    """The results of the page in one line each, computed from the rows."""
    said = []
    for (profile, write, compare, depth), own in groups(plain(rows), "profile", "write_path", "compare_path", "depth_format"):
        fragments, differing = sum(r["fragments"] for r in own), sum(r["differing"] for r in own)
        name = f"{profile}, `{write}` written and `{compare}` compared, `{depth}`"
        if write == compare:
            continue
        if differing == 0:
            said.append(f"{name}: 0 of {fragments:,} fragments differ, whatever the depth range.")
        else:
            low, high = min(own, key=share), max(own, key=share)
            ends = [percent(share(r)) + (f" ({planes(r)})" if planes(low) != planes(high) else "") for r in (low, high)]
            said.append(f"{name}: {' to '.join(dict.fromkeys(ends))} differ, by {max(r['ulp_max'] for r in own):,} ulp at most.")
    for r in biases(rows):
        if r["safe_bias"]["safe"]:
            said.append(f"{about(r)}: a constant bias of {codes(r['safe_bias'])} peels without error.")
        else:
            said.append(f"{about(r)}: no constant bias peels without error.")
    return [("heading", "In short"), ("list", said)] if said else []


def differences(rows):
    rows = [r for r in plain(rows) if r["differing"] > 0]
    if not rows:
        return []
    header = ["scene", "profile", "writes : compares", "depth", "far/near", *also_titles(rows), "fragments", "differ", "largest, ulp", "at pixel"]
    table = []
    for r in rows:
        place = "-" if r["ulp_max_at"] is None else f"{r['ulp_max_at']['x']},{r['ulp_max_at']['y']}"
        table.append([r["scene"], r["profile"], pair(r), r["depth_format"], f"{ratio(r):.4g}" if r["near"] else "own", *also_values(r), f"{r['fragments']:,}",
                      percent(share(r)), f"{r['ulp_max']:,}", place])
    blocks = [("heading", "How often the two depths differ, and by how much"),
              ("text", "Every fragment of the frame by both paths, paired by pixel and triangle. An ulp is a code of `d16` and "
                       "`d24`, and the step to the next float of `d32f`. Pairs that never differ are omitted.")]
    return blocks + difference_plots(rows)[1:] + [("table", header, table)]  # the first one stands at the head


def difference_plots(rows):
    blocks = []
    for (scene, profile), own in groups(rows, "scene", "profile"):
        if len({ratio(r) for r in own}) < 2:
            continue
        by_pair = {}
        for r in own:
            by_pair.setdefault(f"{pair(r)} {r['depth_format']}{also_text(r)}", []).append(r)
        name = "".join(c if c.isalnum() else "-" for c in f"{scene}-{profile}")
        shares = {key: sorted((ratio(r), 100 * share(r)) for r in values) for key, values in by_pair.items()}
        blocks.append(("plot", f"share-{name}", f"{scene} on {profile}: share of fragments whose two depths differ",
                       figures.lines_plot(f"{scene}, {profile}", "far / near", "fragments that differ, %", shares, log_x=True)))
        largest = {key: sorted((ratio(r), r["ulp_max"]) for r in values) for key, values in by_pair.items()}
        blocks.append(("plot", f"ulp-{name}", f"{scene} on {profile}: the largest difference",
                       figures.lines_plot(f"{scene}, {profile}", "far / near", "largest difference, ulp", largest, log_x=True)))
    return blocks


def histogram(rows):
    rows = [r for r in plain(rows) if r["differing"] > 0]
    if not rows:
        return []
    table = []
    for (scene, profile, write, compare, depth, also), own in groups(rows, "scene", "profile", "write_path", "compare_path", "depth_format", "also"):
        bins = {}
        for r in own[:1]:
            for low, high, count in r["histogram"]:
                name = "0" if low == high == 0 else "-1" if high == -1 else "+1" if low == 1 else "<= -2" if high < 0 else ">= +2"
                bins[name] = bins.get(name, 0) + count / r["fragments"]
        table.append([scene, profile, f"{write} : {compare}", depth, *(value for _, value in also), *(percent(bins.get(k, 0)) for k in ("<= -2", "-1", "0", "+1", ">= +2"))])
    return [("text", "Signed: positive where the compared depth lies behind the stored one, so that a fragment survives its own peel. "
                     "The first depth range of each row above."),
            ("table", ["scene", "profile", "writes : compares", "depth", *also_titles(rows), "<= -2", "-1", "0", "+1", ">= +2"], table)]


def total(row):
    return row["duplicated"] + row["lost"]


def remedies(rows):
    blocks = []
    for key, own in groups(alike(rows), *WHAT[:3], "compare_path", "depth_format", "near", "far", "also"):
        if len(own) < 3:
            continue
        scene, profile, algorithm, _, depth = key[:5]
        base = next((r for r in own if r["remedy"] == "none"), own[0])
        best = min(own, key=lambda r: (total(r), r["rmse"]))
        table = []
        for r in own:
            time = f"{r['seconds'] / base['seconds']:.2f}" if base["seconds"] else "-"
            mark = " (least)" if total(r) == total(best) else ""
            table.append([f"`{r['remedy']}`", pair(r), f"{r['passes']}" + (" of its limit" if r["outcome"] == "never_ends" else ""),
                          f"{r['layers_true']}", f"{r['duplicated']:,}", f"{r['lost']:,}", f"{total(r):,}{mark}",
                          f"{r['pixels_touched']:,}", f"{r['max_difference']:.1f}", f"{r['rmse']:.2f}", decibels(r), time])
        blocks += [("text", f"{scene}, {algorithm} on {profile}, `{depth}`, {planes(own[0])}{also_text(own[0])}, {own[0]['layers']:,} layers in all. "
                            f"Least total error: `{best['remedy']}` ({pair(best)}), {total(best):,}.")]
        blocks += bias_plot(key, own)
        blocks.append(("table", ["remedy", "writes : compares", "passes", "N", "twice", "lost", "total", "pixels", "max diff", "rmse", "PSNR", "time"], table))
        blocks += advice(own)
    if not blocks:
        return []
    return [("heading", "What it does to a peel, and what each remedy costs"),
            ("text", "A layer counts as twice if a pixel composited it more than once, as lost if never. N is the deepest pixel's number of layers; a right "
                     "peel takes N + 1 passes, and one that still finds fragments after 2 (N + 1) never ends. Differences are against "
                     "the exact A-buffer in 1/255 (where no layer is twice or lost they are ties: fragments of equal depth are one layer to any peel); time is "
                     "the passes' of the emulator, every pass rasterized again, as a ratio to the first line's in the same run.")] + blocks


def bias_plot(key, own):
    constant = {r["bias_constant"]: r for r in own if r["remedy"] == "none" or r["remedy"] == f"bias:{r['bias_constant']:g}"}
    if len(constant) < 3:
        return []
    scene, profile, _, _, depth = key[:5]
    series = {"twice": [], "lost": [], "total": []}
    for bias in sorted(constant):
        for name, value in (("twice", constant[bias]["duplicated"]), ("lost", constant[bias]["lost"]), ("total", total(constant[bias]))):
            series[name].append((bias, value))
    safe = own[0]["safe_bias"]
    shaded = None
    if safe and safe["safe"] and safe["highest"] is not None and safe["highest"] > max(safe["lowest"] or 0, 0):
        shaded = (max(safe["lowest"] or 0, 0), safe["highest"])
    label = f"{scene}, {profile}, {depth}, {planes(own[0])}{also_text(own[0])}"
    name = "".join(c if c.isalnum() else "-" for c in f"{scene}-{profile}-{depth}-{ratio(own[0]):.4g}" + "".join(f"-{value}" for value in also_values(own[0])))
    caption = f"{label}: layers composited twice, and lost, against a constant bias" + (f"; green: safe, {codes(safe)}" if shaded else "")
    return [("plot", f"bias-{name}", caption, figures.zero_and_powers_plot(label, "polygon offset units", "layers", series, shaded))]


def place(witness):
    return f"pixel {witness['x']},{witness['y']}, triangle {witness['primitive']} (stored {witness['stored']}, compared {witness['reference']})"


def interval(name, range_):
    if range_ is None or range_["lowest"] is None:
        return ""
    highest = "without end" if range_["highest"] is None else f"to {range_['highest']}"
    if range_["safe"]:
        return f"Safe {name}: {range_['lowest']} {highest}. "
    return (f"No {name} is safe: below {range_['lowest']} the fragment at {place(range_['repeated_below'])} is peeled twice, above "
            f"{range_['highest']} the one at {place(range_['lost_above'])} is lost. ")


def advice(own):
    text = interval("epsilon in ulps", own[0]["safe_epsilon_ulps"]) + interval("constant bias in codes", own[0]["safe_bias"])
    return [("text", "The adviser, from the exact fragments: " + text.strip())] if text else []


def vertex_paths(rows):
    rows = [r for r in measured(rows) if "+" in r["vertex_path"]]
    if not rows:
        return []
    table = [[r["scene"], r["profile"], pair(r), r["depth_format"], planes(r), *also_values(r), *r["vertex_path"].split("+"), percent(share(r)), f"{r['ulp_max']:,}", f"{r['unmatched']:,}",
              str(r["passes"]), str(r["layers_true"]), f"{r['duplicated']:,}", f"{r['lost']:,}"] for r in rows]
    return [("heading", "Passes that transform a vertex differently"),
            ("text", "One depth path, but the first pass computes positions differently from all others: the most frequent mistake of a port. "
                     "Where a vertex snaps to another grid point, coverage differs too."),
            ("table", ["scene", "profile", "writes : compares", "depth", "planes", *also_titles(rows), "first pass", "further", "differ", "largest, ulp", "only in one", "passes", "N", "twice", "lost"], table)]


def splits(rows):
    rows = [r for r in measured(rows) if r["split"] != "none"]
    if not rows:
        return []
    table = []
    for r in rows:
        behind = sum(count for low, _, count in r["histogram"] if low > 0)
        path = r["write_path"] + ("" if r["hypothesis"] == "profile" else f", {r['hypothesis']}")
        table.append([r["scene"], r["profile"], path, r["depth_format"], planes(r), *also_values(r), r["split"], f"{r['fragments']:,}", percent(share(r)),
                      percent(behind / r["fragments"] if r["fragments"] else 0), f"{r['ulp_max']:,}", f"{r['unmatched']:,}"])
    return [("heading", "The same surface, split differently"),
            ("text", "A decal in the plane of a surface flickers wherever its depth differs from the surface's. Here the second pass draws the same surface, but its triangles "
                     "begin at another vertex, its squares are divided along the other diagonal, the viewport is moved by a pixel, or the near "
                     "plane clamps instead of clipping. `hidden` is the share where the decal lies behind, and LEQUAL drops it. Even the exact plane "
                     "changes with the diagonal: corners are snapped to subpixels and their depths rounded, so four corners lie in no plane."),
            ("table", ["scene", "profile", "path", "depth", "planes", *also_titles(rows), "split", "fragments", "differ", "hidden", "largest, ulp", "only in one"], table)]


def hypotheses(rows):
    rows = [r for r in measured(rows) if r["hypothesis"] != "profile" and r["split"] == "none"]
    if not rows:
        return []
    table = [[r["hypothesis"], r["scene"], r["profile"], pair(r), r["depth_format"], planes(r), *also_values(r), percent(share(r)), f"{r['ulp_max']:,}", f"{r['duplicated']:,}", f"{r['lost']:,}"]
             for r in rows]
    return [("heading", "Assumptions about the chip"),
            ("text", "Each line changes one constant of the device that no capture determines; the spread is the uncertainty of the figures above."),
            ("table", ["hypothesis", "scene", "profile", "writes : compares", "depth", "planes", *also_titles(rows), "differ", "largest, ulp", "twice", "lost"], table)]


def refusals(rows):
    told = {row["refusal"] for row in rows if row["outcome"] == "refused"}
    return [("heading", "Refused"), ("text", "; ".join(sorted(told)) + ".")] if told else []


def pictures(rows):
    blocks = []
    for row in [r for r in plain(rows) if total(r) > 0][:MOST_PICTURES]:
        for ending, caption in (("errors", "red: twice, blue: lost, magenta: both"), ("difference", "4 x the difference from the exact A-buffer")):
            path = row["pictures"].with_name(f"{row['pictures'].name}.{ending}.png")
            if path.exists():
                blocks.append(("picture", path, f"{about(row)}, {pair(row)}, {row['remedy']}: {caption}"))
    return [("heading", "Where")] + blocks if blocks else []


def page(title, rows, study=()):
    """`study`: blocks of a further section, before the hypotheses."""
    name_other_knobs(rows)
    intro = (f"{len(rows)} cells of `strata invariance`. A peel in several passes compares a fragment's depth with one that an earlier pass stored. If the two are "
             "computed differently, they differ in their last bits: a fragment that seems to lie behind itself is peeled again, and "
             "one that seems too near is lost. Unless a line names others, all figures hold for the profiles' own "
             "constants, which `strata list profiles` shows with their sources.")
    plots = difference_plots([r for r in plain(rows) if r["differing"] > 0])
    return [("title", title), *findings(rows), *plots[:1], ("text", intro), *answers(rows), *differences(rows), *histogram(rows), *remedies(rows),
            *vertex_paths(rows), *splits(rows), *study, *hypotheses(rows), *refusals(rows), *pictures(rows)]


MOST_ROWS = 13  # of the short page's table
KINDS = {"none": "nothing", "bias": "a constant bias", "slope": "a bias by slope", "epsilon": "an epsilon in the comparison", "unquantized": "an unrounded comparison",
         "depth_replace": "`depth_replace`"}


def kind_of(row):
    """The key of KINDS; a bias with a constant and a slope counts as one by slope."""
    if "depth_replace" in (row["write_path"], row["remedy"]):
        return "depth_replace"
    return "slope" if "slope" in row["remedy"] else row["remedy"].split(":")[0]


def remedy_rows(rows):
    """For each kind of remedy: the number of tests on peels that need one, and the number in which every layer occurs once."""
    keys = ("scene", "profile", "algorithm", "compare_path", "depth_format", "near", "far", "also")
    tried = {kind: [] for kind in KINDS}
    for _, own in groups(alike(rows), *keys):
        if any(r["remedy"] == "none" and total(r) > 0 for r in own):
            for r in own:
                tried[kind_of(r)].append(r)
    return [[KINDS[kind], str(len(own)), str(sum(total(r) == 0 for r in own))] for kind, own in tried.items() if own]


def pair_rows(rows):
    """A row of each pair of paths at one depth format: the shares over all depth ranges. Formats in which nothing differs share a row."""
    table = {}
    for (profile, write, compare, depth), own in groups(plain(rows), "profile", "write_path", "compare_path", "depth_format"):
        if write != compare:
            low, high = (percent(find(map(share, own))) for find in (min, max))
            figures = low if low == high else f"{low} to {high}", f"{max(r['ulp_max'] for r in own):,}"
            differs = any(r["differing"] for r in own)
            table.setdefault((profile, f"`{write}`", f"`{compare}`", depth if differs else "", *figures), []).append(depth)
    return [[profile, write, compare, ", ".join(depths), *figures] for (profile, write, compare, _, *figures), depths in table.items()][:MOST_ROWS]


def short_page(title, rows, study):
    """The page in the repository: at most 600 words. `study`: rows of the sweep of depth formats, may be empty."""
    name_other_knobs(rows)
    blocks = [("title", title),
              ("text", "A peel compares a fragment's depth with one that an earlier pass stored. If the two are computed differently, they differ in their last bits: a "
                       "fragment seemingly behind itself is peeled twice, one seemingly too near is lost. How often does that happen, and what prevents "
                       f"it? `strata invariance` emulates {' and '.join(dict.fromkeys(r['profile'] for r in rows))} on a CPU."),
              *findings(rows, 1), *difference_plots([r for r in plain(rows) if r["differing"] > 0])[:1],
              ("text", "Fragments whose two depths differ, for all depth ranges; ulp are codes of d16 and d24, and steps between floats of d32f."),
              ("table", ["profile", "stored", "compared", "depth", "differ", "largest, ulp"], pair_rows(rows)),
              ("text", "Peels that lose or repeat layers without a remedy, and how many of them each remedy corrects:"),
              ("table", ["remedy", "peels", "without error"], remedy_rows(rows))]
    return blocks + study
