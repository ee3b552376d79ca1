#!/usr/bin/env bash
# Installs the Python package into a virtual environment of its own, as a user would, and tests it from there: no network is needed.
#   tools/python/test.sh [FOLDER]   builds shared libraries, the package and the environment in FOLDER (default: build/python)
# Exit status 77 (skipped) if Debian's packages of tools/packages.txt, "Python", are missing: tools/setup.sh python.
set -euo pipefail
cd "$(dirname "$0")/../.."
source=$PWD
mkdir -p "${1:-build/python}"
folder=$(cd "${1:-build/python}" && pwd)
python=/usr/bin/python3  # Debian's, which has Debian's packages

for package in pybind11-dev python3-dev python3-numpy python3-pytest python3-venv python3-wheel python3-openimageio jupyter-nbconvert python3-ipykernel mypy; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' $package 2>/dev/null)" != installed ]; then
        echo "SKIPPED: the Python package needs Debian's package $package"
        exit 77
    fi
done
trap 'echo "tools/python/test.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

step() { echo "--- $*"; }

step "shared libraries into $folder/installed"
cmake --preset shared -B "$folder/shared" >"$folder/build.log"
cmake --build "$folder/shared" >>"$folder/build.log" 2>&1 || { tail -n 40 "$folder/build.log" >&2; exit 3; }
rm -rf "$folder/installed"
cmake --install "$folder/shared" --prefix "$folder/installed" >>"$folder/build.log"

step "pip install tools/python: against static libraries, which fails, then against shared ones"
rm -rf "$folder/environment" "$folder/extension"
"$python" -m venv --system-site-packages "$folder/environment"
install() { "$folder/environment/bin/pip" install --quiet --no-index --no-deps --no-build-isolation "$source/tools/python"; }
export STRATA_PYTHON_BUILD=$folder/extension
mkdir -p "$folder/static/lib/cmake/strata"
echo 'add_library(strata::library STATIC IMPORTED)' >"$folder/static/lib/cmake/strata/strata-config.cmake"
printf 'set(PACKAGE_VERSION 0.1.0)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' >"$folder/static/lib/cmake/strata/strata-config-version.cmake"
if STRATA_PREFIX=$folder/static install >>"$folder/build.log" 2>&1; then
    echo "expected that an installation against static libraries fails" >&2
    exit 1
fi
STRATA_PREFIX=$folder/installed install

cd "$folder"  # away from the sources, so that the installed package is tested
step "tests"
environment/bin/python -m pytest -q -p no:cacheprovider "$source/tests/tools/python"
step "types"
environment/bin/python -m mypy --strict --cache-dir "$folder/mypy" -p strata
environment/bin/python -m mypy --strict --cache-dir "$folder/mypy" "$source/tests/tools/python/typed_use.py"
step "the notebook, from top to bottom"
environment/bin/python -m ipykernel install --prefix "$folder/environment" --name python3 >/dev/null
mkdir -p notebook && cp "$source/tools/python/tour.ipynb" notebook  # it writes files into its own folder
environment/bin/python -m nbconvert --to notebook --execute --inplace notebook/tour.ipynb
step "the examples, from the shared libraries"
cmake -S "$source/tools/library/examples" -B "$folder/examples" -G Ninja -DCMAKE_PREFIX_PATH="$folder/installed" >>"$folder/build.log"
cmake --build "$folder/examples" >>"$folder/build.log"
"$folder/examples/own_algorithm"
"$folder/examples/rubber_band"
status=0
"$folder/examples/reference_picture" || status=$?
[ $status = 1 ] || { echo "expected that the example ends with 1, found $status" >&2; exit 1; }
echo "all of it passed"
