"""Writes small files of every format that the program reads, from the formats' specifications."""
import json
import struct
import zlib


def png(width=1, height=1, texts=(), data=None, chunks=b""):
    """An 8-bit RGBA PNG, black unless `data` has the rows with their filter bytes; `texts` are pairs for tEXt chunks."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    rows = bytes((1 + 4 * width) * height) if data is None else data
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
            b"".join(chunk(b"tEXt", key.encode() + b"\0" + value) for key, value in texts) + chunks +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def exr_attribute(name, kind, content, size=None):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(content) if size is None else size) + content


def exr(further=b"", window=(0, 0, 0, 0), version=2, channels=(b"A", b"B", b"G", b"R"), end=b""):
    """An EXR file with one row of binary32 zeros, uncompressed."""
    listed = b"".join(c + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for c in channels) + b"\0"
    header = struct.pack("<II", 20000630, version)
    for name, kind, content in ((b"channels", b"chlist", listed), (b"compression", b"compression", b"\0"),
                                (b"dataWindow", b"box2i", struct.pack("<iiii", *window)),
                                (b"displayWindow", b"box2i", struct.pack("<iiii", *window)), (b"lineOrder", b"lineOrder", b"\0"),
                                (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
                                (b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)),
                                (b"screenWindowWidth", b"float", struct.pack("<f", 1))):
        header += exr_attribute(name, kind, content)
    header += further + b"\0" + end
    row = bytes(4 * len(channels))
    return header + struct.pack("<Q", len(header) + 8) + struct.pack("<ii", 0, len(row)) + row


def npy(shape, data, descr="<f4", header=None):
    text = header or f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}"
    text = text.encode() + b" " * (117 - len(text)) + b"\n"
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(text)) + text + data


CORNERS = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)


def gltf(name="scene", buffer=None, changes=lambda document: None):
    """A glTF file with one triangle; `buffer` is its uri."""
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0], "name": name}],
        "nodes": [{"mesh": 0, "name": name}, {"camera": 0, "name": name}],
        "cameras": [{"type": "perspective", "name": name, "perspective": {"yfov": 0.6, "znear": 1, "zfar": 9}}],
        "materials": [{"name": name, "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}],
        "meshes": [{"name": name, "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": buffer or "triangle.bin"}],
    }
    changes(document)
    return json.dumps(document).encode()


def glb(document, binary=b"", length=None, chunk_length=None):
    document += b" " * (-len(document) % 4)
    content = struct.pack("<II", chunk_length or len(document), 0x4E4F534A) + document
    if binary:
        content += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<III", 0x46546C67, 2, length or 12 + len(content)) + content


def tar(entries):
    """A ustar archive of (name, kind, link, content)."""
    archive = b""
    for name, kind, link, content, size in entries:
        header = bytearray(512)
        for at, field in ((0, name), (100, b"0000644\0"), (124, b"%011o\0" % (len(content) if size is None else size)), (156, kind),
                          (157, link), (257, b"ustar\00000")):
            header[at:at + len(field)] = field
        header[148:156] = b" " * 8
        header[148:156] = b"%06o\0 " % sum(header)
        archive += bytes(header) + content + bytes(-len(content) % 512)
    return archive + bytes(1024)


CAMERA = {"eye": [0, 0, 5], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 33, "near": 2, "far": 20}
PANES = {"positions": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]}
