"""Reads a golden pack as input of an engine: meshes with one colour per vertex, two matrices, a size and a background.

Shapes as in tools/oracle/pack/PACK.md: matrices are 16 numbers, column by column; colours are straight and encoded, 0 to 1; triangles are indices of the
mesh's own vertices. Numbers are exactly those of the pack. Needs only the standard library.
"""
import array
import dataclasses
import json
import pathlib

HEADER = 128
CODES = {"<f4": "f", "<f2": "H", "<u4": "I", "<i4": "i", "|u1": "B"}
IDENTITY = [float(i % 5 == 0) for i in range(16)]


class PackError(Exception):
    """The pack has something that no driver here renders; the text is a sentence."""


@dataclasses.dataclass
class Mesh:
    """The triangles of one object of the scene in one draw."""
    name: str
    opaque: bool
    model: list
    positions: array.array  # x y z, binary32
    colors: array.array  # r g b a, binary32
    triangles: array.array  # three numbers of vertices each, in submission order

    def flat(self):
        """The one colour of all vertices; None if there are several."""
        first = list(self.colors[:4])
        return first if all(list(self.colors[i:i + 4]) == first for i in range(0, len(self.colors), 4)) else None


@dataclasses.dataclass
class Scene:
    width: int
    height: int
    background: list  # r g b
    view: list
    projection: list
    meshes: list

    def runs(self):
        """The meshes, divided where the colour changes, for engines with one colour per mesh. A triangle with several colours stays in the mesh of
        its neighbours."""
        return [run for mesh in self.meshes for run in runs_of(mesh)]


def runs_of(mesh):
    key = [tuple(mesh.colors[4 * v:4 * v + 4]) for v in mesh.triangles]
    colors = [set(key[t:t + 3]) for t in range(0, len(key), 3)]
    if any(len(c) > 1 for c in colors):
        return [mesh]
    starts = [t for t in range(len(colors)) if t == 0 or colors[t] != colors[t - 1]]
    return [part_of(mesh, first, last) for first, last in zip(starts, [*starts[1:], len(colors)])]


def part_of(mesh, first, last):
    """Triangles `first` to `last` (excluded) with the vertices that they use."""
    used = mesh.triangles[3 * first:3 * last]
    numbers = {vertex: i for i, vertex in enumerate(dict.fromkeys(used))}
    pick = lambda values, width: array.array("f", [x for v in numbers for x in values[width * v:width * v + width]])
    return Mesh(f"{mesh.name}.{first}", mesh.opaque, mesh.model, pick(mesh.positions, 3), pick(mesh.colors, 4),
                array.array("I", [numbers[v] for v in used]))


def read_npy(path):
    """The numbers of an array, row by row."""
    data = pathlib.Path(path).read_bytes()
    descr = data[10:HEADER].decode().split("'descr': '")[1].split("'")[0]
    return array.array(CODES[descr], data[HEADER:])


def expect(manifest):
    """Refuses features that the drivers do not render."""
    state, scene = manifest["state"], manifest["scene"]
    wanted = {"depth_order": "less", "clip_depth": "minus_one_to_one", "y_direction": "up", "front_face": "counter_clockwise", "alpha": None,
              "depth_clamp": False}
    for key, value in wanted.items():
        if state[key] != value:
            raise PackError(f"/state/{key}: expected {json.dumps(value)}, found {json.dumps(state[key])}: the drivers of engines draw nothing else")
    if scene["color_space"] != "encoded" or scene["textures"] or scene["light"]:
        raise PackError("/scene: expected encoded colours without textures or a light's shadow: the drivers of engines draw nothing else")
    if [state["depth_range"][end]["decimal"][0] for end in ("near", "far")] != [0.0, 1.0]:
        raise PackError("/state/depth_range: expected 0 to 1: the drivers of engines draw nothing else")


def meshes_of(folder, manifest, draw):
    """One mesh for each object of a draw. The vertices of an object are consecutive, in the order of its mesh's positions."""
    load = lambda key: read_npy(folder / draw[key])
    triangles, objects, front, flags = load("triangles"), load("objects"), load("front"), load("flags")
    if load("back") != front or any(not flag & 1 for flag in flags):
        raise PackError(f"/draws, {draw['list']}: expected surfaces with the same colour on both sides, never culled: engines have one colour a vertex")
    found = []
    for number in dict.fromkeys(objects):
        instance = manifest["scene"]["instances"][number]
        mesh = manifest["scene"]["meshes"][instance["mesh"]]
        if manifest["scene"]["materials"][instance["material"]]["alpha_mode"] == "mask":
            raise PackError(f"/scene/instances/{number}: expected a material without an alpha test: the drivers of engines draw none")
        positions = read_npy(folder / mesh["positions"])
        corners = [c for t, o in enumerate(objects) if o == number for c in triangles[3 * t:3 * t + 3]]
        base = min(corners)
        vertices = len(positions) // 3
        if max(corners) - base >= vertices:
            raise PackError(f"/draws, {draw['list']}: expected the vertices of object {number} one behind the other")
        found.append(Mesh(f"object.{number}", draw["list"] == "opaque", instance["model"]["decimal"], positions,
                          front[4 * base:4 * (base + vertices)], array.array("I", [c - base for c in corners])))
    return found


def read_scene(folder):
    """PackError, with the place, if the pack has something that no driver renders."""
    folder = pathlib.Path(folder)
    try:
        manifest = json.loads((folder / "manifest.json").read_text())
    except OSError as error:
        raise PackError(f"expected a pack of `strata golden`: {error.strerror}") from error
    expect(manifest)
    state = manifest["state"]
    meshes = [mesh for draw in manifest["draws"] for mesh in meshes_of(folder, manifest, draw)]
    return Scene(state["width"], state["height"], state["background"]["decimal"][:3], manifest["view"]["view"]["decimal"],
                 manifest["view"]["projection"]["decimal"], meshes)
