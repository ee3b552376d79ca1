"""Tests diagnosis and packs in Python on mistakes made with NumPy, and on packs whose arrays NumPy reads."""
import json

import numpy as np
import pytest

import strata

FRAME = {"profile": "geforce8", "size": (24, 20)}


@pytest.fixture
def scene():
    return strata.Scene("random:seed=7,triangles=40")


def test_a_right_picture_is_right_and_a_mistake_is_named(scene):
    picture = strata.render(scene, "dual", **FRAME)
    fine = strata.diagnose(scene, picture.color, "dual", profile="geforce8")
    assert fine.is_right and fine.verdict == "right" and fine.mistakes == [] and fine.differing == 0
    exchanged = strata.diagnose(scene, np.ascontiguousarray(picture.color[..., [2, 1, 0, 3]]), "dual", profile="geforce8")
    assert exchanged.mistakes == ["red_for_blue"] and not exchanged.is_right
    assert exchanged.text.startswith("wrong: red and blue are exchanged in the layers\n")
    assert json.loads(exchanged.json_text)["verdict"] == exchanged.verdict == "one_mistake"


def test_nothing_is_forgiven_by_itself(scene):
    color = strata.render(scene, "dual", **FRAME).color
    turned = np.ascontiguousarray(color[..., [2, 1, 0, 3]])
    off = np.where(turned < 254, turned + np.uint8(2), turned).astype(np.uint8)
    assert strata.diagnose(scene, off, "dual", profile="geforce8").verdict == "unknown_mistake"
    forgiving = strata.diagnose(scene, off, "dual", profile="geforce8", tolerances=strata.Tolerances(color=2))
    assert forgiving.mistakes == ["red_for_blue"]


def add_target(pack, name, kind, code, array):
    """Adds an array in the format of tools/oracle/pack/PACK.md, with a header of 128 bytes."""
    file = f"expected/{name}/{kind}.npy"
    (pack / file).parent.mkdir(parents=True, exist_ok=True)
    header = str({"descr": array.dtype.str, "fortran_order": False, "shape": array.shape}).encode()
    (pack / file).write_bytes(b"\x93NUMPY\x01\x00\x76\x00" + header.ljust(117) + b"\n" + array.tobytes())
    assert (np.load(pack / file) == array).all()
    return {"format": code, "samples": 1, "file": file}


def test_what_a_pack_expects_is_read_by_the_name_of_an_algorithm(tmp_path):
    arrays = {"dual": np.arange(24, dtype=np.uint8).reshape(2, 3, 4), "painter": np.zeros((2, 3, 4), dtype=np.uint8)}
    depth = np.linspace(0, 1, 6, dtype=np.float32).reshape(2, 3)
    results = [{"algorithm": name, "picture": add_target(tmp_path, name, "picture", "rgba8", array),
                "depth": add_target(tmp_path, name, "depth", "d32f", depth)} for name, array in arrays.items()]
    (tmp_path / "manifest.json").write_text(json.dumps({"format": "strata-pack", "version": 1, "results": results}))
    for name, array in arrays.items():
        read = strata.read(str(tmp_path), name).arrays
        assert (read["color"] == array).all() and (read["depth"] == depth).all()
    with pytest.raises(strata.InputError, match="dual, painter"):
        strata.read(str(tmp_path))
    with pytest.raises(strata.InputError, match="did you mean 'dual'"):
        strata.read(str(tmp_path), "duel")
