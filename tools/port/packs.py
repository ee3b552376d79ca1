"""Packs and candidates for validate.py and mistaken.py: made by `strata golden` and `strata_port`, read with only the standard library."""
import array
import json
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
HEADER = 128
CODES = {"|u1": "B", "<u2": "H", "<f2": "H", "<u4": "I", "<i4": "I", "<f4": "I"}
ALGORITHMS = ["front_to_back", "dual", "weighted_average", "coherent_stencil", "depth_units"]
# The port's depth_units needs Strata's: sequential depth units, which no profile of a real driver has.
UNITS = {"has_sequential_depth_units": True}
# An endless peel of the port ends after this number of passes, which the diagnosis is given as a limit.
MOST_PASSES = 200
GIVES_UP = ["--limit", str(MOST_PASSES)]


def read(path):
    """Pixels as tuples of codes: the bits of each element."""
    data = pathlib.Path(path).read_bytes()
    header = data[10:HEADER].decode()
    descr = header.split("'descr': '")[1].split("'")[0]
    shape = [int(n) for n in header.split("'shape': (")[1].split(")")[0].split(",") if n.strip()]
    codes = array.array(CODES[descr], data[HEADER:])
    channels = shape[2] if len(shape) > 2 else 1
    return [tuple(codes[i:i + channels]) for i in range(0, len(codes), channels)]


class Failed(Exception):
    """A program ended with an error; the text is its output."""


def run(words, allowed=(0,)):
    done = subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in allowed:
        raise Failed(f"{' '.join(map(str, words))}: exit status {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def profile_file(folder, base, fields=None):
    """Writes a profile: `base` with depth units and changed fields; the names of rasterizer fields have a dot."""
    text = {"base": base, "name": f"{base}_port", **UNITS}
    for name, value in (fields or {}).items():
        room, _, key = name.rpartition(".")
        (text.setdefault(room, {}) if room else text)[key] = value
    path = pathlib.Path(folder) / ("profile." + "".join(f"{k}={v}." for k, v in (fields or {}).items()) + f"{base}.json")
    path.write_text(json.dumps(text))
    return path


class Pack:
    """A golden pack of a scene: `words` are the scene and its options."""
    def __init__(self, build, folder, words, profile, algorithms=None):
        self.build, self.folder = pathlib.Path(build), pathlib.Path(folder)
        run([self.build / "strata", "golden", *words, "--profile", profile, "--algorithm", ",".join(algorithms or ALGORITHMS), "-o", folder])
        self.manifest = json.loads((self.folder / "manifest.json").read_text())
        self.results = {result["algorithm"]: result for result in self.manifest["results"]}

    def target(self, described):
        return read(self.folder / described["file"])

    def candidate(self, folder, driver, mistakes="", algorithms=None, picture_only=False):
        words = [self.build / "strata_port", self.folder, "-o", folder, "--driver", driver, "--algorithm", ",".join(algorithms or self.results), "--max-passes", str(MOST_PASSES)]
        words += ["--mistake", mistakes] if mistakes else []
        words += ["--picture-only"] if picture_only else []
        run(words)
        return pathlib.Path(folder)


def layers_of(pictures):
    """The layers of every pixel, nearest first: (colour, depth), without missing ones, whose values are all 0."""
    columns = None
    for color, depth in pictures:
        columns = columns or [[] for _ in color]
        for column, c, d in zip(columns, color, depth):
            if any(c):
                column.append((c, d))
    return columns or []


def agreement(pack, candidate):
    """The number of pixels whose fragments, depths of layers, order of layers, colours and pictures differ; and the number of targets after every
    pass, and of those that differ in any pixel."""
    found = {"targets": 0, "targets that differ": 0}
    for name, result in pack.results.items():
        for number, shown in enumerate(result["passes"]):
            for target in shown["targets"]:
                file = candidate / name / f"pass.{number:03}" / f"{target['name']}.npy"
                if file.exists():
                    found["targets"] += 1
                    found["targets that differ"] += file.read_bytes()[HEADER:] != (pack.folder / target["file"]).read_bytes()[HEADER:]
    average = pack.results.get("weighted_average")
    if average:
        count = next(t for t in average["passes"][0]["targets"] if t["name"] == "count")
        ours, theirs = pack.target(count), read(candidate / "weighted_average/pass.000/count.npy")
        found["pixels"] = len(ours)
        found["coverage"] = sum(a != b for a, b in zip(ours, theirs))
    peel = pack.results.get("front_to_back")
    if peel:
        ours = layers_of((pack.target(layer["color"]), pack.target(layer["depth"])) for layer in peel["layers"])
        files = sorted((candidate / "front_to_back").glob("layer.*.color.npy"))
        theirs = layers_of((read(f), read(str(f).replace(".color.", ".depth."))) for f in files)
        blank = [[] for _ in range(max(len(ours), len(theirs)))]
        pairs = list(zip(ours or blank, theirs or blank))
        found["depth"] = sum([d for _, d in a] != [d for _, d in b] for a, b in pairs)
        colors = [([c for c, _ in a], [c for c, _ in b]) for a, b in pairs]
        found["order"] = sum(a != b and sorted(a) == sorted(b) for a, b in colors)
        found["colour"] = sum(sorted(a) != sorted(b) for a, b in colors)
    for name, result in pack.results.items():
        picture = candidate / name / "picture.npy"
        if picture.exists():
            found[name] = sum(a != b for a, b in zip(pack.target(result["picture"]), read(picture)))
    return found
