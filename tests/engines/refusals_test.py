#!/usr/bin/python3
"""Tests that the engine drivers (tools/port/engines) reject packs that they cannot draw exactly, with the JSON pointer of the unsupported feature:
refusals_test.py STRATA."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools" / "port" / "engines"))
import pack_scene  # noqa: E402

# Arguments of `strata golden`, and the beginning of the expected error; "" if the pack can be drawn.
CASES = [
    (["planes:count=2"], ""),
    (["planes:count=2", "--alpha", "0.5"], "/state/alpha: expected null, found {"),
    (["planes:count=2", "--depth-order", "greater"], '/state/depth_order: expected "less", found "greater"'),
    (["planes:count=2", "--clip-depth", "zero-to-one"], '/state/clip_depth: expected "minus_one_to_one", found "zero_to_one"'),
    (["planes:count=2", "--color-space", "linear"], "/scene: expected encoded colours without textures"),
    (["showroom"], "/scene: expected encoded colours without textures"),
    (["shadow-demo"], "/scene: expected encoded colours without textures"),
    (["planes:count=2", "--depth-range", "0.25,0.75"], "/state/depth_range: expected 0 to 1"),
    (["teapot"], "/draws, transparent: expected surfaces with the same colour on both sides"),
]


def refusal_of(strata, words, pack):
    subprocess.run([strata, "golden", *words, "--size", "8x6", "--algorithm", "unsorted", "-o", pack, "-q"], check=True, stdout=subprocess.DEVNULL)
    try:
        pack_scene.read_scene(pack)
    except pack_scene.PackError as error:
        return str(error)
    return ""


def masked(pack):
    """The pack with an alpha test added to its material."""
    manifest = json.loads((pack / "manifest.json").read_text())
    manifest["scene"]["materials"][0]["alpha_mode"] = "mask"
    (pack / "manifest.json").write_text(json.dumps(manifest))
    try:
        pack_scene.read_scene(pack)
    except pack_scene.PackError as error:
        return str(error)
    return ""


def main(strata):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for number, (words, expected) in enumerate(CASES):
            found = refusal_of(strata, words, pathlib.Path(folder) / str(number))
            if not found.startswith(expected) or bool(found) != bool(expected):
                wrong.append(f"{' '.join(words)}: expected {expected!r}, found {found!r}")
        if "without an alpha test" not in masked(pathlib.Path(folder) / "0"):
            wrong.append("a material with an alpha test is not refused")
        if "expected a pack of `strata golden`" not in refusal_of("true", [], pathlib.Path(folder) / "none"):
            wrong.append("a folder that is not there is not refused")
    print("\n".join(wrong) or f"{len(CASES) + 2} packs are drawn or refused as they should")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
