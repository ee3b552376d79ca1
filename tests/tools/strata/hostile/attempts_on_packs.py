"""Attacks by packs and the files that are compared with them: manifests, arrays, suites, a candidate's folder, the answers to a kit."""
import functools
import json
import pathlib
import shutil
import subprocess
import tempfile

from formats import CORNERS, npy, tar
from places import ESCAPES, LONG, MARKUP, SIZE, link, pipe, write, write_json, write_outside

READERS = (["scene", "pack"], ["render", "pack", "-o", "out.png"], ["golden", "--check", "pack"], ["compare", "pack", "pack"], ["diagnose", "pack", "pack"],
           ["reduce", "pack", "false {pack} {picture}", "-o", "out"])
# `compare` reads only the expected results of a pack, not its scene.
SCENE_READERS = [command for command in READERS if command[0] != "compare"]

# The state of a frame of all samples, at points that no profile has.
SAMPLING = {"interpolation": "sample", "samples": [{"x": 0, "y": 15}, {"x": 1, "y": 14}], "all": {"resolve": "box", "loads": "own", "composites": "own"},
            "alpha_to_coverage": False, "coverage": None, "inverts_coverage": False, "mask": 255}


@functools.cache
def pack_of(program):
    """A small pack, written once."""
    folder = pathlib.Path(tempfile.mkdtemp()) / "pack"
    subprocess.run([program, "golden", "planes:count=1", *SIZE, "--algorithm", "front_to_back", "-o", folder], check=True, stdout=subprocess.DEVNULL)
    return folder


def at(value, *keys):
    for key in keys:
        value = value[key]
    return value


def add_to(attempt):
    def pack(change=lambda manifest: None, also=lambda place: None):
        def make(place, program):
            write_outside(place)
            shutil.copytree(pack_of(program), place / "here" / "pack")
            shutil.copytree(pack_of(program), place / "outside" / "pack")
            manifest = json.loads((place / "here/pack/manifest.json").read_text())
            changed = change(manifest)
            write_json(place, "pack/manifest.json", manifest if changed is None else changed)
            also(place)
        return make

    attempt("pack", "none", pack(), *(c for c in READERS[:2] + READERS[3:5]), harmless=True)
    attempt("NPY", "none", lambda p, _: write(p, "a.npy", npy("(1, 3, 3)", CORNERS)), ["scene", "a.npy"], harmless=True)

    def set_to(value, *keys):
        def change(manifest):
            at(manifest, *keys[:-1])[keys[-1]] = value
        return change
    mesh = ("scene", "meshes", 0)
    outside = "../../outside/pack/scene/mesh.000.positions.npy"
    for what, name in (("an array in the folder above", outside), ("the same behind a folder", "scene/../" + outside), ("a device for an array", "/dev/zero")):
        attempt("pack", what, pack(set_to(name, *mesh, "positions")), *SCENE_READERS, must_fail=True)
    attempt("pack", "an array that is a link out of the pack", pack(also=lambda p: link(p, "pack/scene/mesh.000.positions.npy", "../" + outside)), *SCENE_READERS, must_fail=True)
    attempt("pack", "an array that is a pipe", pack(also=lambda p: ((p / "here/pack/scene/mesh.000.positions.npy").unlink(), pipe(p, "pack/scene/mesh.000.positions.npy"))),
            *(c for c in SCENE_READERS if c[0] != "golden"), must_fail=True)  # golden --check names the file as one that is missing
    attempt("pack", "a profile that is a link out of the pack", pack(also=lambda p: link(p, "pack/profile.json", "../../outside/pack/profile.json")),
            ["render", "pack", "-o", "out.png"], ["golden", "--check", "pack"], ["diagnose", "pack", "pack"], must_fail=True)
    compared = (["compare", "pack", "pack"], ["diagnose", "pack", "pack"])
    for what, keys in (("a picture", ("picture", "file")), ("a pass's target", ("passes", 0, "targets", 0, "file"))):
        for where in ("../../outside/pack/expected/front_to_back/picture.npy", "/dev/stdin"):
            attempt("pack", f"{what} at {where[:9]}...", pack(set_to(where, "results", 0, *keys)), *compared, must_fail=True)
    attempt("pack", "an algorithm that is a path", pack(set_to("../../outside/pack/expected/front_to_back", "results", 0, "algorithm")),
            *compared, ["compare", "pack", "."], ["diagnose", "pack", "."], ["golden", "--check", "pack"], must_fail=True)
    attempt("pack", "a layer whose name is a path", pack(set_to("../../../outside/pack", "results", 0, "layers", 0, "name")), ["compare", "pack", "pack"],
            ["compare", "pack", "pack/expected"], must_fail=True)
    attempt("pack", "a listed file above the pack", pack(lambda m: m["files"].update({"../../outside/word.txt": {"type": "text", "digest": "", "sums": ["0", "0"]}})),
            ["golden", "--check", "pack"], must_fail=True)
    for what, value in (("a word", "x"), ("a number", 1), ("arrays", [[[[]]]]), ("nothing", None)):
        for keys in (("results",), ("files",), ("results", 0), ("results", 0, "passes"), ("results", 0, "picture"), ("files", "profile.json"), ("files", "profile.json", "sums"),
                     ("scene",), ("scene", "meshes"), ("state",), ("view",)):
            if value is None and keys not in (("scene",), ("state",), ("view",)):
                continue
            commands = (["golden", "--check", "pack"],) if keys[0] == "files" else (["compare", "pack", "pack"],) if len(keys) > 2 else READERS[2:4]
            attempt("pack", f"{what} for {'/'.join(map(str, keys))}", pack(set_to(value, *keys)),
                    *(c for c in commands if keys[0] == "results" and c[0] == "compare" or c[0] == "golden"), must_fail=True)
    for what, keys, value in (("a frame of 2^31 pixels a side", ("state", "width"), 2**31 - 1), ("samples without end", ("results", 0, "picture", "samples"), 2**31 - 1),
                              ("passes without end", ("state", "max_passes"), 2**40), ("a sampling that is empty", ("state", "sampling"), {}),
                              ("samples at points of no device", ("state", "sampling"), SAMPLING), ("no samples at all", ("state", "sampling"), {**SAMPLING, "samples": []}),
                              ("a texture that is not there", ("scene", "materials", 0, "texture"), 7),
                              ("a mesh that is not there", ("scene", "instances", 0, "mesh"), 2**32 - 1)):
        attempt("pack", what, pack(set_to(value, *keys)), ["compare", "pack", "pack"] if keys[0] == "results" else ["render", "pack", "-o", "out.png"], must_fail=True)
    for what, value in (("escapes", ESCAPES), ("markup", MARKUP), ("a megabyte", LONG)):
        def change(manifest, value=value):
            manifest["command"] = manifest["scene"]["name"] = at(manifest, *mesh)["name"] = manifest["results"][0]["passes"][0]["kind"] = value
            for target in manifest["results"][0]["passes"][0]["targets"]:
                target["name"] = value.replace("/", "-")
        attempt("pack", f"names with {what}", pack(change), ["scene", "pack"], ["scene", "pack", "--json"], ["compare", "pack", "pack"], ["compare", "pack", "pack", "--json"],
                ["compare", "pack", "pack", "--junit", "out.xml", "--report", "out.html"], ["explain", "pack", "--pixel", "4,4", "--svg", "out.svg"],
                ["report", "pack", "-o", "out"], ["diagnose", "pack", "pack", "--report", "out.html"], ["golden", "--check", "pack"])
    attempt("pack", "arrays in arrays without end", pack(also=lambda p: write(p, "pack/manifest.json", b'{"format": ' + b"[" * 200000)), *READERS, must_fail=True)

    positions = "pack/scene/mesh.000.positions.npy"
    for what, content in (("2^32 rows that are not there", npy("(4294967295, 3)", b"")), ("an axis of 0 beside one of 2^32", npy("(4294967295, 0)", b"")),
                          ("a product beyond 64 bits", npy("(4294967295, 4294967295, 4294967295, 4294967295)", b"")),
                          ("a side beyond 64 bits", npy("(99999999999999999999999, 3)", b"")), ("a side below 0", npy("(-1, 3)", b"")),
                          ("a header of 64 KiB that is not there", b"\x93NUMPY\x01\0\xff\xff{"), ("a header of 4 GiB", b"\x93NUMPY\x02\0\xff\xff\xff\xff{" + bytes(200)),
                          ("an object, which is a program", npy("(1, 3)", b"cos\nsystem\n(S'touch pwned'\ntR.", "|O"))):
        def make(place, program, content=content):
            pack(also=lambda p: write(p, positions, content))(place, program)
            write(place, "a.npy", content)
        attempt("NPY", what, make, READERS[0], ["compare", "a.npy", "a.npy"], ["scene", "a.npy"], ["diagnose", "planes:count=1", "a.npy"], must_fail=True)
    for shape in ("(0, 8, 4)", "(8, 0, 4)", "(8, 8, 0)", "(0,)", "()", "(65536, 65536, 0)", "(0, 4294967295, 4294967295)"):
        def make(place, program, shape=shape):
            content = npy(shape, b"", "|u1") if shape != "()" else npy(shape, b"\0", "|u1")
            pack(also=lambda p: write(p, "pack/expected/front_to_back/picture.npy", content))(place, program)
            write(place, "a.npy", content)
        attempt("NPY", f"a picture of shape {shape}", make, ["compare", "a.npy", "a.npy"], ["compare", "pack", "pack"], ["diagnose", "pack", "pack"], must_fail=True)

    def sparse(place, program):
        with open(place / "here" / "a.npy", "wb") as file:
            file.write(npy("(16384, 16384, 4)", b"")[:100])
            file.truncate(2**32)
    attempt("NPY", "4 GiB of nothing", sparse, ["compare", "a.npy", "a.npy"], ["scene", "a.npy"], must_fail=True)

    suite = {"format": "strata-suite", "version": 1, "scenes": [{"name": "../../outside/pack"}], "mistakes": [], "equivalent": []}
    for what, value in (("a scene that is a path", suite), ("no list of scenes", {**suite, "scenes": {"a": 1}}), ("a name of a megabyte", {**suite, "scenes": [{"name": LONG}]}),
                        ("escapes for a name", {**suite, "scenes": [{"name": ESCAPES}]})):
        attempt("suite", what, lambda p, _, value=value: write_json(p, "suite/suite.json", value), ["golden", "--check", "suite"], must_fail=True)
    attempt("suite", "arrays without end", lambda p, _: write(p, "suite/suite.json", b"[" * 200000), ["golden", "--check", "suite"], must_fail=True)

    answers = json.dumps({"format": "strata-candidate", "version": 1, "made_by": ESCAPES, "probe": {"kit": ESCAPES}}).encode()
    for what, archive in (("a name that is a path", tar([(b"../outside/victim.png", b"0", b"", b"new", None)])), ("a link", tar([(b"candidate.json", b"2", b"/etc/passwd", b"", None)])),
                          ("a file of 8 GiB", tar([(b"candidate.json", b"0", b"", b"{}", 2**33 - 1)])), ("escapes", tar([(b"candidate.json", b"0", b"", answers, None)])),
                          ("a number for a text", tar([(b"candidate.json", b"0", b"", answers.replace(json.dumps(ESCAPES).encode(), b"1"), None)])),
                          ("nothing", bytes(1024))):
        attempt("answers to a kit", what, lambda p, _, archive=archive: write(p, "answers.tar", archive), ["infer", "answers.tar", "-o", "out.json"], must_fail=True)

    def many(place, program):
        for i in range(8):
            write(place, f"answers/{i}.npy", b"")
            with open(place / "here" / f"answers/{i}.npy", "wb") as file:
                file.truncate(2**28)
        write(place, "answers/candidate.json", answers)
    attempt("answers to a kit", "a folder of 2 GiB of nothing", many, ["infer", "answers", "-o", "out.json"], must_fail=True)
