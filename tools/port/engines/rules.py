"""The colour that each engine computes from a pixel's fragments, written from its source (lines: tools/docs/engines.md). In binary64, without
formats.

A rule takes a frame of pixels (fragments.py) and a background, and returns rows of R G B; an undecided pixel, None, stays None. The right picture is
`exact`: all visible fragments, nearest first, each once. Fragments of equal depth are composited in either order, and
a fragment on the opaque surface is hidden by it (LESS, as in the papers).
"""
import dataclasses
import functools
import itertools

import numpy

FLOAT = numpy.float32
EPSILON = FLOAT(1e-7)  # vtkDualDepthPeelingPass.cxx:264, vtkDepthPeelingPass.cxx:675


def distance(a, b):
    """The distance of two colours, in codes of 8 bits."""
    return 255 * max(abs(x - y) for x, y in zip(a, b))


def over(color, behind):
    *rgb, a = color
    return tuple(a * c + (1 - a) * b for c, b in zip(rgb, behind))


def opaque_of(pixel, background):
    """Depth and colour of the opaque surface; infinity and the background if there is none."""
    nearest = min((f for f in pixel if f.opaque), key=lambda f: f.z, default=None)
    return (nearest.z, nearest.color[:3]) if nearest else (float("inf"), tuple(background))


def blended_of(pixel):
    return [f for f in pixel if not f.opaque]


def a_pixel(rule):
    """Makes a rule of the frame from a rule of one pixel: (pixel, background) -> R G B. Equal pixels are computed once."""
    def of_frame(frame, background):
        kept = functools.lru_cache(maxsize=None)(lambda pixel: rule(pixel, background))
        return [[None if pixel is None else kept(pixel) for pixel in row] for row in frame]
    return of_frame


# --- what is right

def exact(pixel, background):
    """All right colours: one, or several if depths are equal."""
    z, behind = opaque_of(pixel, background)
    visible = sorted((f for f in blended_of(pixel) if f.z < z), key=lambda f: -f.z)
    groups = [list(group) for _, group in itertools.groupby(visible, key=lambda f: f.z)]
    colors = {behind}
    for group in groups:
        colors = {functools.reduce(lambda b, f: over(f.color, b), order, c) for c in colors for order in itertools.permutations(group)}
    return colors


# --- three.js, and the others without an order of their own

def submitted(pixel, background, writes_depth, sort=None, is_less=False):
    """Object by object, the back faces of each first (or all faces in submission order), tested against the opaque surface."""
    depth, color = opaque_of(pixel, background)
    for f in sorted(blended_of(pixel), key=sort) if sort else blended_of(pixel):
        if f.z > depth or (is_less and f.z == depth):
            continue
        color = over(f.color, color)
        if writes_depth:
            depth = f.z
    return color


def three(scene, writes_depth):
    """WebGLRenderLists.js:31: by the depth of the object's origin, far first; WebGLRenderer.js:2178: back faces, then front faces."""
    forward = numpy.array(scene.projection).reshape(4, 4).T @ numpy.array(scene.view).reshape(4, 4).T
    def depth_of(mesh):
        clip = forward @ numpy.array(mesh.model)[12:16]
        return clip[2] / clip[3]
    depths = [depth_of(mesh) for mesh in scene.meshes]
    key = lambda f: (-depths[f.object], f.object, f.is_front, f.triangle)
    return a_pixel(lambda pixel, background: submitted(pixel, background, writes_depth, key))


def babylon_blended(scene):
    """renderingGroup.js:191: by the distance of the bounding sphere's centre, far first; no depth is written (engine.alpha.pure.js:28)."""
    eye = numpy.linalg.inv(numpy.array(scene.view).reshape(4, 4).T)[:3, 3]
    def distance(mesh):
        points = numpy.array(mesh.positions, float).reshape(-1, 3)
        center = numpy.array([*((points.min(0) + points.max(0)) / 2), 1])
        return numpy.linalg.norm((numpy.array(mesh.model).reshape(4, 4).T @ center)[:3] - eye)
    distances = [distance(mesh) for mesh in scene.meshes]
    key = lambda f: (-distances[f.object], f.object, f.triangle)
    return a_pixel(lambda pixel, background: submitted(pixel, background, False, key))


def molstar_blended(_):
    """renderer.js:572: object by object, back faces first; WebGL's LESS, no depth is written."""
    key = lambda f: (f.object, f.is_front, f.triangle)
    return a_pixel(lambda pixel, background: submitted(molstar_lists(pixel), background, False, key, is_less=True))


# --- dual depth peeling as in webgl2examples, which Babylon and Mol* took up

def dual(pixel, background, peels, is_visible, blends_back=True):
    """MAX of the front colours that the fragments at the near end give, MAX of the straight colours at the far end."""
    fragments = blended_of(pixel)
    z, back = opaque_of(pixel, background)
    waiting = [f.z for f in fragments if is_visible(f.z, z)]
    front = (0.0,) * 4
    for _ in range(peels):
        if not waiting:
            break
        near, far, waiting = min(waiting), max(waiting), []
        drawn, layer = [front], (0.0,) * 4
        for f in fragments:
            if near < f.z < far:
                waiting.append(f.z)
            elif f.z == near:
                drawn.append(under(front, f.color))
            elif f.z == far:
                layer = tuple(map(max, layer, f.color))
        front = tuple(map(max, *drawn)) if len(drawn) > 1 else front
        back = over(layer, back) if blends_back else back
    return tuple(c + (1 - front[3]) * b for c, b in zip(front[:3], back))


def under(front, color):
    """A straight colour blended under a premultiplied one; alpha is the coverage of the front."""
    open_ = 1 - front[3]
    return (*(c + s * color[3] * open_ for c, s in zip(front[:3], color[:3])), 1 - open_ * (1 - color[3]))


def babylon_oit(peels):
    """thinDepthPeelingRenderer.pure.js; LEQUAL against the opaque surface, in the first pass."""
    return a_pixel(lambda pixel, background: dual(pixel, background, peels, lambda z, opaque: z <= opaque))


def molstar_lists(pixel):
    """renderer.js:368 and 379: alpha 1 is opaque, alpha 0 is not drawn."""
    return tuple(dataclasses.replace(f, opaque=f.color[3] == 1) for f in pixel if f.color[3] != 0)


def molstar_dpoit(peels):
    """dpoit.js, dpoit-write.glsl.js; LESS against the opaque surface; with one iteration the back is not blended (draw.js:148)."""
    return a_pixel(lambda pixel, background: dual(molstar_lists(pixel), background, peels, lambda z, opaque: z < opaque, peels > 1))


# --- sums without an order

def weighted(pixel, background, weight, is_visible):
    """The weighted sum of colours divided by the sum of weights, with the transmittance of all fragments."""
    z, behind = opaque_of(pixel, background)
    visible = [f for f in blended_of(pixel) if is_visible(f.z, z)]
    if not visible:
        return behind
    weights = [weight(f) for f in visible]
    through = numpy.prod([1 - f.color[3] for f in visible])
    total = sum(weights)
    color = [sum(w * f.color[k] for w, f in zip(weights, visible)) / total if total else 0.0 for k in range(3)]
    return over((*color, 1 - through), behind)


def molstar_wboit():
    """wboit-write.glsl.js:19: weight alpha^2 max(0.01, (1 - z)^2)."""
    weight = lambda f: f.color[3] ** 2 * min(max((1 - f.z) ** 2, 0.01), 1.0)
    return a_pixel(lambda pixel, background: weighted(molstar_lists(pixel), background, weight, lambda z, opaque: z < opaque))


def vtk_weighted():
    """vtkOrderIndependentTranslucentPass.cxx:389: weight alpha; LEQUAL, against the depth that is copied before."""
    return a_pixel(lambda pixel, background: weighted(pixel, background, lambda f: f.color[3], lambda z, opaque: z <= opaque))


# --- VTK's peels, which end for the whole frame at once

def opaque_in_vtk(pixel, background):
    """The opaque surface's depth is stored in a buffer of 24 bits and copied into binary32 (vtkDualDepthPeelingPass.cxx:1095)."""
    z, behind = opaque_of(pixel, background)
    most = 2 ** 24 - 1
    return (z if z == float("inf") else float(FLOAT(round(z * most) / most))), behind


def vtk_dual_peels(pixel, background, peels):
    """After each peel: the front, the layers behind it, whether a back fragment was written, and the remaining fragments."""
    fragments = blended_of(pixel)
    opaque, _ = opaque_in_vtk(pixel, background)
    seen = [f.z for f in fragments if f.z <= opaque]
    near = FLOAT(min(seen, default=1.0))
    far = FLOAT(opaque if opaque != float("inf") else max(seen, default=-1.0))
    front, back = (0.0,) * 4, (0.0,) * 4
    for _ in range(peels):
        drawn, layer, waiting = [front], (0.0,) * 4, []
        for f in fragments:
            z = FLOAT(f.z)
            if z < near - EPSILON or z > far + EPSILON:
                continue
            if near + EPSILON < z < far - EPSILON:
                waiting.append(z)
            elif z <= near + EPSILON:
                drawn.append(under(front, f.color))
            else:
                layer = tuple(map(max, layer, (*(c * f.color[3] for c in f.color[:3]), f.color[3])))
        front = tuple(map(max, *drawn)) if len(drawn) > 1 else front
        wrote = layer[3] > 0
        back = tuple(s + (1 - layer[3]) * d for s, d in zip(layer, back))
        near, far = (min(waiting), max(waiting)) if waiting else (FLOAT(1), FLOAT(-1))
        yield front, back, wrote, (near, far)


def vtk_dual(peels):
    """vtkDualDepthPeelingPass.cxx: ends when no pixel has written a back fragment (1217); the remaining fragments are blended in submission order
    (1641)."""
    def finish(pixel, background, count, goes_on):
        behind = opaque_of(pixel, background)[1]
        front, back, _, (near, far) = list(vtk_dual_peels(pixel, background, count))[-1] if count else ((0.0,) * 4, (0.0,) * 4, True, (-1, 2))
        for f in blended_of(pixel) if goes_on else []:
            if near <= FLOAT(f.z) <= far:
                pre = (*(c * f.color[3] for c in f.color[:3]), f.color[3])
                back = tuple(s + (1 - f.color[3]) * d for s, d in zip(pre, back))
        through = (1 - front[3]) * (1 - back[3])
        return tuple(f + (1 - front[3]) * b + through * o for f, b, o in zip(front[:3], back[:3], behind))

    def of_frame(frame, background):
        pixels = {pixel for row in frame for pixel in row if pixel is not None}
        wrote = [any(flags) for flags in zip(*([w for _, _, w, _ in vtk_dual_peels(pixel, background, peels)] for pixel in pixels))]
        count = wrote.index(False) + 1 if False in wrote else peels
        goes_on = False not in wrote
        return a_pixel(lambda pixel, bg: finish(pixel, bg, count, goes_on))(frame, background)
    return of_frame


def vtk_peeling(peels):
    """vtkDepthPeelingPass.cxx: LEQUAL, so that the last of equal depths is kept; LESS against the opaque surface; the last of the peels blends all
    remaining fragments in submission order (530). Fragments less than an epsilon behind a peeled one are lost (675)."""
    def rule(pixel, background):
        opaque, behind = opaque_in_vtk(pixel, background)
        left = [f for f in blended_of(pixel) if f.z < opaque]
        layers, last = [], FLOAT(0)
        for peel in range(1, peels + 1):
            left = [f for f in left if FLOAT(f.z) > last + EPSILON]
            if not left:
                break
            if peel == peels:
                layers += reversed(left)
            else:
                nearest = min(left, key=lambda f: (f.z, -left.index(f)))
                layers.append(nearest)
                last = FLOAT(nearest.z)
        return functools.reduce(lambda b, f: over(f.color, b), reversed(layers), behind)
    return a_pixel(rule)


def rule_of(engine, way, scene, peels=None):
    """The rule for a picture that draw.py makes with the same options."""
    count = lambda own: own if peels is None else peels
    rules = {
        ("vtk", "dual"): lambda: vtk_dual(count(4)), ("vtk", "peeling"): lambda: vtk_peeling(count(4)), ("vtk", "weighted"): vtk_weighted,
        ("babylon", "oit"): lambda: babylon_oit(count(5)), ("babylon", "blended"): lambda: babylon_blended(scene),
        ("molstar", "dpoit"): lambda: molstar_dpoit(count(2)), ("molstar", "wboit"): molstar_wboit, ("molstar", "blended"): lambda: molstar_blended(scene),
        ("three", "blended"): lambda: three(scene, True), ("three", "no-depth-write"): lambda: three(scene, False), ("three", "float"): lambda: three(scene, False)}
    return rules[engine, way]()
