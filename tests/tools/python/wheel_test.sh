#!/usr/bin/env bash
# wheel_test.sh STRATA FOLDER: makes a wheel of tools/python in FOLDER, installs it into a new environment, and calls it there: its pictures must have
# the digests that the program STRATA prints. Exit status 77 (skipped) if one of Debian's packages is missing.
set -euo pipefail
source=$(realpath "$(dirname "$0")/../../..")
strata=$(realpath "$1")
rm -rf "$2/wheel" "$2/fresh"
mkdir -p "$2/wheel" "$2/fresh"
folder=$(realpath "$2")
python=/usr/bin/python3  # Debian's, which has Debian's packages
for package in pybind11-dev python3-dev python3-numpy python3-venv python3-wheel; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' $package 2>/dev/null)" != installed ]; then
        echo "SKIPPED: the wheel needs Debian's package $package"
        exit 77
    fi
done
fail() { echo "wheel_test.sh: $*" >&2; exit 1; }

STRATA_PYTHON_BUILD=$folder/extension "$python" -m pip wheel --no-index --no-deps --no-build-isolation "$source/tools/python" \
    -w "$folder/wheel" >"$folder/wheel.log" 2>&1 || { tail -n 40 "$folder/wheel.log" >&2; fail "pip wheel failed"; }
wheels=("$folder"/wheel/*.whl)
[ ${#wheels[@]} = 1 ] && [ -f "${wheels[0]}" ] || fail "expected one wheel, found ${wheels[*]}"

"$python" -m venv --system-site-packages "$folder/fresh/environment"  # Debian's numpy
"$folder/fresh/environment/bin/pip" install --quiet --no-index --no-deps "${wheels[0]}"
# The sources of the wheel are removed before it is called.
rm -rf "$folder/extension"
cd "$folder/fresh"
"$strata" render teapot --size 64x48 --algorithm dual,weighted_average --no-audit --stats stats.json -q -o there.png
env -i PATH="$PATH" environment/bin/python -I - "$folder/fresh" "$strata" <<'PYTHON'
import json
import pathlib
import subprocess
import sys

import strata

folder = pathlib.Path(sys.argv[1])
assert folder in pathlib.Path(strata.__file__).parents, strata.__file__
for row in json.loads((folder / "stats.json").read_text()):
    picture = strata.render(strata.Scene("teapot"), row["algorithm"], profile="geforce8", size=(64, 48))
    assert picture.digest == row["digest"]["color"], (row["algorithm"], picture.digest, row["digest"])
    assert strata.compare(picture, picture).equal
assert [array.shape for array in strata.read(str(folder / "there.dual.png")).arrays.values()] == [(48, 64, 4)]
for name in ("_strata.pyi", "py.typed", "pytest_plugin.py"):
    assert (pathlib.Path(strata.__file__).parent / name).is_file(), name
try:
    strata.Scene("no-such-scene")
    raise AssertionError("expected an error for an unknown scene")
except strata.InputError as error:
    assert "no-such-scene" in str(error), error

# A keyword means what the option of the same name means.
for options, words in [
    (dict(), []),
    (dict(clip_depth="zero_to_one", depth_order="greater", depth_format="d32f"), "--clip-depth zero-to-one --depth-order greater --depth-format d32f"),
    (dict(samples=4, sample=2), "--samples 4 --sample 2"),
    (dict(samples=4, shading="pixel", load_sample=0), "--samples 4 --shading pixel --load-sample 0"),
    (dict(polygon_offset=(1, 2.5), scissor=(3, 4, 20, 10)), "--polygon-offset 1,2.5 --scissor 3,4,20,10"),
    (dict(compare_epsilon="2ulp", vertex_path="fused", termination="fixed:2"), "--compare-epsilon 2ulp --vertex-path fused --termination fixed:2"),
    (dict(background=(0.5, 0.25, 1, 0.5), sort="reverse", quantize_reference=False), "--background 0.5,0.25,1,0.5 --sort reverse --no-quantize-reference"),
]:
    words = words.split() if words else []
    subprocess.run([sys.argv[2], "render", "teapot", "--size", "24x16", "--alpha", "0.5", *words, "--no-audit", "--stats", "stats.json", "-q", "-o", "there.png"], check=True)
    row = json.loads((folder / "stats.json").read_text())[0]
    picture = strata.render(strata.Scene("teapot"), "dual", profile="geforce8", size=(24, 16), alpha=0.5, audit=False, **options)
    assert picture.digest == row["digest"]["color"], words
PYTHON
environment/bin/pip uninstall --quiet --yes strata
echo "$(basename "${wheels[0]}"): $(($(stat -c %s "${wheels[0]}") / 1024)) KiB, installed, called and removed"
