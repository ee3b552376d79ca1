"""Attacks by a hostile file, by kind of file, each with the commands that a vulnerable program would fail."""
import os
import socket
import struct
import zlib

import attempts_on_packs
from formats import CAMERA, CORNERS, PANES, exr, exr_attribute, glb, gltf, png
from places import (ESCAPES, LONG, LONG_WORD, MARKUP, SIZE, Attempt, link, pipe, write, write_json, write_outside)

ALL = []


def attempt(kind, what, make, *commands, must_fail=False, harmless=False):
    ALL.append(Attempt(kind, what, make, [list(c) for c in commands], must_fail, harmless))


RENDER = ["render", "model.gltf", *SIZE, "-o", "out.png"]


def model(uri=None, also=lambda place: None, **parts):
    def make(place, program):
        write_outside(place)
        write(place, "triangle.bin", CORNERS)
        write(place, "model.gltf", gltf(buffer=uri(place) if callable(uri) else uri, **parts))
        also(place)
    return make


def gltf_attempts():
    attempt("glTF", "none", model(), RENDER, ["scene", "model.gltf"], harmless=True)
    attempt("GLB", "none", lambda p, _: write(p, "model.gltf", glb(gltf(changes=lambda d: d["buffers"][0].pop("uri")), CORNERS)), RENDER, harmless=True)
    for what, uri in (("a buffer in the folder above", "../outside/triangle.bin"),
                      ("the same with escapes", "%2e%2e/outside/triangle.bin"), ("the same behind a folder", "a/../../outside/triangle.bin"),
                      ("a buffer by its whole path", lambda place: f"{place}/outside/triangle.bin"),
                      ("a buffer by file:", lambda place: f"file://{place}/outside/triangle.bin"),
                      ("a zero byte in a uri", "triangle.bin%00"), ("a device for a buffer", "/dev/zero"),
                      ("standard input for a buffer", "/dev/stdin")):
        attempt("glTF", what, model(uri), RENDER, ["scene", "model.gltf"], must_fail=True)
    attempt("glTF", "a link that leaves the folder", model("link.bin", lambda p: link(p, "link.bin", "../outside/triangle.bin")), RENDER,
            must_fail=True)
    attempt("glTF", "a folder that is a link", model("up/triangle.bin", lambda p: link(p, "up", "../outside")), RENDER, must_fail=True)
    attempt("glTF", "a pipe without a writer", model("pipe.bin", lambda p: pipe(p, "pipe.bin")), RENDER, must_fail=True)

    class Network:
        def __init__(self):
            self.server = socket.create_server(("127.0.0.1", 0))
            self.server.setblocking(False)

        def was_asked(self):
            try:
                self.server.accept()
                return True
            except BlockingIOError:
                return False

    def over_network(place, program):
        network = Network()
        model(f"http://127.0.0.1:{network.server.getsockname()[1]}/triangle.bin")(place, program)
        return network
    attempt("glTF", "a buffer from the network", over_network, RENDER, must_fail=True)

    def with_image(uri):
        def change(document):
            document["images"] = [{"uri": uri}]
            document["textures"] = [{"source": 0}]
            document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        return change
    attempt("glTF", "a picture in the folder above", model(changes=with_image("../outside/picture.png")), ["scene", "model.gltf"],
            must_fail=True)
    for what, change in (
            ("two thousand million vertices that no buffer holds", lambda d: d["accessors"][0].update(count=2**31 - 1) or d["accessors"][0].pop("bufferView")),
            ("a buffer of 2^53 bytes", lambda d: d["buffers"][0].update(byteLength=2**53)),
            ("a sparse accessor of 2^31 values", lambda d: d["accessors"][0].update(
                count=2**31 - 1, sparse={"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})),
            ("a node that is its own child", lambda d: d["nodes"][0].update(children=[0])),
            ("a tree of nodes that doubles thirty times", lambda d: d.update(
                nodes=[{"children": [i + 1, i + 1]} for i in range(30)] + [{"mesh": 0}])),
            ("an array in an array, a hundred thousand times", None)):
        def make(place, program, change=change):
            model(changes=change or (lambda d: None))(place, program)
            if change is None:
                write(place, "model.gltf", b'{"asset":' + b"[" * 100000 + b"]" * 100000 + b"}")
        attempt("glTF", what, make, RENDER, must_fail=True)
    document = gltf(changes=lambda d: d["buffers"][0].pop("uri"))
    for what, content in (("a GLB of 4 GiB, it says", glb(document, CORNERS, length=2**32 - 1)),
                          ("a chunk of 4 GiB in a GLB", glb(document, CORNERS, chunk_length=2**32 - 4))):
        attempt("GLB", what, lambda p, _, content=content: write(p, "model.gltf", content), RENDER, must_fail=True)
    side = struct.pack(">IIBBBBB", 65535, 65535, 8, 6, 0, 0, 0)
    bomb = png()[:16] + side + struct.pack(">I", zlib.crc32(b"IHDR" + side)) + png()[33:]
    attempt("glTF", "a picture of 65535x65535", model(changes=with_image("big.png"), also=lambda p: write(p, "big.png", bomb)),
            ["scene", "model.gltf"], must_fail=True)


def name_attempts():
    shown = (["scene", "model.gltf"], ["scene", "model.gltf", "--json"], RENDER, ["render", "model.gltf", *SIZE, "--algorithm", "hybrid", "--sorted", "x"],
             ["explain", "model.gltf", *SIZE, "--pixel", "4,4"], ["explain", "model.gltf", *SIZE, "--pixel", "4,4", "--json"],
             ["explain", "model.gltf", *SIZE, "--pixel", "4,4", "--svg", "out.svg"], ["report", "model.gltf", *SIZE, "-o", "out"],
             ["render", "model.gltf", *SIZE, "--camera", "nobody"], ["passes", "model.gltf", *SIZE, "-o", "out"],
             ["render", "model.gltf", *SIZE, "--stats", "out.json", "--report", "out.html", "-o", "out.png"])
    attempt("glTF", "names with the escapes of a terminal", model(name=ESCAPES), *shown)
    attempt("glTF", "names with markup", model(name=MARKUP), *shown)
    attempt("glTF", "names of a megabyte", model(name=LONG), *shown)
    for what, name in (("escapes", ESCAPES.encode()), ("markup", MARKUP.replace("/", "\u2215").encode()), ("bytes that are no UTF-8", b"\xff\xfe\x80"),
                       ("a command of the shell", b"$(touch pwned) `touch pwned`;touch pwned")):
        def make(place, program, name=name):
            for ending, content in ((b".gltf", gltf()), (b".png", png())):
                with open(os.fsencode(place / "here") + b"/" + name + ending, "wb") as file:
                    file.write(content)
            write(place, "triangle.bin", CORNERS)
        scene, picture = os.fsdecode(name + b".gltf"), os.fsdecode(name + b".png")
        attempt("names of files", what, make, ["scene", scene], ["scene", scene, "--json"], ["render", scene, *SIZE, "-o", "out.png"],
                ["render", scene, *SIZE, "--stats", "out.json", "--report", "out.html", "-o", "out.exr"], ["report", scene, *SIZE, "-o", "out"],
                ["info", "--digests", picture, "none" + picture], ["compare", picture, picture, "--junit", "out.xml"], ["info", picture],
                ["compare", picture, picture, "--json"], ["info", "--digests", "x" + scene], ["explain", scene, *SIZE, "--pixel", "4,4", "--svg", "out.svg"])
    attempt("names of files", "a name of 100,000 bytes", lambda p, _: None, ["scene", LONG_WORD], ["info", "--digests", LONG_WORD + ".png"],
            ["render", "teapot", "--camera", LONG_WORD], ["render", "teapot", "--profile", LONG_WORD], ["compare", LONG_WORD, LONG_WORD], [LONG_WORD],
            ["render", "teapot", "--" + LONG_WORD], ["render", "--from", LONG_WORD + ".png"], ["golden", "--check", LONG_WORD], must_fail=True)


def json_attempts():
    def json_file(content):
        def make(place, program):
            write_outside(place)
            if isinstance(content, bytes):
                write(place, "file.json", content)
            else:
                write_json(place, "file.json", content)
        return make

    def pipe_file(place, program):
        pipe(place, "file.json")
    deep, twice = b"[" * 200000, b'{"near": 1, "near": 2}'
    camera, profile = ["render", "teapot", *SIZE, "--camera", "file.json"], ["render", "teapot", *SIZE, "--profile", "file.json"]
    plan = ["invariance", "--plan", "file.json", "-o", "out"]
    for kind, command in (("camera", camera), ("profile", profile), ("plan", plan), ("triangles", ["scene", "file.json"]),
                          ("baseline of bench", ["bench", "planes:count=1", *SIZE, "--algorithm", "dual", "--repeat", "1", "--baseline", "file.json"])):
        for what, make in (("arrays without end", json_file(deep)), ("a key twice", json_file(twice)), ("a pipe without a writer", pipe_file),
                           ("a megabyte for a number", json_file(b'{"near": ' + b"9" * 10**6 + b"}")),
                           ("a megabyte for a key", json_file({LONG: 1})), ("escapes for a key", json_file({ESCAPES: 1}))):
            attempt(kind, what, make, command, must_fail=True)
        attempt(kind, "a link to a device", lambda p, _: link(p, "file.json", "/dev/zero"), command, must_fail=True)
    for kind, command, content in (("camera", camera, CAMERA), ("triangles", ["scene", "file.json"], PANES),
                                   ("plan", plan, {"grids": [{"scene": "planes:count=1", "size": "8x8"}]})):
        attempt(kind, "none", json_file(content), command, harmless=True)
    for key, value in (("eye", [1e308, 1e308, 1e308]), ("near", 0), ("fovy_degrees", 1e-300), ("up", [0, 0, 0]), ("eye", LONG)):
        attempt("camera", f"{key} {str(value)[:20]}", json_file({**CAMERA, key: value}), camera, must_fail=True)
    attempt("triangles", "an index beyond the positions", json_file({**PANES, "indices": [[0, 1, 4294967295]]}), ["scene", "file.json"], must_fail=True)
    many = [f"bias:{i}" for i in range(1, 400)]
    cells = {"scene": "planes", "remedy": many, "size": [f"{i}x{i}" for i in range(1, 400)], "alpha": [i / 1000 for i in range(1, 400)]}
    attempt("plan", "sixty million cells in a few kilobytes", json_file({"grids": [cells]}), [*plan[:3], "--dry-run"], plan, must_fail=True)
    for what, scene in (("a scene that is a pipe", "pipe.gltf"), ("a scene that is a device", "/dev/zero"), ("a name with escapes for a scene", ESCAPES)):
        def make(place, program, scene=scene):
            pipe(place, "pipe.gltf")
            json_file({"grids": [{"scene": scene, "size": "8x8"}]})(place, program)
        attempt("plan", what, make, plan, must_fail=True)


def sweep_attempts():
    """A folder of results from someone else: what it links to stays as it is."""
    plan = {"grids": [{"scene": "planes:count=2", "size": "8x8", "profile": "geforce3", "algorithm": "shadow_map"}]}

    def folder(fill):
        def make(place, program):
            write_json(place, "plan.json", plan)
            (place / "here" / "sweep").mkdir()
            write_outside(place)
            fill(place)
        return make
    sweep = ["invariance", "--plan", "plan.json", "-o", "sweep"]
    attempt("sweep", "none", folder(lambda place: None), [*sweep[:-1], "out"], harmless=True)
    for what, name, target in (("results that are a link", "results.jsonl", "../../outside/line.txt"),
                               ("a table that is a link", "results.csv", "../../outside/word.txt"),
                               ("timings that are a link", "timings.jsonl", "../../outside/word.txt")):
        attempt("sweep", what, folder(lambda p, name=name, target=target: link(p, "sweep/" + name, target)), sweep, must_fail=True)
    attempt("sweep", "pictures in a folder that is a link", folder(lambda p: link(p, "sweep/images", "../../outside")), sweep, must_fail=True)
    attempt("sweep", "a pipe without a reader", folder(lambda p: pipe(p, "sweep/results.jsonl")), sweep, must_fail=True)


# The command recorded in a picture, used by --from, and the options that it must not choose.
def command_attempts():
    base = f"strata render planes:count=2 {' '.join(SIZE)} "
    for what, words in (("a file of statistics", "--stats victim.json"), ("the same in one word", "--stats=victim.json"), ("a picture", "-o victim.png"),
                        ("a picture outside", "-o ../outside/victim.png"), ("a report", "--report victim.html"), ("a report outside", "--report ../outside/victim.html"),
                        ("a scene outside", None), ("a profile outside", "--profile ../outside/profile.json"),
                        ("a camera outside", "--camera ../outside/camera.json"), ("a thousand threads", "--threads 1024"),
                        ("a limit of memory", "--max-memory 1000G"), ("another picture's command", "--from other.png"),
                        ("an option in the place of a value", "--alpha --stats=victim.json"), ("words of a shell", "; touch pwned"),
                        ("words for a shell", "$(touch pwned)"), ("an option that is none", "--exec=pwned"), ("help", "--help"), ("a further name", "victim.png")):
        command = base.replace("planes:count=2", "../outside/panes.json") if words is None else base + words

        def make(place, program, command=command):
            write_outside(place)
            for name in ("victim.json", "victim.png", "victim.html"):
                write(place, name, b"old")
            write(place, "picture.png", png(8, 8, [("strata:command", command.encode())]))
            write(place, "picture.exr", exr(exr_attribute(b"strata:command", b"string", command.encode())))
        attempt("command in a picture", what, make, ["render", "--from", "picture.png"], ["render", "--from", "picture.png", "-o", "out.png"],
                ["render", "--from", "picture.exr", "-o", "out.exr"], must_fail=True)
    attempt("command in a picture", "none", lambda p, _: (write(p, "picture.png", png(8, 8, [("strata:command", (base + "--alpha 0.5").encode())])),
                                                          write(p, "picture.exr", exr(exr_attribute(b"strata:command", b"string", base.encode())))),
            ["render", "--from", "picture.png", "-o", "out.png"], ["render", "--from", "picture.exr", "-o", "out.exr"], harmless=True)
    for what, command in (("a megabyte of it", "strata render " + LONG), ("escapes in it", f"strata render '{ESCAPES}'")):
        attempt("command in a picture", what, lambda p, _, c=command: write(p, "picture.png", png(8, 8, [("strata:command", c.encode())])),
                ["render", "--from", "picture.png", "-o", "out.png"], must_fail=True)
    texts = [("strata:command", f"strata render {ESCAPES}".encode()), ("strata:" + ESCAPES, b"x"), ("strata:note", b"\xff\x1b[2J")]
    attempt("command in a picture", "escapes, shown by info", lambda p, _: write(p, "picture.png", png(8, 8, texts)), ["info", "picture.png"],
            ["info", "picture.png", "--json"])


def picture_attempts():
    def file(name, content):
        return lambda place, _: write(place, name, content)
    attempt("EXR", "none", file("a.exr", exr()), ["compare", "a.exr", "a.exr"], harmless=True)
    attempt("PNG", "none", file("a.png", png(8, 8)), ["info", "--digests", "a.png"], ["compare", "a.png", "a.png"], harmless=True)
    for kind in (b"string", b"stringvector", b"floatvector", b"preview", b"bytes", b"unknown"):
        for size in (2**31 - 1, -5):
            attempt("EXR", f"an attribute {kind.decode()} of {size} bytes", file("a.exr", exr(exr_attribute(b"big", kind, b"abcd" * 4, size))),
                    ["info", "--digests", "a.exr"], ["compare", "a.exr", "a.exr"], ["info", "a.exr"], must_fail=True)
    for what, content in (("a row of 2^31 pixels", exr(window=(0, 0, 2**31 - 2, 0))), ("corners that cross", exr(window=(5, 5, -5, -5))),
                          ("a picture without its pixels", exr(window=(0, 0, 16383, 16383))),
                          ("tiles of one pixel", exr(exr_attribute(b"tiles", b"tiledesc", struct.pack("<IIB", 1, 1, 0)), (0, 0, 16383, 16383), 2 | 0x200)),
                          ("2^31 chunks", exr(exr_attribute(b"chunkCount", b"int", struct.pack("<i", 2**31 - 1)) +
                                              exr_attribute(b"type", b"string", b"scanlineimage") + exr_attribute(b"name", b"string", b"n"), version=2 | 0x1000, end=b"\0"))):
        attempt("EXR", what, file("a.exr", content), ["info", "--digests", "a.exr"], ["compare", "a.exr", "a.exr"], ["diagnose", "planes:count=1", "a.exr"], must_fail=True)
    hostile = exr(exr_attribute(b"name", b"string", MARKUP.encode()), channels=(ESCAPES.encode()[:30], MARKUP.encode()[:30]))
    attempt("EXR", "names of channels and parts with escapes and markup", file("a.exr", hostile), ["info", "--digests", "a.exr"], ["digest", "a.exr", "--channels"],
            ["compare", "a.exr", "a.exr"], ["compare", "a.exr", "a.exr", "--json"], ["compare", "a.exr", "a.exr", "--junit", "out.xml", "--report", "out.html"])
    lie = bytearray(png(8, 8))
    lie[33:37] = struct.pack(">I", 2**31 - 1)
    header = struct.pack(">IIBBBBB", 16384, 16384, 16, 6, 0, 0, 0)
    short = png(data=b"")[:16] + header + struct.pack(">I", zlib.crc32(b"IHDR" + header)) + png(data=b"")[33:]
    for what, content in (("a chunk of 2 GiB in a PNG", bytes(lie)), ("the pixels of another size", png(8, 8, data=bytes(10))),
                          ("16384x16384 of 16 bits, without pixels", short)):
        attempt("PNG", what, file("a.png", content), ["info", "--digests", "a.png"], ["compare", "a.png", "a.png"], must_fail=True)
    profile = b"\0\0" + zlib.compress(bytes(200 * 2**20))
    chunk = struct.pack(">I", len(profile) + 1) + b"iCCP" + b"p" + profile + struct.pack(">I", zlib.crc32(b"iCCPp" + profile))
    attempt("PNG", "a colour profile that unpacks to 200 MB", file("a.png", png(8, 8, chunks=chunk)), ["info", "--digests", "a.png"], ["compare", "a.png", "a.png"])


gltf_attempts()
name_attempts()
json_attempts()
sweep_attempts()
command_attempts()
picture_attempts()
attempts_on_packs.add_to(attempt)
