"""Invalid values for every field of a profile, a camera and a plan."""
import json

from trial import Trial, output_of

LONG = '"' + "x" * 2000 + '"'
# The values as written in the file, including some that JSON does not have.
VALUES = ["null", "NaN", "-Infinity", "1e999", "1e308", "-1e308", "1e-320", "9223372036854775808", "18446744073709551616",
          "-9223372036854775809", "4294967297", "-1", "0.5", "0x10", "01", "+1", '""', '"nan"', '"1"', '"\u0663"', '"\\ud800"',
          '"\\u0000"', "[]", "{}", "[[[[]]]]", '{"a": 1}', "[1, 2", "true false", "", "'1'", LONG]

CAMERA = {"eye": [0, 0, 4], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 40, "near": 0.5, "far": 9}
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
PLAN = {"common": {"scene": "planes:count=1", "size": "8x8"}, "grids": [{"depth_format": "d24"}]}
PLAN_KEYS = ["scene", "profile", "size", "orbit", "alpha", "algorithm", "split", "hypothesis", "vertex_path", "pair",
             "depth_format", "subpixel_bits", "near_far", "remedy", "max_passes"]

# (place, value): valid after all, with the reason.
ACCEPTED = {
    ("/name", '"nan"'): "a name", ("/name", '"1"'): "a name", ("/name", '"\u0663"'): "a name",
    ("/description", '""'): "a text", ("/description", '"nan"'): "a text", ("/description", '"1"'): "a text", ("/description", '"\\u0000"'): "a text that only JSON shows",
    ("/description", '"\u0663"'): "a text", ("/raster", "{}"): "all fields are the base's",
    ("/fovy_degrees", "0.5"): "half a degree", ("/far", "4294967297"): "a distance",
    ("/near", "0.5"): "a distance", ("/far", "9223372036854775808"): "a distance", ("/far", "18446744073709551616"): "a distance", ("/about", '""'): "free text", ("/about", '"nan"'): "free text", ("/about", '"1"'): "free text",
    ("/about", '"\u0663"'): "free text", ("/about", '"\\u0000"'): "free text", ("/about", LONG): "free text",
    ("/grids/0", "{}"): "the grid of the defaults", ("/common/alpha", "0.5"): "an alpha", ("/common/alpha", '"1"'): "an alpha",
    ("/grids/0/alpha", "0.5"): "an alpha", ("/grids/0/alpha", '"1"'): "an alpha", ("/common/max_passes", '"1"'): "one pass",
    ("/grids/0/max_passes", '"1"'): "one pass",
}
# Coordinates of a camera and elements of a matrix may have any of these; a matrix that becomes singular by one is invalid.
COORDINATES = ["9223372036854775808", "18446744073709551616", "-9223372036854775809", "4294967297", "-1", "0.5", "1e-320"]
HOLE = "@hole@"


def texts_with(document, path):
    """The document's text with each value of VALUES at the path."""
    hole = json.loads(json.dumps(document))
    inner = hole
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = HOLE
    text = json.dumps(hole)
    for value in VALUES:
        yield value, text.replace(f'"{HOLE}"', value).encode("utf-8", "surrogatepass")


def cases_of(kind, document, path, words):
    place = "/" + "/".join(map(str, path))
    for value, text in texts_with(document, path):
        is_coordinate = kind == "camera" and len(path) == 2 and value in COORDINATES
        if (place, value) not in ACCEPTED and not is_coordinate:
            # An unknown scene or device is reported by its name, not by its place in the plan.
            by_name = (path[-1],) if kind == "plan" and path[-1] in ("scene", "profile", "hypothesis") else ()
            yield Trial(f"{kind} {place}", words, names=(f"{kind}.json", *by_name), files={f"{kind}.json": text})


def profile_cases(program):
    profile = json.loads(output_of(program, ["list", "profiles", "ideal", "--json"]))
    profile["base"] = "ideal"
    words = ["render", "planes:count=1", "--size", "8x8", "--no-audit", "--profile", "profile.json"]
    paths = [(key,) for key in profile] + [("raster", key) for key in profile["raster"]]
    for path in paths:
        yield from cases_of("profile", profile, path, words)


def camera_cases(program):
    del program
    words = ["render", "planes:count=1", "--size", "8x8", "--no-audit", "--camera", "camera.json"]
    for key, value in CAMERA.items():
        yield from cases_of("camera", CAMERA, (key,), words)
        if isinstance(value, list):
            yield from cases_of("camera", CAMERA, (key, 1), words)
    matrices = {"view": IDENTITY, "projection": IDENTITY}
    for key in matrices:
        yield from cases_of("camera", matrices, (key,), words)
        yield from cases_of("camera", matrices, (key, 5), words)


def plan_cases(program):
    del program
    words = ["invariance", "--plan", "plan.json", "--dry-run"]
    for path in [("about",), ("common",), ("grids",), ("grids", 0)] + [("common", key) for key in PLAN_KEYS] + [
            ("grids", 0, key) for key in PLAN_KEYS]:
        yield from cases_of("plan", PLAN, path, words)
