"""Tests Python scenes against the same triangles in other layouts, and error messages against texts written by hand."""
import random

import numpy as np
import pytest

import strata

CORNERS = np.array([[-1, -1, 0.25], [1, -1, 0.25], [-1, 1, 0.25], [1, -1, -0.5], [1, 1, -0.5], [-1, 1, -0.5]], np.float32)
COLORS = np.array([[1, 0, 0, 0.5], [0, 1, 0, 0.5], [0, 0, 1, 0.5], [1, 1, 0, 0.25], [0, 1, 1, 0.75], [1, 0, 1, 0.5]], np.float32)


def digest(scene):
    return strata.render(scene, "dual", profile="geforce8", size=(24, 16)).digest


def test_lists_interleaved_arrays_and_indices_say_the_same():
    plain = digest(strata.Scene().add(CORNERS, colors=COLORS))
    together = np.concatenate([CORNERS, COLORS], axis=1)
    assert digest(strata.Scene().add(together[:, :3], colors=together[:, 3:])) == plain
    assert digest(strata.Scene().add(CORNERS.tolist(), colors=COLORS.tolist())) == plain
    assert digest(strata.Scene().add(CORNERS[:3], colors=COLORS[:3], indices=[0, 1, 2]).add(CORNERS[3:], colors=COLORS[3:])) == plain


def test_every_type_and_order_of_numbers_says_the_same():
    plain = digest(strata.Scene().add(CORNERS, colors=COLORS))
    backwards = np.ascontiguousarray(CORNERS[::-1])[::-1]
    for positions in (CORNERS.astype(np.float64), np.asfortranarray(CORNERS), CORNERS.astype(">f4"), backwards, CORNERS.T.copy().T):
        assert digest(strata.Scene().add(positions, colors=np.asfortranarray(COLORS.astype(np.float64)))) == plain


def test_a_model_matrix_moves_as_it_is_written():
    model = np.eye(4)
    model[0, 3] = -0.5
    moved = CORNERS + np.array([-0.5, 0, 0], np.float32)
    assert digest(strata.Scene().add(CORNERS, colors=COLORS, model=model)) == digest(strata.Scene().add(moved, colors=COLORS))


def test_a_loaded_scene_takes_cameras_and_further_triangles():
    scene = strata.Scene("teapot")
    own, triangles = digest(scene), scene.triangles
    scene.orbit(30, 20)
    assert digest(scene) == own
    scene.orbit(120, -10)
    assert digest(scene) != own
    scene.add(CORNERS)
    assert scene.triangles == triangles + 2 and scene.warnings == []


def test_a_camera_sees_what_its_matrices_see():
    scene, same = strata.Scene().add(CORNERS), strata.Scene().add(CORNERS)
    scene.look_at((0, 0, 2), fovy=90, near=1, far=3)
    projection = [1 / 1.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -3, 0]  # of 24 x 16 pixels, by columns
    same.look([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1], projection)
    assert np.array_equal(strata.render(scene, size=(24, 16)).color, strata.render(same, size=(24, 16)).color)
    with pytest.raises(strata.InputError, match="camera: fovy_degrees: expected a number between 0 and 180"):
        scene.look_at((0, 0, 2), fovy=0)


@pytest.mark.parametrize("arguments, said", [
    (dict(positions=CORNERS.astype(str)), "triangles: positions: expected numbers, found <U"),
    (dict(positions=CORNERS[:5]), "positions.count: expected three per triangle, found 5"),
    (dict(positions=CORNERS[:, :2]), "positions: expected an array of float32 and shape"),
    (dict(positions=CORNERS, colors=COLORS[:3]), "colors.count: expected 6 or none, found 3"),
    (dict(positions=CORNERS, indices=[0, 1, 6]), r"indices\[2\]: expected less than 6, found 6"),
    (dict(positions=CORNERS, indices=[0, 1, -1]), "indices: expected whole numbers"),
    (dict(positions=CORNERS, indices=[0, 1]), "indices: expected three per triangle, found 2"),
    (dict(positions=CORNERS, color=(1, 1, 1, float("nan"))), r"color\[3\]: expected a finite number"),
])
def test_triangles_that_cannot_be_are_named(arguments, said):
    scene = strata.Scene()
    with pytest.raises(strata.InputError, match=said):
        scene.add(**arguments)
    assert scene.triangles == 0


def test_wrong_names_and_options_are_named():
    scene = strata.Scene()
    for ask, error, said in [
        (lambda: strata.Scene("teapott"), strata.InputError, "teapot"),
        (lambda: strata.render(scene, "duel"), strata.InputError, "did you mean 'dual'"),
        (lambda: strata.render(scene, profile="geforc8"), strata.InputError, "did you mean 'geforce8'"),
        (lambda: strata.render(scene, siez=3), TypeError, "did you mean 'size'"),
        (lambda: strata.render(scene, size=(0, 1)), strata.InputError, "options: size: expected WIDTHxHEIGHT such as 640x480, each from 1 to 16384, found '0x1'"),
        (lambda: strata.render(scene, max_passes="many"), strata.InputError, "options: max_passes: expected a whole number from 0, found 'many'"),
        (lambda: strata.render(scene, depth_format="d42"), strata.InputError, "options: depth_format: expected d16, d24, d32f"),
        (lambda: strata.render(scene, background=(1, 0)), strata.InputError, "background"),
    ]:
        with pytest.raises(error, match=said):
            ask()


def test_options_that_exclude_each_other_are_refused():
    with pytest.raises(strata.InputError, match="--shading pixel is valid only with --samples"):
        strata.render(strata.Scene("teapot"), size=(8, 8), shading="pixel")
    with pytest.raises(TypeError, match="camera"):
        strata.render(strata.Scene("teapot"), size=(8, 8), camera="front")


def test_keywords_are_the_options_of_a_command_line_and_back():
    """Random sets of options: keywords, the words of a command line, keywords of these."""
    draw = random.Random(56)
    words = {key: choices for key, choices in strata._strata._option_words().items() if choices}
    numbers = {"max_passes": [1, 7], "nodes": [1, 8], "sample_coverage": [0.25, 1], "sample_mask": [0, 254], "moment_bias": [0.5]}
    texts = {"size": [(640, 480), "64x48"], "background": [(0.25, 0.5, 0), "none"], "sort": ["bucket:8", "reverse"], "alpha": [0.5]}
    everything = {**words, **numbers, **texts}
    assert {"samples", "depth_format", "clip_depth", "resolve"} <= set(everything) and not {"camera", "orbit"} & set(everything)
    for _ in range(500):
        given = {key: draw.choice(values) for key, values in everything.items() if draw.random() < 0.3}
        line = strata._strata._command_words(**given)
        again, rest = {}, list(line)
        while rest:
            name = rest.pop(0)[2:]
            if name.startswith("no-"):
                again[name[3:].replace("-", "_")] = False
            else:
                key = name.replace("-", "_")
                again[key] = True if words.get(key) == ["true", "false"] else rest.pop(0)
        assert strata._strata._command_words(**again) == line
        assert set(again) <= set(given)


def test_two_vertices_are_a_line_and_one_a_point():
    def covered(primitive, **options):
        scene = strata.Scene().add([[-0.5, 0.1, 0], [0.5, 0.1, 0]], primitive=primitive)
        return int((strata.render(scene, "dual", size=(16, 16), **options).color[..., 0] > 0).sum())

    assert covered("lines") == 8 and covered("lines", line_width=3) == 24
    assert covered("points") == 2 and covered("points", point_size=3) == 18
    with pytest.raises(strata.InputError, match="primitive: expected triangles, lines or points, found 'line'"):
        strata.Scene().add(CORNERS, primitive="line")


def test_a_target_that_encodes_needs_a_scene_in_linear_light():
    whole_frame = [[-1, -1, 0], [3, -1, 0], [-1, 3, 0]]
    options = {"size": (2, 2), "color_format": "rgba32f", "result_format": "srgb8_alpha8"}
    linear = strata.Scene(color_space="linear").add(whole_frame, color=(1, 1, 1, 0.25))
    assert strata.render(linear, "front_to_back", **options).color[0, 0, 0] == 137  # 0.25 in linear light
    with pytest.raises(strata.InputError, match="expected linear with a target of srgb8_alpha8"):
        strata.render(strata.Scene().add(whole_frame), **options)
    with pytest.raises(strata.InputError, match="expected encoded or linear, found 'log'"):
        strata.Scene("teapot", color_space="log")
