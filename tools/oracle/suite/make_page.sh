#!/usr/bin/env bash
# Writes MISTAKES.md and its plot, and the whole table to build/mistakes/MISTAKES.md: every mistake in every scene of the suite.
#   tools/oracle/suite/make_page.sh     Needs a release build; takes a few minutes.
set -euo pipefail
cd "$(dirname "$0")/../../.."
trap 'echo "tools/oracle/suite/make_page.sh: failed at line $LINENO: $BASH_COMMAND" >&2' ERR

strata=${STRATA:-build/release/strata} out=${OUT:-build/mistakes}
mkdir -p "$out"
"$strata" diagnose --list --table -o "$out/MISTAKES.md"
cp "$out/MISTAKES.svg" tools/oracle/suite/MISTAKES.svg
{
    cat <<'END'
# Mistakes, and the scenes that show them

If a port makes one of the known mistakes, does `strata diagnose` name it from the picture alone, and which scenes must be rendered for that?
Each mistake of the catalogue is emulated alone, on a CPU, on every scene of the suite (`tools/oracle/suite/make_page.sh`). The
picture is then diagnosed like that of an unknown port.

END
    sed -n '3,/^$/p' "$out/MISTAKES.md"  # the results, three sentences
    cat <<'END'
![What each scene of the suite shows of the mistakes](MISTAKES.svg)

Each bar is a scene: the numbers of mistakes that are named first, that have the picture of another, named mistake, that are not visible,
and that cannot occur in that scene.

## The whole table

    tools/oracle/suite/make_page.sh          # this page, and the whole table: build/mistakes/MISTAKES.md
    strata diagnose --list                   # every mistake in a sentence
    strata diagnose --list --suite           # every scene with its purpose and its command

The whole table has a row per mistake, a column per scene, the command of each scene, and the first scene that names each mistake. Two
mistakes that give the same pictures in every scene are listed with the reason. `strata render SCENE --mistake NAME` renders such a picture.
END
} >tools/oracle/suite/MISTAKES.md
