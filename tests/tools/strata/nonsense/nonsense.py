#!/usr/bin/env python3
"""Tests invalid values in every option of every command, every parameter of every built-in scene and every field of a profile, a camera and a plan.

    tests/tools/strata/nonsense/nonsense.py build/release/strata          # a selection of each, some seconds
    tests/tools/strata/nonsense/nonsense.py build/release/strata --all    # every option with every value

The options are read from the help texts, the fields from the printed profile. An invalid value must give exit status 2 and one message that names the
option or the place, no other output and no file. The few values that are valid are in ACCEPTED with the reason.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from fields import camera_cases, plan_cases, profile_cases  # noqa: E402
from trial import Trial, output_of  # noqa: E402

VALUES = ["", "nan", "-nan(0)", "inf", "-inf", "0x1p4", "0x10", "1e308", "1e999", "-1e308", "9223372036854775808",
          "18446744073709551616", "-9223372036854775809", "4294967297", "-1", "-0", "+1", " 1", "1 ", "1\n", "1e", "1.5.2",
          "1_000", "1'000", "1,", ",", "-", "\u0663", "\uff11\uff12", "\u00bd", b"\xff\xfe", "%s%n", "null", "x" * 300]

SMALL = ["planes:count=1", "--size", "8x8"]
OUT = ["-o", "out"]
# Other options that a command needs, besides the one under test.
NEEDS = {
    "render": SMALL + ["--no-audit"], "layers": SMALL + ["--no-audit", "-o", "out.exr"], "passes": SMALL + OUT,
    "explain": SMALL + ["--pixel", "1,1"], "bench": SMALL + ["--repeat", "1", "--warm-up", "0", "--algorithm", "depth"],
    "cost": SMALL + ["--dry-run"], "invariance": SMALL + ["--dry-run"],
    "reproduce": ["everitt2001"] + OUT, "hard-cases": ["--list"], "multisampling": SMALL, "hardware-check": ["."], "scene": SMALL[:1],
    "compare": ["a.png", "b.png"], "report": SMALL + OUT, "golden": SMALL + OUT,
    "diagnose": SMALL + ["none.png"], "reduce": ["none", "true"] + OUT,
    "probe": OUT, "infer": ["none"], "list": ["scenes"], "info": ["none.png"],
    "help": [], "completions": [],
}

# (command or *, option, value): why the value is valid. Options that accept a file or folder of any name are excluded, except the empty name.
ACCEPTED = {
    ("*", "--fragment-memory", "4294967297"): "a size of 4 GiB",
    ("*", "--fragment-memory", "9223372036854775808"): "a limit that no machine reaches",
    ("*", "--max-memory", "9223372036854775808"): "a limit that no machine reaches",
    ("*", "--max-memory", "4294967297"): "a limit of 4 GiB",
    ("*", "--alpha", "-0"): "zero",
    ("*", "--compare-epsilon", "-0"): "zero",
    ("*", "--overestimation", "-0"): "zero",
    ("*", "--moment-bias", "-0"): "zero",
    **{("*", "--weight", number): "a formula of a number alone, with spaces; a negative one is the weight 0"
       for number in ("-1", "-0", " 1", "1 ", "4294967297", "9223372036854775808", "18446744073709551616", "-9223372036854775809")},
    ("bench", "--warm-up", "-0"): "zero",
}
# Messages may use these names instead.
SHORT = {"--output": ["-o"]}
# Checked only after the files are read, and there are none here.
LATE = {("compare", "--algorithm"), ("diagnose", "--profile"), ("diagnose", "--profiles"), ("diagnose", "--sorted"), ("diagnose", "--only"), ("diagnose", "--camera"),
        ("reduce", "--algorithm"), ("reduce", "--picture"), ("explain", "--candidate"), ("infer", "--output")}
ANY_NAME = ("PACK", "FILE", "FILE|-", "FOLDER", "DIR", "FILE.svg", "FILE.png", "FILE.xml", "FILE.html|FOLDER")


def options_of(program, command):
    """(option, type) as --help lists them; the type of a flag is empty."""
    found, inside = [], False
    for line in output_of(program, [command, "--help", "all"]).splitlines():
        if not line.startswith(" "):
            inside = line.endswith(":") and line not in ("Positionals:", "Examples:")
        elif inside and line.startswith("  -"):
            words = line.split()
            name = words[0].split(",")[-1]
            kind = line[2:].split("  ")[0].partition(" ")[2].strip().split("=")[0].removesuffix(" REQUIRED")
            if name not in ("--help", "--version"):
                found.append((name, kind))
    return found


def without(words, option):
    """The words without the option and its value, so that the option is given only once."""
    short = SHORT.get(option, [option])[0]
    kept = list(words)
    while short in kept:
        at = kept.index(short)
        del kept[at:at + (1 if short in ("--no-audit", "--dry-run", "--list") else 2)]
    return kept


def given(option, value):
    """A short option has its value as a separate word."""
    return [joined(option, value)] if option.startswith("--") else [option, value]


def joined(option, value):
    return option.encode() + b"=" + (value if isinstance(value, bytes) else value.encode())


def option_cases(program, commands):
    for command in commands:
        for option, kind in options_of(program, command):
            if (command, option) in LATE:
                continue
            values = [""] if kind in ANY_NAME else VALUES
            for value in values:
                if kind == "" and value == "":
                    continue  # a flag cannot have an empty value
                if {("*", option, value), (command, option, value)} & ACCEPTED.keys():
                    continue
                words = [command] + without(NEEDS[command], option) + given(option, value)
                yield Trial(f"{command} {option}", words, names=(option.lstrip('-'), *SHORT.get(option, ())))


def scene_cases(program):
    for line in output_of(program, ["list", "scenes"]).splitlines()[1:]:
        scene, _, parameters = line.split()[0].partition(":")
        for parameter in filter(None, parameters.split(",")):
            key = parameter.partition("=")[0]
            for value in VALUES:
                if value in ("4294967297", "9223372036854775808") and key == "seed":
                    continue  # seeds have 64 bits
                yield Trial(f"scene {scene}:{key}", ["scene", b"%s:%s" % (scene.encode(), joined(key, value))], names=(scene,))


def choice(cases, seed):
    """A few cases of each group, with different values for different groups, so that each value occurs often."""
    groups = {}
    for case in cases:
        groups.setdefault(case.group, []).append(case)
    for number, group in enumerate(groups.values()):
        for k in range(min(2, len(group))):
            yield group[(seed + 7 * number + 17 * k) % len(group)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--all", action="store_true", help="every option with every value")
    parser.add_argument("--seed", type=int, default=1, help="which values the choice takes (default 1)")
    arguments = parser.parse_args()
    commands = re.findall(r"^  ([a-z-]+)  ", output_of(arguments.program, []), re.MULTILINE)
    if missing := [c for c in commands if c not in NEEDS]:
        sys.exit(f"nonsense.py: NEEDS lacks what {', '.join(missing)} needs")
    of_options = list(option_cases(arguments.program, commands)) + list(scene_cases(arguments.program))
    of_fields = [case for make in (profile_cases, camera_cases, plan_cases) for case in make(arguments.program)]
    cases = of_options + of_fields if arguments.all else list(choice(of_options, arguments.seed)) + list(
        choice(of_fields, arguments.seed))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = list(filter(None, pool.map(lambda case: case.fault(arguments.program), cases)))
    for fault in faults:
        print(fault)
    print(f"{len(cases)} cases of nonsense, {len({case.group for case in cases})} places; {len(faults)} not refused as they should be")
    if len(cases) < 500:
        sys.exit("nonsense.py: fewer than 500 cases: the lists of options or fields are read no more")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
