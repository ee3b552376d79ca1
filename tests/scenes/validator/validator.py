#!/usr/bin/env python3
"""What the Khronos glTF validator says of malformed files, and what `strata scene` says: side by side.

    tests/scenes/validator/validator.py build/release/strata [--count 600] [--seed 1] [--table FILE]

Both get each file: changes of one step to two sound files, damaged containers, and the files of tests/fuzz/corpus/gltf.tar.xz. A kind of difference
is who refuses and by which code; each kind must stand in tests/scenes/validator/README.md with its reason, and a kind that
does not is exit status 1, as is a run of ours that ends in anything but 0 or 2. The validator is the package gltf-validator of npm, put into a
temporary folder, or the folder that STRATA_GLTF_VALIDATOR names; without node or the package exit status 77.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from models import malformed  # noqa: E402
from targeted import targeted  # noqa: E402

VERSION = "2.0.0-dev.3.10"


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(77)


def package(folder):
    given = os.environ.get("STRATA_GLTF_VALIDATOR")
    if given:
        return given
    if not shutil.which("node") or not shutil.which("npm"):
        skip("node or npm is missing")
    ended = subprocess.run(["npm", "install", "--silent", "--prefix", folder, f"gltf-validator@{VERSION}"], capture_output=True, text=True)
    if ended.returncode != 0:
        skip(f"npm cannot install gltf-validator: {ended.stderr.strip()[-200:]}")
    return f"{folder}/node_modules/gltf-validator"


def theirs(module, files):
    ended = subprocess.run(["node", str(HERE / "validate.js"), module], input="\n".join(map(str, files)), capture_output=True, text=True)
    if ended.returncode != 0:
        sys.exit(f"validator.py: node: {ended.stderr[-500:]}")
    return [json.loads(line) for line in ended.stdout.splitlines()]


def ours(strata, file):
    """Exit status, and the first code that the sentences name; a refusal without a code is our limit or our subset."""
    ended = subprocess.run([strata, "scene", str(file)], capture_output=True, text=True, errors="replace", timeout=60)
    code = re.search(r"\[([A-Z0-9_]+)\]", ended.stderr)
    return ended.returncode, code.group(1) if code else "" if ended.returncode == 0 else "without a code", ended.stderr.strip()


def kept_inputs():
    """Name and bytes of each glTF file that fuzzing has kept."""
    with tarfile.open(HERE.parent.parent / "fuzz/corpus/gltf.tar.xz") as archive:
        return [(pathlib.PurePath(member.name).name, archive.extractfile(member).read()) for member in archive if member.isfile()]


def reasons():
    """(who refuses, code) of the page's table."""
    rows = re.findall(r"^\| (they|we) \| `?([A-Za-z0-9_ ]+?)`? \|", (HERE / "README.md").read_text(), re.M)
    return set(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("strata")
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table", help="every file with both verdicts, a line each")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        module = package(folder)
        files = []
        for number, (name, data) in enumerate(malformed(asked.count, asked.seed, targeted())):
            place = pathlib.Path(folder) / f"{number:04}.{pathlib.PurePath(name).suffix[1:]}"
            place.write_bytes(data)
            files.append((name, place))
        for name, data in kept_inputs():
            place = pathlib.Path(folder) / f"{name}.{'glb' if data.startswith(b'glTF') else 'gltf'}"
            place.write_bytes(data)
            files.append((f"corpus/{name}", place))
        (pathlib.Path(folder) / "empty.bin").write_bytes(b"")
        verdicts = theirs(module, [place for _, place in files])
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            own = list(pool.map(lambda file: ours(asked.strata, file[1]), files))

    kinds, agreed, crashed, same_code, lines, codes = collections.Counter(), collections.Counter(), [], 0, [], collections.Counter()
    for (name, _), their, (status, code, told) in zip(files, verdicts, own):
        lines.append(f"{name}\tthey: {' '.join(their['errors']) or 'sound'}\twe: {status} {told.splitlines()[0] if told else 'sound'}")
        codes.update(their["errors"])
        if status not in (0, 2):
            crashed.append(lines[-1])
        elif bool(their["errors"]) == (status == 2):
            agreed["refused" if status == 2 else "sound"] += 1
            same_code += status == 2 and code in their["errors"]
        elif status == 2:
            kinds["we", code] += 1
        else:
            # One kind: the whole of what they refuse it for. Each code of it needs its reason.
            kinds.update(("they", one) for one in their["errors"])
    if asked.table:
        pathlib.Path(asked.table).write_text("\n".join(lines) + "\n")
    print(f"{len(files)} files: {agreed['refused']} refused by both ({same_code} with the same code), {agreed['sound']} sound to both, "
          f"{len(files) - sum(agreed.values()) - len(crashed)} differ, {len(crashed)} end otherwise")
    print(f"{len(codes)} of the validator's error codes: {' '.join(sorted(codes))}")
    known = reasons()
    for (who, code), count in sorted(kinds.items()):
        print(f"{who} alone refuse {count} of them: {code}{'' if (who, code) in known else ' -- not in the page'}")
    for line in crashed:
        print(line)
    sys.exit(1 if crashed or set(kinds) - known else 0)


if __name__ == "__main__":
    main()
