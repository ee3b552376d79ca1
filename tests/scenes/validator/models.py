"""Sound glTF files, and malformed ones made of them by one change each."""
import base64
import copy
import json
import random
import struct
import zlib


def data_uri(data, kind="application/octet-stream"):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


def png():
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + bytes(range(8 * y, 8 * y + 8)) for y in range(2))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 6, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Document:
    """A glTF file whose buffer grows by what is put into it."""

    def __init__(self):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                     "bufferViews": [], "accessors": []}

    def view(self, data, **more):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data), **more})
        self.bytes += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, code, component, kind, numbers, target=34962, **more):
        view = self.view(struct.pack(f"<{len(numbers)}{code}", *numbers), target=target)
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        accessor = {"bufferView": view, "componentType": component, "count": len(numbers) // width, "type": kind, **more}
        if kind == "VEC3":
            accessor["min"] = [min(numbers[i::3]) for i in range(3)]
            accessor["max"] = [max(numbers[i::3]) for i in range(3)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def finished(self):
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": data_uri(self.bytes)}]
        return self.json


CORNERS = [0.0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]


def triangle():
    file = Document()
    file.json["meshes"] = [{"primitives": [{"attributes": {"POSITION": file.accessor("f", 5126, "VEC3", CORNERS[:9])}}]}]
    return file.finished()


def everything():
    file = Document()
    position = file.accessor("f", 5126, "VEC3", CORNERS)
    normal = file.accessor("f", 5126, "VEC3", [0.0, 0, 1] * 4)
    texcoord = file.accessor("f", 5126, "VEC2", [0.0, 0, 1, 0, 0, 1, 1, 1])
    color = file.accessor("B", 5121, "VEC4", [255, 0, 0, 128] * 4, normalized=True)
    indices = file.accessor("H", 5123, "SCALAR", [0, 1, 2, 2, 1, 3], target=34963)
    sparse = {"componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0], "sparse": {
        "count": 4, "indices": {"bufferView": file.view(bytes(range(4))), "componentType": 5121},
        "values": {"bufferView": file.view(struct.pack("<12f", *CORNERS))}}}
    file.json["accessors"].append(sparse)
    image = file.view(png())
    file.json.update({
        "extensionsUsed": ["KHR_materials_unlit", "KHR_texture_transform"],
        "images": [{"bufferView": image, "mimeType": "image/png"}, {"uri": data_uri(png(), "image/png")}],
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 33071}],
        "textures": [{"source": 0, "sampler": 0}, {"source": 1}],
        "materials": [{"name": "glass", "alphaMode": "BLEND", "doubleSided": True, "pbrMetallicRoughness": {
            "baseColorFactor": [1, 0.5, 0.25, 0.5], "metallicFactor": 0, "roughnessFactor": 1,
            "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, -1]}}}}},
            {"alphaMode": "MASK", "alphaCutoff": 0.25, "extensions": {"KHR_materials_unlit": {}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10, "aspectRatio": 1.5}},
                    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 10}}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": position, "NORMAL": normal, "TEXCOORD_0": texcoord, "COLOR_0": color}, "indices": indices, "material": 0, "mode": 4},
            {"attributes": {"POSITION": len(file.json["accessors"]) - 1}, "material": 1, "mode": 5}]}],
        "nodes": [{"mesh": 0, "children": [1, 2, 3]}, {"translation": [0, 1, 2], "rotation": [0, 0, 0, 1], "scale": [1, 2, 1], "camera": 0},
                  {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "mesh": 0}, {"camera": 1}]})
    return file.finished()


def pointers(value, here=()):
    yield here
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from pointers(inner, here + (key,))


OTHERS = [None, True, -1, 0, 3, 4, 1 << 30, 0.5, -0.25, 1e300, "", "x", "../a.bin", "data:,x", [], {}, [0], [0, 0], [-1, 5], {"x": 1}]


def changed(document, pointer, value, how):
    """A copy in which the value at the pointer is another, gone, or there twice."""
    document = copy.deepcopy(document)
    place = document
    for key in pointer[:-1]:
        place = place[key]
    if how == "gone":
        del place[pointer[-1]]
    elif how == "more":
        place[pointer[-1]] = place[pointer[-1]] * 2
    else:
        place[pointer[-1]] = value
    return document


def as_glb(document, binary=b"", magic=b"glTF", version=2, length=None, pad=b" ", chunk=b"JSON"):
    text = json.dumps(document).encode()
    text += pad * (-len(text) % 4)
    body = struct.pack("<I", len(text)) + chunk + text
    if binary:
        body += struct.pack("<I", len(binary)) + b"BIN\0" + binary
    return magic + struct.pack("<II", version, 12 + len(body) if length is None else length) + body


def glb_files():
    good = as_glb(triangle())
    yield "good", good
    for size in (0, 3, 4, 11, 12, 15, 19, 20, 40, len(good) - 4, len(good) - 1):
        yield f"cut-{size}", good[:size]
    yield "magic", as_glb(triangle(), magic=b"glTG")
    yield "version", as_glb(triangle(), version=1)
    yield "longer", as_glb(triangle(), length=1 << 20)
    yield "shorter", as_glb(triangle(), length=16)
    yield "no-json-first", as_glb(triangle(), chunk=b"BIN\0")
    yield "unknown-first", as_glb(triangle(), chunk=b"ABCD")
    yield "behind", good + b"more"
    yield "two-json", good[:8] + struct.pack("<I", 2 * len(good) - 12) + good[12:] + good[12:]
    yield "empty-chunk", good[:8] + struct.pack("<I", len(good) + 8) + good[12:] + struct.pack("<I", 0) + b"BIN\0"
    odd = as_glb(triangle())
    yield "chunk-length", odd[:12] + struct.pack("<I", len(odd) - 19) + odd[16:]


def malformed(count, seed, targeted):
    """(name, bytes): `count` changes drawn by the seed, all of the containers, and those that ask for a code by its name."""
    dice = random.Random(seed)
    bases = {"triangle": triangle(), "everything": everything()}
    for name, document in bases.items():
        yield f"{name}.gltf", json.dumps(document).encode()
    all_changes = []
    for name, document in bases.items():
        for pointer in pointers(document):
            if not pointer:
                continue
            all_changes.append((name, pointer, None, "gone"))
            all_changes += [(name, pointer, value, "other") for value in OTHERS]
            all_changes += [(name, pointer, None, "more")]
    drawn = 0
    for name, pointer, value, how in dice.sample(all_changes, len(all_changes)):
        try:
            text = json.dumps(changed(bases[name], pointer, value, how))
        except TypeError:
            continue  # a number cannot be there twice
        yield f"{name}.{'.'.join(map(str, pointer))}.{how}-{drawn}.gltf", text.encode()
        drawn += 1
        if drawn == count:
            break
    for name, data in glb_files():
        yield f"{name}.glb", data
    for name, data in targeted:
        yield name, data
