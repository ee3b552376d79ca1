"""The rows of `strata cost`, with their times."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import pages  # noqa: E402

COLUMNS = ("default", "literal")


def rows_of(folder):
    """The lines of results.jsonl, each with `default` and `literal`: its times as multiples of the default cell's, None for a row without time."""
    folder = pathlib.Path(folder)
    timings = {line["cell"]: line for line in pages.lines_in(folder / "timings.jsonl")}
    return [{**line, **{column: timings[line["cell"]][column] for column in COLUMNS}} for line in pages.lines_in(folder / "results.jsonl")]


def standard_of(rows):
    return next(row for row in rows if row["knob"] == "default")


def ranked(rows):
    """The rows with an error from the sorted picture, best first: by that error, by the error from the exact picture, by time."""
    drawn = [row for row in rows if row["sorted_rmse"] is not None]
    return sorted(drawn, key=lambda row: (row["sorted_rmse"], row["rmse"], row["default"]["median"] if row["default"] else 0))


def card_time(row, standard):
    """The card's time as a multiple of the default cell's; None if the card's rates do not apply."""
    if row["modelled_seconds"] is None or standard["modelled_seconds"] is None:
        return None
    return row["modelled_seconds"] / standard["modelled_seconds"]


def name_of(row):
    return row["value"] if row["knob"] in ("algorithm", "transparency") else f"{row['knob']} {row['value']}"


def frontier_of(points):
    """The numbers of the points (time, error) that no other point beats in both, cheapest first; of equal points the first."""
    frontier = []
    for i in sorted(range(len(points)), key=lambda i: points[i]):
        if not frontier or points[i][1] < points[frontier[-1]][1]:
            frontier.append(i)
    return frontier
