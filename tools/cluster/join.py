#!/usr/bin/env python3
"""Joins the shards of a sweep: join.py FOLDER SHARDS

FOLDER/NAME.KofN.jsonl (and .csv) with K from 1 to N = SHARDS become FOLDER/NAME.jsonl (and .csv), for each NAME that the first shard has. Shard K of N
has the rows K, K + N, ..., so the joined files have the bytes of a sweep in one shard. Exit status 2, and no file, if a shard is missing or too short.
"""
import pathlib
import sys


def fail(sentence):
    print(f"join.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def rows_of(path):
    """The head of a CSV file, or none, and the rows. A field with a line end is quoted, so that its row goes on until the quotes are even."""
    if not path.exists():
        fail(f"{path}: expected the rows of a shard, found no such file")
    rows = []
    for line in path.read_bytes().splitlines(keepends=True):
        if path.suffix == ".csv" and rows and rows[-1].count(b'"') % 2:
            rows[-1] += line
        else:
            rows.append(line)
    return rows[:path.suffix == ".csv"], rows[path.suffix == ".csv":]


def joined(folder, stem, ending, shards):
    parts = [rows_of(folder / f"{stem}.{k}of{shards}{ending}") for k in range(1, shards + 1)]
    total = sum(len(rows) for _, rows in parts)
    for k, (_, rows) in enumerate(parts, 1):
        expected = (total - k) // shards + 1
        if len(rows) != expected:
            fail(f"{folder / f'{stem}.{k}of{shards}{ending}'}: expected {expected} of {total} rows, found {len(rows)}")
    return b"".join(parts[0][0] + [parts[i % shards][1][i // shards] for i in range(total)])


def main():
    if len(sys.argv) != 3 or not sys.argv[2].isdigit() or int(sys.argv[2]) < 1:
        fail(f"expected FOLDER SHARDS, found {' '.join(sys.argv[1:]) or 'nothing'}")
    folder, shards = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    first = sorted(folder.glob(f"*.1of{shards}.*"))
    if not first:
        fail(f"{folder}: expected files NAME.1of{shards}.jsonl, found none")
    names = [path.name.split(f".1of{shards}") for path in first]
    texts = {stem + ending: joined(folder, stem, ending, shards) for stem, ending in names}
    for name, text in texts.items():
        part = folder / f".{name}.part"
        part.write_bytes(text)
        part.replace(folder / name)


if __name__ == "__main__":
    main()
