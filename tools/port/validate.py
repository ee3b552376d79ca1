#!/usr/bin/env python3
"""Writes tools/port/RESULTS.md, which driver equals which profile, and build/port/RESULTS.md with the differences of each algorithm and their causes.

    tools/port/validate.sh [--drivers llvmpipe,llvmpipe_sse,softpipe,hardware] [--quick]

The port renders small packs of every profile on every installed driver. Exit status 1: a driver differs from its own profile where it should not.
"""
import argparse
import pathlib
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
import packs  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DRIVERS = ["llvmpipe", "llvmpipe_sse", "softpipe", "hardware"]
PROFILES = ["llvmpipe", "llvmpipe_sse", "softpipe", "geforce8_dx101"]
SCENES = {
    "teapot": ["teapot", "--alpha", "0.5", "--size", "97x73"],
    "random, d24": ["random:seed=3,triangles=60", "--size", "121x91", "--depth-format", "d24"],
    "random, rgba16f": ["random:seed=5,triangles=200", "--size", "67x83", "--color-format", "rgba16f"],
    "random, rgba32f, d24": ["random:seed=9,triangles=120", "--size", "75x51", "--color-format", "rgba32f", "--depth-format", "d24"],
    "planes": ["planes:count=12", "--size", "65x49"],
    "beam": ["volume-beam:slices=16", "--size", "89x61"],
    "coincident": ["hard:case=coincident", "--size", "64x64"],
    "corners on centres": ["hard:case=corners-on-centres", "--size", "64x64"],
    "cyclic overlap": ["hard:case=cyclic-overlap", "--size", "63x65"],
    "opaque": ["hard:case=opaque-crossing", "--size", "64x64"],
    "through near": ["hard:case=through-near", "--size", "71x59"],
    "beyond the guard band": ["hard:case=beyond-the-guard-band", "--size", "64x48"],
}
WHY = ["random, d24", "corners on centres", "through near"]  # the scenes for which fields are exchanged one at a time
CLASSES = ["coverage", "depth", "order", "colour"]
# Results of a driver that must equal its own profile (bench/DIFFERENCES.md); softpipe's colours are not emulated.
ALL = CLASSES + packs.ALGORITHMS + ["targets that differ"]
OWED = {"llvmpipe": ALL, "llvmpipe_sse": ALL, "softpipe": ["coverage", "depth"]}


def is_owed(driver, scene, key):
    """Is the result required to be equal? The port rounds depths as llvmpipe does: with 24 bits its peel on softpipe finds other layers
    (pipeline/reference/mesa-rasterizers.md 3.3)."""
    return key in OWED.get(driver, []) and not (driver == "softpipe" and key == "depth" and "d24" in SCENES[scene])


COUNTS = ["pixels", "targets"]  # these are totals and not differences


def differs(found):
    return any(v for k, v in found.items() if k not in COUNTS)


def add(total, found):
    for key, value in found.items():
        total[key] = total.get(key, 0) + value


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in lines) + "\n"


class Bench:
    def __init__(self, build, folder):
        self.build, self.folder, self.number = pathlib.Path(build), pathlib.Path(folder), 0

    def pack(self, scene, profile):
        self.number += 1
        return packs.Pack(self.build, self.folder / f"pack{self.number}", SCENES[scene], profile)

    def differences(self, pack, driver):
        """Compares and deletes the driver's folder: targets of all passes are large."""
        candidate = pack.candidate(self.folder / "candidate", driver)
        found = packs.agreement(pack, candidate)
        shutil.rmtree(candidate)
        return found

    def renderer(self, driver, pack):
        """The driver's own name, or None if it is not installed."""
        try:
            candidate = pack.candidate(self.folder / "candidate", driver, picture_only=True)
        except packs.Failed as failed:
            print(f"{driver}: {failed}", file=sys.stderr)
            return None
        text = packs.json.loads((candidate / "candidate.json").read_text())["made_by"]
        shutil.rmtree(candidate)
        return text.removeprefix("strata_port, ")


def measure(bench, drivers, scenes):
    """By driver and profile: totals, and results of each scene."""
    found = {driver: {} for driver in drivers}
    for profile in PROFILES:
        file = packs.profile_file(bench.folder, profile)
        for scene in scenes:
            pack = bench.pack(scene, file)
            for driver in drivers:
                of = found[driver].setdefault(profile, {})
                of[scene] = bench.differences(pack, driver)
                print(driver, profile, scene, {k: v for k, v in of[scene].items() if v and k not in COUNTS}, file=sys.stderr, flush=True)
            shutil.rmtree(pack.folder)
    return found


def agreement_section(found):
    text = []
    for driver, (renderer, profiles) in found.items():
        rows = []
        for profile, scenes in profiles.items():
            total = {}
            for differences in scenes.values():
                add(total, differences)
            equal = sum(not differs(d) for d in scenes.values())
            targets = f"{total['targets that differ']:,} of {total['targets']:,}"
            rows.append([profile, f"{equal} of {len(scenes)}", total["pixels"], *(total.get(k, "-") for k in [*CLASSES, *packs.ALGORITHMS]), targets])
        text += [f"## {driver}\n{renderer}\n", table(["profile", "scenes alike", "pixels", *CLASSES, *packs.ALGORITHMS, "targets"], rows)]
    return "\n".join(text)


def where_section(found):
    rows = []
    for driver, (_, profiles) in found.items():
        for scene, differences in profiles.get(driver, {}).items():
            if differs(differences):
                rows.append([driver, scene, *(differences.get(k, "-") for k in [*CLASSES, *packs.ALGORITHMS])])
    title = "## Where a driver differs from its own profile\n\n"
    return title + (table(["driver", "scene", *CLASSES, *packs.ALGORITHMS], rows) if rows else "Nowhere.\n")


def fields_that_differ(build, ours, theirs):
    """Rules in which two profiles differ: {field: the other's value}. Features and limits affect no pixel."""
    one, other = (packs.json.loads(packs.run([build / "strata", "list", "profiles", name, "--json"])) for name in (ours, theirs))
    rules = {f"raster.{k}": v for k, v in other["raster"].items() if one["raster"].get(k) != v}
    rules.update({k: v for k, v in other.items() if one.get(k) != v and isinstance(v, str) and k not in ("name", "description")})
    return rules


def why_section(bench, driver, other, own):
    """`own`: the results of the driver under its own profile, by scene."""
    total = {}
    for scene in WHY:
        add(total, own[scene])
    rows = [["(no rule)", *(total.get(k, "-") for k in [*CLASSES, "front_to_back", "dual"])]]
    for field, value in fields_that_differ(bench.build, driver, other).items():
        file, total = packs.profile_file(bench.folder, driver, {field: value}), {}
        try:
            for scene in WHY:
                pack = bench.pack(scene, file)
                add(total, bench.differences(pack, driver))
                shutil.rmtree(pack.folder)
        except packs.Failed:
            rows.append([f"`{field}` {value}", *["not by itself"] * (len(CLASSES) + 2)])
            continue
        print(driver, field, value, total, file=sys.stderr, flush=True)
        rows.append([f"`{field}` {value}", *(total.get(k, "-") for k in [*CLASSES, "front_to_back", "dual"])])
    return table([f"of {other}, alone in {driver}", *CLASSES, "front_to_back", "dual"], rows)


def summary(found):
    """A row for each driver and profile: the pixels of all scenes whose fragments, depths, order or colours differ."""
    rows = []
    for driver, (_, profiles) in found.items():
        for profile, scenes in profiles.items():
            total = {}
            for differences in scenes.values():
                add(total, differences)
            equal = sum(not differs(d) for d in scenes.values())
            rows.append([driver, profile, f"{equal} of {len(scenes)}", *(total.get(k, "-") for k in CLASSES), f"{total['targets that differ']:,} of {total['targets']:,}"])
    return table(["driver", "profile", "scenes equal", *CLASSES, "targets that differ"], rows)


def page(found, scenes):
    """The short page: at most 600 words."""
    names = "\n".join(f"- {driver}: {renderer}" for driver, (renderer, _) in found.items())
    pixels = max(sum(d["pixels"] for d in scenes.values()) for _, profiles in found.values() for scenes in profiles.values())
    return f"""# The OpenGL port on Mesa's software drivers

Does an OpenGL driver render exactly the bits that the profile of its name predicts? The port, an OpenGL program with five peeling algorithms,
renders {len(scenes)} small packs of each profile on each driver (`tools/port/validate.sh`), and every target after every pass is compared: {pixels:,}
pixels per profile and driver. The drivers run on an x86-64 CPU:

{names}

{summary(found)}
The columns count pixels: *coverage*, the number of fragments differs; *depth*, the depth of a layer differs; *order*, the order of the same
layers differs; *colour*, the colour of a layer differs. *Targets* are all targets after every pass.

The differences of softpipe from its own profile have known causes. softpipe truncates 24-bit depths, whereas the port's shader rounds them to
nearest, as llvmpipe does, so that its peel finds other layers. Strata does not emulate how softpipe blends several fragments of one pass at
one pixel: in `coincident` every depth and stencil of `coherent_stencil` is equal, and the first blended colours differ by one code.
[mesa-rasterizers.md](../../pipeline/reference/mesa-rasterizers.md) has the rules of these drivers; [GPU.md](GPU.md) the results of an NVIDIA GPU.

## The whole table

    tools/port/validate.sh

The command builds the port and Strata, renders on every installed driver, and writes this page. It also writes `build/port/RESULTS.md` with the
pixels of every algorithm's picture, the scenes in which a driver differs from its own profile, and the differences that each rule of another
device causes alone. Exit status 1 if a driver differs where it should not.
"""


def whole_page(found, whys, scenes):
    head = f"""# The OpenGL port on Mesa's software drivers, in full

Scenes: {'; '.join(scenes)}. The classes of pixels are followed by the number of pixels of each algorithm's picture that differ. `targets` are all
targets after every pass: those in which a pixel differs, of all. `depth_units` is the port's shadow comparison against sequential depth units.

"""
    why = "## Why\n\nA driver's own profile with one rule of another device: the pixels of " + "; ".join(WHY) + """ that differ from the
driver then. A rule that changes nothing decides no pixel of these scenes.

"""
    return head + agreement_section(found) + "\n" + where_section(found) + "\n" + why + "\n".join(whys)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="where strata and strata_port are")
    parser.add_argument("--drivers", default=",".join(DRIVERS), help="of %(default)s; those that are not there are left out")
    parser.add_argument("--quick", action="store_true", help="three scenes and no reasons: to try the script")
    parser.add_argument("--out", default=str(HERE / "RESULTS.md"))
    parser.add_argument("--whole", type=pathlib.Path, default=ROOT / "build" / "port" / "RESULTS.md")
    options = parser.parse_args()
    scenes = WHY if options.quick else list(SCENES)
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.build, folder)
        tried = bench.pack(scenes[0], packs.profile_file(folder, "llvmpipe"))
        there = {driver: name for driver in options.drivers.split(",") if (name := bench.renderer(driver, tried))}
        measured = measure(bench, list(there), scenes)
        found = {driver: (there[driver], measured[driver]) for driver in there}
        whys = [] if options.quick else [why_section(bench, driver, "geforce8_dx101", measured[driver][driver]) for driver in ("llvmpipe", "softpipe") if driver in there]
        pathlib.Path(options.out).write_text(page(found, scenes))
        options.whole.parent.mkdir(parents=True, exist_ok=True)
        options.whole.write_text(whole_page(found, whys, scenes))
    wrong = [(driver, scene, key) for driver in there for scene, d in measured[driver].get(driver, {}).items()
             for key in d if d[key] and is_owed(driver, scene, key)]
    for driver, scene, key in wrong:
        print(f"validate.py: {driver}: {scene}: {key} differs", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
