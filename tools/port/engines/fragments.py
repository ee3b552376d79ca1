"""The fragments of every pixel of a pack's frame, computed without Strata from clip-space vertices, in binary64.

Colours are interpolated as stored (encoded), or in linear light, like in an engine that treats colours of corners as linear.
A pixel is used only if it is not near a tie of rasterization: its centre is at least MARGIN pixels from every edge, and no two fragments'
depths are nearer than NEAR unless they are those of surfaces parallel to the picture, which are compared exactly.
"""
import dataclasses

import numpy

MARGIN = 0.2
NEAR = 1e-6


@dataclasses.dataclass(frozen=True)
class Fragment:
    z: float  # window depth, 0 to 1
    color: tuple  # straight r g b a
    object: int
    is_front: bool
    opaque: bool
    triangle: int  # in submission order of its list
    exact: bool  # parallel to the picture


class Undecided(Exception):
    """The pixel is near a tie."""


def decoded(colors):
    """Converts sRGB to linear light; alpha is unchanged."""
    rgb = numpy.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    return numpy.concatenate([rgb[..., :3], colors[..., 3:]], -1)


def encoded(colors):
    rgb = numpy.where(colors <= 0.0031308, colors * 12.92, 1.055 * numpy.maximum(colors, 0) ** (1 / 2.4) - 0.055)
    return numpy.concatenate([rgb[..., :3], colors[..., 3:]], -1)


class Triangle:
    """One triangle in window coordinates: x to the right, y down, pixel centres at halves."""
    def __init__(self, clip, colors, width, height, mixes_light, **of):
        w = clip[:, 3]
        if (w <= 0).any():
            raise ValueError("expected triangles before the eye")
        ndc = clip[:, :3] / w[:, None]
        self.x, self.y = (ndc[:, 0] + 1) / 2 * width, (1 - ndc[:, 1]) / 2 * height
        self.z, self.q, self.colors, self.mixes_light, self.of = (ndc[:, 2] + 1) / 2, 1 / w, colors, mixes_light, of
        self.area = self.cross(self.x[2], self.y[2])[2]
        self.sides = numpy.hypot(numpy.roll(self.x, -1) - self.x, numpy.roll(self.y, -1) - self.y)

    def cross(self, px, py):
        """Twice the signed areas of (corner k, corner k + 1, point), beginning with k = 1: weights of corners 0, 1, 2."""
        a = [(self.x[j] - self.x[i]) * (py - self.y[i]) - (self.y[j] - self.y[i]) * (px - self.x[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
        return a

    def box(self, width, height):
        """The pixels that it may touch, with the margin."""
        low = [max(int(numpy.floor(v.min() - 1)), 0) for v in (self.x, self.y)]
        high = [min(int(numpy.ceil(v.max() + 1)), n) for v, n in ((self.x, width), (self.y, height))]
        return range(low[0], high[0]), range(low[1], high[1])

    def at(self, px, py):
        """The fragment at a point; None outside; Undecided near an edge."""
        if self.area == 0:
            return None
        sign = 1 if self.area > 0 else -1
        distances = [sign * e / side for e, side in zip(self.cross(px, py), self.sides[[1, 2, 0]])]
        if min(distances) < -MARGIN:
            return None
        if min(distances) < MARGIN:
            raise Undecided
        weights = numpy.array(self.cross(px, py)) / self.area
        exact = self.z[0] == self.z[1] == self.z[2]
        return Fragment(float(self.z[0]) if exact else float((weights * self.z).sum()), self.color_at(weights * self.q),
                        is_front=sign < 0, exact=bool(exact), **self.of)  # y points down here

    def color_at(self, weights):
        """Interpolates with perspective; a triangle of one colour has exactly that colour."""
        if (self.colors == self.colors[0]).all():
            return tuple(map(float, self.colors[0]))
        mix = lambda colors: (weights[:, None] * colors).sum(0) / weights.sum()
        return tuple(map(float, encoded(mix(decoded(self.colors))) if self.mixes_light else mix(self.colors)))


def check_depths(pixel):
    order = sorted(pixel, key=lambda f: f.z)
    for a, b in zip(order, order[1:]):
        if b.z - a.z < NEAR and not (a.exact and b.exact):
            raise Undecided


def pixels_of(scene, mixes_light=False):
    """Rows of pixels: a pixel is a tuple of its fragments in submission order, the opaque ones first; None where it is undecided."""
    width, height = scene.width, scene.height
    found = [[[] for _ in range(width)] for _ in range(height)]
    project = numpy.array(scene.projection).reshape(4, 4).T @ numpy.array(scene.view).reshape(4, 4).T
    for number, mesh in enumerate(scene.meshes):
        points = numpy.array(mesh.positions, float).reshape(-1, 3)
        clip = numpy.c_[points, numpy.ones(len(points))] @ (project @ numpy.array(mesh.model).reshape(4, 4).T).T
        colors = numpy.array(mesh.colors, float).reshape(-1, 4)
        for t, corners in enumerate(numpy.array(mesh.triangles).reshape(-1, 3)):
            triangle = Triangle(clip[corners], colors[corners], width, height, mixes_light, object=number, opaque=mesh.opaque, triangle=t)
            columns, rows = triangle.box(width, height)
            for y in rows:
                for x in columns:
                    add(found[y], x, triangle, y)
    return [[decided(pixel) for pixel in row] for row in found]


def add(row, x, triangle, y):
    if row[x] is None:
        return
    try:
        fragment = triangle.at(x + 0.5, y + 0.5)
    except Undecided:
        row[x] = None
        return
    if fragment:
        row[x].append(fragment)


def decided(pixel):
    if pixel is None:
        return None
    try:
        check_depths(pixel)
    except Undecided:
        return None
    return tuple(pixel)
