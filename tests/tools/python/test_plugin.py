"""Tests the pytest plugin with a user's test that fails on purpose, in a separate folder."""
import numpy as np

import strata

pytest_plugins = ["pytester"]

THEIR_TEST = """
import numpy as np

def picture(red):
    pixels = np.zeros((2, 4, 4), np.uint8)
    pixels[..., 3] = 255
    pixels[1, 2, 0] = red
    return pixels

def test_equal(matches_reference):
    matches_reference(picture(9), picture(9))

def test_off_by_three(matches_reference):
    matches_reference(picture(12), picture(9), color=3)
    matches_reference(picture(12), picture(9))
"""


def test_a_failed_comparison_leaves_pictures_under_its_tests_name(pytester):
    pytester.makepyfile(THEIR_TEST)
    result = pytester.runpytest_subprocess("--strata-pictures", "left")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*color at 1 pixels, first at (2, 1)*"])
    left = sorted(path.name for path in (pytester.path / "left").iterdir())
    assert left == ["test_off_by_three.2.side.png"]
    sheet = strata.read(str(pytester.path / "left" / left[0])).arrays["color"]
    assert sheet.shape[1] > 3 * 4


def test_assert_matches_needs_no_plugin(monkeypatch, tmp_path):
    monkeypatch.setenv("STRATA_PICTURES", str(tmp_path))
    pixels = np.zeros((2, 2, 4), np.uint8)
    strata.assert_matches(pixels, pixels)
    assert list(tmp_path.iterdir()) == []
    other = pixels.copy()
    other[0, 1, 2] = 1
    try:
        strata.assert_matches(other, pixels, name="mine")
    except AssertionError as error:
        assert "(1, 0)" in str(error) and str(tmp_path / "mine.side.png") in str(error)
    else:
        raise AssertionError("nothing was said")
