"""Tests the comparison of two folders of arrays whose codes are written here."""
import json
import xml.etree.ElementTree

import numpy as np
import pytest

import strata


@pytest.fixture
def folders(tmp_path):
    """Three pictures: equal, one code off at one pixel, and missing."""
    for folder in ("wanted", "made"):
        (tmp_path / folder).mkdir()
    codes = np.arange(5, 245, 10, dtype=np.uint8).reshape(2, 3, 4)
    off = codes.copy()
    off[1, 2, 0] += 1
    for name, wanted, made in (("a", codes, codes), ("b", codes, off), ("c", codes, None)):
        np.save(tmp_path / "wanted" / f"{name}.npy", wanted)
        if made is not None:
            np.save(tmp_path / "made" / f"{name}.npy", made)
    return tmp_path / "wanted", tmp_path / "made"


def test_two_folders_are_compared_by_name(folders):
    found = strata.compare_folders(*folders)
    assert not found.accepted and found.failed == 2
    assert found.states == {"a.npy": "equal", "b.npy": "different", "c.npy": "missing"}
    lines = found.text.splitlines()
    assert lines[0] == "different: 2 of 3 pictures fail: 1 different, 1 missing"
    assert lines[2].startswith("b.npy: different: 1 of 6 pixels differ")
    assert len(json.loads(found.json_text)["cases"]) == 3
    assert xml.etree.ElementTree.fromstring(found.junit).iter("testcase")


def test_tolerances_and_patterns_are_the_commands(folders):
    assert strata.compare_folders(*folders, color=1).states["b.npy"] == "accepted"
    assert strata.compare_folders(*folders, names="{name}.npy").states == {"a": "equal", "b": "different", "c": "missing"}
    with pytest.raises(strata.InputError, match="names"):
        strata.compare_folders(*folders, names="a.npy")
