"""Tests pictures, layers, passes and histories in Python against OVER of two fragments worked out by hand, NumPy's views of bits, and each other."""
import itertools
import sys
import threading

import numpy as np
import pytest

import strata

WHOLE_FRAME = [[-1, -1, 0], [3, -1, 0], [-1, 3, 0]]


@pytest.fixture
def grey():
    """A scene with a far white and a near black triangle, both of alpha 0.5, over black: 0.25 everywhere."""
    scene = strata.Scene()
    scene.add([[x, y, -0.5] for x, y, _ in WHOLE_FRAME], color=(0, 0, 0, 0.5), name="near")
    return scene.add([[x, y, 0.5] for x, y, _ in WHOLE_FRAME], color=(1, 1, 1, 0.5), name="far")


def test_a_picture_is_what_two_fragments_make(grey):
    picture = strata.render(grey, "front_to_back", size=(6, 5), color_format="rgba32f")
    assert picture.color.shape == (5, 6, 4) and picture.color.dtype == np.float32
    assert (picture.color[..., :3] == 0.25).all() and (picture.color[..., 3] == 1).all()
    assert picture.depth.shape == (5, 6)
    assert picture.audit["layers_max"] == 2 and picture.geometry_passes == 3


@pytest.mark.parametrize("name, kind", [("rgba8", np.uint8), ("rgba16f", np.float16), ("rgba32f", np.float32)])
def test_colors_have_the_type_of_their_format(grey, name, kind):
    color = strata.render(grey, size=(4, 4), color_format=name).color
    assert color.dtype == kind
    assert color[0, 0, 0] == (64 if name == "rgba8" else 0.25)


@pytest.mark.parametrize("name, kind", [("d16", np.uint16), ("d24", np.uint32), ("d32f", np.float32)])
def test_depths_have_the_type_of_their_format(grey, name, kind):
    depth = strata.render(grey, "front_to_back", size=(4, 4), depth_format=name).depth
    assert depth.dtype == kind
    most = {"d16": 2**16 - 1, "d24": 2**24 - 1, "d32f": 1}[name]
    assert abs(float(depth[0, 0]) / most - 0.25) < 1e-4


def test_arrays_of_32_bit_channels_share_memory_and_outlive_the_rendering(grey):
    picture = strata.render(grey, size=(4, 4), color_format="rgba32f")
    one, two = picture.color, picture.color
    assert np.shares_memory(one, two) and not one.flags.owndata and not one.flags.writeable
    del picture, two
    assert (one[..., :3] == 0.25).all()


def test_layers_run_from_near_to_far_from_either_end(grey):
    for algorithm in ("front_to_back", "dual"):
        near, far = strata.layers(grey, algorithm, size=(4, 4))
        assert (near.depth < far.depth).all()
        assert (near.color[..., 0] == 0).all()
        assert far.is_from_behind == (algorithm == "dual")


def test_the_upper_row_is_the_first_from_either_origin():
    scene = strata.Scene()
    scene.add([[-1, -1, 0], [1, -1, 0], [0, 0, 0]])
    upper, lower = (strata.render(scene, profile="geforce8", size=(8, 8), origin=origin) for origin in ("upper_left", "lower_left"))
    for picture in (upper, lower):
        assert picture.color[0, 0, 0] == 0 and picture.color[-1, 4, 0] > 0  # row 0 is the top one
    with pytest.raises(strata.InputError, match="origin"):
        strata.render(scene, origin="top")


def test_alpha_of_a_clear_background_is_what_the_layers_cover(grey):
    picture = strata.render(grey, "front_to_back", size=(4, 4), color_format="rgba32f", background=(0, 0, 0, 0))
    assert (picture.color[..., 3] == 0.75).all()


def test_fragments_are_views_of_one_memory(grey):
    found = strata.fragments(grey, size=(4, 3))
    assert sorted(found["pixel"]) == sorted(list(range(12)) * 2)
    assert set(found["primitive"]) == {0, 1}
    assert (found["color"][found["primitive"] == 1] == [1, 1, 1, 0.5]).all()
    assert found["z"].strides == found["code"].strides and not found["z"].flags.owndata


def test_fragments_of_nothing_are_empty():
    assert all(len(field) == 0 for field in strata.fragments(strata.Scene(), size=(4, 3)).values())


def test_passes_end_in_the_picture(grey):
    shown = strata.passes(grey, "dual", profile="geforce8", size=(4, 4))
    assert shown[-1]["kind"] == "published"
    picture = strata.render(grey, "dual", profile="geforce8", size=(4, 4))
    assert any(np.array_equal(target, picture.color) for target in shown[-1]["targets"].values())
    assert "min_max" in shown[0]["targets"]


def test_a_pixel_is_explained_in_words_json_and_svg(grey):
    history = strata.explain(grey, 3, 2, "dual", size=(4, 4))
    assert "near" in history.text and history.svg.startswith("<svg")
    assert len(strata.history_json(history)["fragments"]) == 2
    assert history.layers == [[0], [1]]
    with pytest.raises(strata.InputError, match="pixel: x: expected 0 to 3, found 4"):
        strata.explain(grey, 4, 0, size=(4, 4))


def test_a_refused_picture_gives_no_array(grey):
    refused = strata.render(grey, "dual", profile="geforce3")
    assert refused.is_refused and "geforce3" in refused.refusal
    for ask in (lambda: refused.color, lambda: refused.depth, lambda: refused.digest, lambda: refused.audit, refused.picture,
                lambda: strata.layers(grey, "dual", profile="geforce3"), lambda: strata.passes(grey, "dual", profile="geforce3"),
                lambda: strata.compare(refused, refused)):
        with pytest.raises(strata.Refused, match="profile geforce3 has no"):
            ask()


def test_every_algorithm_on_every_device_draws_or_refuses(grey):
    drawn = 0
    for profile, algorithm in itertools.product(strata.profiles(), strata.algorithms()):
        picture = strata.render(grey, algorithm, profile=profile, size=(4, 4))
        if not picture.is_refused:
            drawn += 1
            assert strata.compare(picture, picture).equal
    assert drawn > 40


def test_a_difference_is_told_by_kind_and_place():
    scene = strata.Scene().add([[-0.9, -0.9, 0], [0.9, -0.9, 0], [0, 0.9, 0]], color=(1, 1, 1, 0.5))
    picture = strata.render(scene, size=(16, 12), color_format="rgba8")
    mine = picture.color.copy()
    mine[7, 7, 1] += 3
    found = strata.compare(picture.color, mine)
    assert not found.equal and found.differing == 1
    assert "first at 7,7" in found.text
    assert not found.distance.flags.writeable and found.distance[7, 7] == 3 and found.distance.sum() == 3
    assert found.heat.shape == (12, 16, 4)
    assert strata.compare(picture.color, mine, color=3).accepted


def test_codes_of_arrays_are_compared_bit_by_bit():
    quiet, other = np.float32(np.nan), np.array([0x7FC00001], np.uint32).view(np.float32)[0]
    assert strata.compare(np.full((2, 2, 4), quiet), np.full((2, 2, 4), quiet)).equal
    assert not strata.compare(np.full((2, 2, 4), quiet), np.full((2, 2, 4), other)).equal
    codes = np.array([[0, 2**24 - 1], [2**24 - 2, 1]], np.uint32)
    assert strata.picture(codes).arrays["depth"].tolist() == codes.tolist()


def test_arrays_of_any_strides_are_read_as_they_look():
    pixels = np.arange(8 * 6 * 4, dtype=np.uint8).reshape(8, 6, 4)
    for view in (pixels[::-1], pixels[:, ::2], np.asfortranarray(pixels), pixels[..., :3]):
        assert np.array_equal(strata.picture(view).arrays["color"], view)


@pytest.mark.parametrize("array", [np.zeros((2, 2, 5), np.uint8), np.zeros(4, np.uint8), np.zeros((0, 4), np.uint8),
                                   np.zeros((2, 2, 4), np.int32), np.zeros((2, 2), bool)])
def test_arrays_that_are_no_pictures_are_refused(array):
    with pytest.raises(strata.InputError, match="picture: (dtype|shape): expected"):
        strata.picture(array)
    with pytest.raises(strata.InputError, match="expected a numpy.ndarray"):
        strata.picture(array.tolist())


def test_files_keep_what_arrays_hold(grey, tmp_path):
    picture = strata.render(grey, size=(9, 7), color_format="rgba8")
    for name in ("out.exr", "out.png"):
        picture.save(str(tmp_path / name))
        assert np.array_equal(strata.read(str(tmp_path / name)).arrays["color"], picture.color)
    np.save(tmp_path / "out.npy", picture.color)
    assert strata.compare(tmp_path / "out.npy", picture.color).equal
    with pytest.raises(strata.InputError, match="nothing.exr"):
        strata.read(str(tmp_path / "nothing.exr"))


def test_threads_of_python_render_side_by_side():
    scene = strata.Scene("teapot")
    alone = strata.render(scene, profile="geforce8", size=(48, 36)).digest
    found = []
    work = [threading.Thread(target=lambda: found.append(strata.render(scene, profile="geforce8", size=(48, 36)).digest))
            for _ in range(4)]
    for thread in work:
        thread.start()
    for thread in work:
        thread.join()
    assert found == [alone] * 4


def test_the_lock_is_free_while_the_library_works():
    """A thread that waits for the interpreter gets the lock during a call; with this switch interval it could not get it otherwise."""
    scene, order = strata.Scene("teapot"), []
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    try:
        for _ in range(20):  # the system may start the thread late
            gate, order = threading.Lock(), []
            gate.acquire()
            thread = threading.Thread(target=lambda: (gate.acquire(), order.append("thread")))
            thread.start()
            gate.release()
            strata.passes(scene, size=(96, 96))
            order.append("call")
            thread.join()
            if order[0] == "thread":
                break
    finally:
        sys.setswitchinterval(before)
    assert order == ["thread", "call"]
