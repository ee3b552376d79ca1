"""Reads and writes pictures of drivers: PNG for 8 bits, NPY for all others. The top row is first."""
import array
import pathlib
import struct
import zlib

PNG_COLORS = {1: 0, 3: 2, 4: 6}
NPY_CODES = {"u1": "|u1", "f4": "<f4"}


def without_alpha(data):
    """R, G and B of bytes R G B A."""
    kept = bytearray(len(data) // 4 * 3)
    for c in range(3):
        kept[c::3] = data[c::4]
    return bytes(kept)


def png(data, width, height, channels):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = b"".join(b"\0" + data[y * width * channels:(y + 1) * width * channels] for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, PNG_COLORS[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def npy(data, width, height, channels, element):
    """NPY 1.0 with a header of 128 bytes, as in packs."""
    shape = f"({height}, {width})" if channels == 1 else f"({height}, {width}, {channels})"
    head = f"{{'descr': '{NPY_CODES[element]}', 'fortran_order': False, 'shape': {shape}, }}"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + head.ljust(117).encode() + b"\n" + data


def read(path):
    """Rows of pixels (R, G, B), 0 to 1, of a picture that `write` wrote."""
    data = pathlib.Path(path).read_bytes()
    if data[:6] == b"\x93NUMPY":
        height, width, channels = map(int, data[10:128].decode().split("'shape': (")[1].split(")")[0].split(","))
        values = array.array("f", data[128:])
    else:
        width, height, color = struct.unpack(">II", data[16:24]) + (data[25],)
        channels = {kind: n for n, kind in PNG_COLORS.items()}[color]
        length, = struct.unpack(">I", data[33:37])
        body, row = zlib.decompress(data[41:41 + length]), 1 + width * channels
        values = [code / 255 for y in range(height) for code in body[y * row + 1:(y + 1) * row]]
    pixel = lambda i: tuple(values[i * channels:i * channels + 3])
    return [[pixel(y * width + x) for x in range(width)] for y in range(height)]


def write(path, data, width, height, channels, element):
    """The ending of the path selects the format; ValueError if it cannot represent the numbers."""
    path = pathlib.Path(path)
    if path.suffix == ".npy":
        made = npy(data, width, height, channels, element)
    elif path.suffix == ".png" and element == "u1":
        made = png(data, width, height, channels)
    else:
        raise ValueError(f"{path}: expected a file that ends in {'.png or .npy' if element == 'u1' else '.npy, for the picture has floats'}")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(made)
