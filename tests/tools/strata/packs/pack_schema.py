#!/usr/bin/env python3
"""Reads packs as another program would, using only tools/oracle/pack/PACK.md and its schema.

usage: pack_schema.py STRATA SCHEMA

Expected values come from the JSON Schema, IEEE 754 by Python's struct, sums of bytes, and shapes. Each manifest must match the schema, and must not
match it after any key is removed or added. Exit status 1 and one line per fault; 77 where python3-jsonschema is not installed.
"""
import copy
import json
import os
import re
import struct
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("SKIPPED: python3-jsonschema was not found")
    sys.exit(77)

PACKS = [
    ["teapot:tessellation=2", "--algorithm", "front_to_back,dual,painter", "--size", "20x17"],
    ["shadow-demo", "--algorithm", "weighted_average,stencil_routed_k_buffer", "--size", "16x16", "--profile", "geforce8"],
    ["hard:case=texture-coordinates-huge", "--profile", "geforce3", "--algorithm", "depth_units,a_buffer", "--size", "9x8"],
    ["planes:count=2", "--algorithm", "dual", "--size", "16x12", "--samples", "4", "--sample", "3", "--depth-order", "greater", "--clip-depth", "zero-to-one",
     "--vertex-path", "fused,double", "--sort", "shuffle:0.5,18446744073709551615", "--alpha", "0.1", "--color-space", "linear"],
    ["planes:count=2", "--algorithm", "front_to_back,dual", "--size", "9x7", "--samples", "4", "--shading", "pixel", "--load-sample", "0", "--sample-coverage", "0.75"],
]
WIDTHS = {"u1": 1, "u2": 2, "u4": 4, "i4": 4, "f2": 2, "f4": 4}
faults = []


def expect(holds, sentence):
    if not holds:
        faults.append(sentence)


def numbers(value):
    """Every {"decimal", "bits"} inside a value."""
    if isinstance(value, dict):
        if set(value) == {"decimal", "bits"}:
            yield value
        else:
            for inner in value.values():
                yield from numbers(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from numbers(inner)


def check_numbers(manifest):
    for both in numbers(manifest):
        for decimal, bits in zip(both["decimal"], both["bits"]):
            number, = struct.unpack(">f" if len(bits) == 8 else ">d", bytes.fromhex(bits))
            expect(decimal is None or (decimal == number and struct.pack(">d", decimal) == struct.pack(">d", number)),
                   f"{decimal} has the bits {bits}")


def check_files(pack, manifest):
    for name, entry in manifest["files"].items():
        with open(os.path.join(pack, name), "rb") as file:
            data = file.read()
        sums = [sum(data) % (2**61 - 1), sum((i + 1) * byte for i, byte in enumerate(data)) % (2**61 - 1)]
        expect([str(s) for s in sums] == entry["sums"], f"{name}: the sums are {sums}")
        if entry["type"] == "text":
            continue
        header = data[10:128].decode("ascii")
        expect(data[:10] == b"\x93NUMPY\x01\x00\x76\x00", f"{name}: its header has another length")
        shape = [int(side) for side in re.findall(r"\d+", header[header.index("'shape'"):])]
        expect(shape == entry["shape"], f"{name}: the header says {shape}")
        count = 1
        for side in shape:
            count *= side
        expect(len(data) == 128 + count * WIDTHS[entry["type"]], f"{name}: {len(data)} bytes")


def targets(manifest):
    for result in manifest["results"]:
        yield result["picture"]
        yield result["depth"]
        for layer in result["layers"]:
            yield layer["color"]
            yield layer["depth"]
        for step in result["passes"]:
            yield from step["targets"]


def check_targets(manifest):
    width, height = manifest["state"]["width"], manifest["state"]["height"]
    tiles = ((width + 15) // 16) * ((height + 15) // 16)
    for target in targets(manifest):
        entry = manifest["files"].get(target["file"])
        expect(entry is not None and entry["shape"][:2] == [height, width], f"{target['file']}: not of the frame's size")
        expect(len(target.get("tiles", [0] * tiles)) == tiles, f"{target['file']}: not {tiles} tiles")


def check_schema_bites(validator, manifest):
    """A manifest without any one key of any object, or with an additional key, must not match."""
    def objects(value, path):
        if isinstance(value, dict) and path[:1] != ("files",):
            yield path
        children = value.items() if isinstance(value, dict) else enumerate(value[:1]) if isinstance(value, list) else ()
        for key, inner in children:
            yield from objects(inner, path + (key,))

    optional = {"channels", "tile_size", "tiles"}
    for path in objects(manifest, ()):
        for change in ("less", "more"):
            other = copy.deepcopy(manifest)
            where = other
            for key in path:
                where = where[key]
            if change == "more":
                where["unheard_of"] = 1
            else:
                first = next((key for key in where if key not in optional), None)
                if first is None:
                    continue
                del where[first]
            expect(not validator.is_valid(other), f"the schema takes /{'/'.join(map(str, path))} with a key {change}")


def check_suite(strata, schema_file):
    """The list of a suite with one scene matches the suite's schema, and each scene named in it exists."""
    with open(os.path.join(os.path.dirname(schema_file), "suite.schema.json"), encoding="utf-8") as text:
        schema = json.load(text)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([strata, "golden", "planes.front_to_back", "--suite", "-o", os.path.join(folder, "set")], check=True)
        with open(os.path.join(folder, "set", "suite.json"), encoding="utf-8") as text:
            suite = json.load(text)
    for error in validator.iter_errors(suite):
        faults.append(f"suite.json: /{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    for key in suite:
        expect(not validator.is_valid({k: v for k, v in suite.items() if k != key}), f"the suite's schema takes one without {key}")
    there = {scene["name"] for scene in suite["scenes"]}
    for mistake in suite["mistakes"]:
        for key in ("named_first", "beside_another", "named_otherwise", "does_not_show"):
            expect(set(mistake[key]) <= there, f"{mistake['name']}: {key} names another scene")


def main(strata, schema_file):
    with open(schema_file, encoding="utf-8") as text:
        schema = json.load(text)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    for number, words in enumerate(PACKS):
        with tempfile.TemporaryDirectory() as folder:
            pack = os.path.join(folder, "pack")
            subprocess.run([strata, "golden", *words, "-o", pack], check=True, stderr=subprocess.DEVNULL)
            with open(os.path.join(pack, "manifest.json"), encoding="utf-8") as text:
                manifest = json.load(text)
            for error in validator.iter_errors(manifest):
                faults.append(f"{words[0]}: /{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
            check_numbers(manifest)
            check_files(pack, manifest)
            check_targets(manifest)
            if number == 2:
                check_schema_bites(validator, manifest)
    check_suite(strata, schema_file)
    for fault in faults[:20]:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
