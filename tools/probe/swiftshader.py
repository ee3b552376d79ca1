#!/usr/bin/env python3
"""SwiftShader's planes, held against what a browser drew: swiftshader.py KIT ANSWERS.tar

A model of its own, in binary32, of depths and colours of triangles that lie within the view volume (SwiftShader's Pipeline/SetupRoutine.cpp,
VertexRoutine.cpp and PixelRoutine.cpp). Corners snap to sixteenths of a pixel, halves to even. The planes start at the corner of the greatest w, of the
least y among equals. A depth is stored as binary32 in D24, too. Prints how many of the covered pixels the model has to the bit; exit status 1
if it misses one.
"""
import json
import struct
import sys
import tarfile

SCENES = ["depth.d32f", "depth.d32f-again", "depth.d24", "depth.d24-again", "color.perspective-float"]


def f32(value):
    """A double rounded to binary32: of one sum, product or quotient of two binary32 the only rounding that shows."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def plus(*terms):
    total = terms[0]
    for term in terms[1:]:
        total = f32(total + term)
    return total


def times(*factors):
    product = factors[0]
    for factor in factors[1:]:
        product = f32(product * factor)
    return product


def floats(digits):
    return struct.unpack(f"<{len(digits) // 8}f", struct.pack(f"<{len(digits) // 8}I", *(int(digits[i:i + 8], 16) for i in range(0, len(digits), 8))))


class Corner:
    def __init__(self, numbers, size):
        self.x, self.y, self.z, self.w = numbers[:4]
        self.color = numbers[4:]
        self.over_w = f32(1 / self.w)
        # Half a pixel less, so that a pixel's centre is a whole number of sixteenths times 16.
        self.at = [round(plus(side * 8 - 8, times(place, self.over_w, side * 8))) for place, side in zip((self.x, self.y), size)]
        self.depth = times(self.z, self.over_w)  # from -1 to 1


def from_greatest_w(corners):
    """The corners turned round; each step looks at the order before it."""
    for key, best in ((lambda c: c.y, min), (lambda c: c.w, max)):
        values = [key(c) for c in corners]
        if best(values) == values[1]:
            corners = corners[1:] + corners[:1]
        if best(values) == values[2]:
            corners = corners[2:] + corners[:2]
    return corners


class Triangle:
    def __init__(self, corners):
        self.corners = c = from_greatest_w(corners)
        (x1, y1), (x2, y2) = ([(k.at[i] - c[0].at[i]) / 16 for i in (0, 1)] for k in c[1:])
        self.area = x1 * y2 - x2 * y1  # exact; its sign is the turn
        if self.area == 0:
            return
        z1, z2 = plus(c[1].depth, -c[0].depth), plus(c[2].depth, -c[0].depth)
        scale = f32(0.5 / f32(f32(x1 * y2) - f32(x2 * y1)))
        self.depth = (times(plus(times(y2, z1), -times(y1, z2)), scale), times(plus(times(x1, z2), -times(x2, z1)), scale),
                      plus(times(c[0].depth, 0.5), 0.5))
        w1, w2 = c[1].w, c[2].w
        x1, y1, x2, y2 = times(w1, x1), times(w1, y1), times(w2, x2), times(w2, y2)
        part = f32(1 / f32(f32(x1 * y2) - f32(x2 * y1)))
        own = times(part, c[0].over_w)
        self.slopes = ((times(plus(times(y1, w2), -times(y2, w1)), own), times(y2, part), times(-y1, part)),
                       (times(plus(times(x2, w1), -times(x1, w2)), own), times(-x2, part), times(x1, part)))

    def covers(self, x, y):
        places = [k.at for k in self.corners]
        edges = [(b[0] - a[0]) * (16 * y - a[1]) - (b[1] - a[1]) * (16 * x - a[0]) for a, b in zip(places, places[1:] + places[:1])]
        return min(edges) >= 0 if self.area > 0 else max(edges) <= 0

    def value(self, plane, x, y):
        a, b, c = plane
        at = [p - q / 16 for p, q in zip((x, y), self.corners[0].at)]
        return plus(c, times(at[1], b), times(at[0], a))

    def values(self, numbers, x, y):
        """A number a corner, over w."""
        a, b = (plus(*(times(n, s) for n, s in zip(numbers, slope))) for slope in self.slopes)
        return self.value((a, b, times(numbers[0], self.corners[0].over_w)), x, y)

    def color(self, x, y):
        w = f32(1 / self.values((1.0, 1.0, 1.0), x, y))
        return tuple(times(self.values([k.color[i] for k in self.corners], x, y), w) for i in range(4))


def compared(item, drawn):
    """How many covered pixels the model has to the bit, and of how many. `drawn`: the bytes of the target."""
    size, is_color = item["size"], item["name"].startswith("color.")
    numbers = [n for draw in item["draws"] for n in floats(draw["corners"])]
    corners = [Corner(numbers[i:i + 8], size) for i in range(0, len(numbers), 8)]
    triangles = [t for t in (Triangle(corners[i:i + 3]) for i in range(0, len(corners), 3)) if t.area != 0]
    equal = covered = 0
    for y in range(size[1]):
        for x in range(size[0]):
            last = next((t for t in reversed(triangles) if t.covers(x, y)), None)
            if last is None:
                continue
            covered += 1
            at = y * size[0] + x
            found = last.color(x, y) if is_color else (min(max(last.value(last.depth, x, y), 0.0), 1.0),)
            equal += struct.pack(f"<{len(found)}f", *found) == drawn[len(found) * 4 * at:len(found) * 4 * (at + 1)]
    return equal, covered


def model(kit_file, archive):
    """For each scene: its name, how many pixels are equal, and of how many."""
    with open(kit_file, encoding="utf-8") as file:
        items = {item["name"]: item for item in json.load(file)["items"]}
    rows = []
    with tarfile.open(archive) as tar:
        for name in SCENES:
            target = "color" if name.startswith("color.") else "depth"
            data = tar.extractfile(f"probe/down/{name}/{target}.npy").read()
            rows.append((name, *compared(items[name], data[data.index(b"\n") + 1:])))
    return rows


def main():
    rows = model(*sys.argv[1:3])
    for name, equal, covered in rows:
        print(f"{name}: {equal:,} of {covered:,} pixels")
    return 0 if all(equal == covered for _, equal, covered in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
