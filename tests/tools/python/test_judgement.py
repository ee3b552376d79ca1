"""Tests verdicts, samples and own algorithms in Python: on pictures of the library, and on sums that NumPy computes."""
import numpy as np
import pytest

import strata

SIZE = {"size": (48, 36)}


def test_a_port_of_another_format_is_right_for_judge_and_diagnose():
    scene = strata.Scene("teapot")
    halves = strata.render(scene, "front_to_back", profile="geforce8", color_format="rgba16f", result_format="rgba8", **SIZE).color
    judged = strata.judge(scene, halves)
    assert judged and judged.is_right and judged.sentence.startswith("right: structure exact at "), judged.text
    assert strata.diagnose(scene, halves, "dual", profile="geforce8").is_right


def test_a_wrong_picture_has_a_sentence_and_its_mistakes_or_what_was_forgotten():
    scene = strata.Scene("teapot")
    two = strata.render(scene, "front_to_back", profile="geforce8", max_passes=2, **SIZE).color
    wrong = strata.judge(scene, two)
    assert not wrong and wrong.sentence.startswith("wrong: ") and wrong.mistakes and wrong.text.startswith(wrong.sentence)
    four = strata.render(scene, "front_to_back", profile="geforce8", samples=4, **SIZE).color
    assert strata.judge(scene, four, samples=4).is_right
    assert strata.judge(scene, four).forgotten == ["looks forgotten: --samples 4; with it the picture is right"]


def test_samples_are_those_of_the_command():
    half = np.array([[-1, -1, 0], [0, -1, 0], [-1, 1, 0], [0, -1, 0], [0, 1, 0], [-1, 1, 0]])
    scene = strata.Scene().add(half, color=(1, 0, 0, 1))
    picture = strata.render(scene, "dual", profile="ideal", size=(3, 1), samples=4, color_format="rgba32f").color
    assert picture[0, :, 0].tolist() == [1.0, 0.5, 0.0]  # two of the middle pixel's four samples
    with pytest.raises(strata.InputError, match="options: samples: expected 1, 2, 4 or 8, found '3'"):
        strata.render(scene, samples=3)
    with pytest.raises(strata.InputError, match="options: shading: expected sample or pixel, found 'centre'"):
        strata.render(scene, shading="centre")
    with pytest.raises(strata.InputError, match="samples: expected 1 for fragments"):
        strata.fragments(scene, samples=2)
    history = strata.explain(scene, 1, 0, "dual", size=(3, 1), samples=4)
    assert sorted(len(strata.history_json(sample)["fragments"]) for sample in history.samples) == [0, 0, 1, 1]
    assert "the box resolve of 4 samples" in history.text and len(strata.history_json(history)["histories"]) == 4
    one = strata.explain(scene, 1, 0, "dual", size=(3, 1), samples=4, sample=0)
    assert len(one.samples) == 1 and one.samples[0].text == one.text


def sorted_over(region):
    """Every fragment over those behind it, in binary64; of equal depths the first submitted is the nearest, as a_buffer has it."""
    colors = region.behind.astype(np.float64).reshape(-1, 4)
    pixel, color = region.fragments["pixel"], region.fragments["color"].astype(np.float64)
    for i in np.lexsort((-np.arange(len(pixel)), -region.fragments["code"].astype(np.int64))):
        alpha = color[i, 3]
        colors[pixel[i], :3] = alpha * color[i, :3] + (1 - alpha) * colors[pixel[i], :3]
    return colors.reshape(region.height, region.width, 4)


@pytest.mark.parametrize("name", ["showroom", "random:seed=7,triangles=40"])
def test_an_own_algorithm_that_sorts_gives_the_picture_of_the_oracle(name):
    scene = strata.Scene(name)
    options = dict(profile="ideal", background=(0.2, 0.3, 0.5, 1), **SIZE)
    mine = strata.render(scene, sorted_over, **options).color
    assert np.abs(mine - strata.render(scene, "a_buffer", **options).color).max() < 1e-6
    assert strata.judge(scene, mine, profile="ideal", background=(0.2, 0.3, 0.5, 1)).is_right


def test_an_own_algorithm_is_called_for_every_sample_and_its_errors_arrive():
    scene, called = strata.Scene("planes:count=2"), []

    def behind(region):
        called.append((region.width, region.height, region.fragments["color"].shape[1]))
        return region.behind

    strata.render(scene, behind, size=(8, 6), samples=4)
    assert called == [(8, 6, 4)] * 4

    def fails(region):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        strata.render(scene, fails, size=(8, 6))
    with pytest.raises(strata.InputError, match="algorithm: result: expected an array of shape"):
        strata.render(scene, lambda region: np.zeros(3), size=(8, 6))


def test_pictures_of_float64_and_of_every_order_are_accepted():
    scene = strata.Scene("planes:count=2")
    picture = strata.render(scene, "dual", profile="ideal", size=(8, 6)).color
    for array in (picture.astype(np.float64), np.asfortranarray(picture), picture.astype(">f4"), picture[::-1].copy()[::-1]):
        assert strata.compare(picture, array).equal
