"""Tests that 32-bit codes are read exactly with OpenImageIO's low-level calls, and documents that its ImageBuf silently converts them to float."""
import numpy as np
import pytest

import strata

OpenImageIO = pytest.importorskip("OpenImageIO", reason="SKIPPED: python3-openimageio is not installed")

# The code of a binary32 depth is its bits: a number near 2^30, of which a float stores only 24 bits.
NEAR_ONE_HALF = np.array([0x3F000001], np.uint32)


@pytest.fixture
def file(tmp_path):
    """A file with a depth slightly above 0.5 everywhere."""
    z = float(NEAR_ONE_HALF.view(np.float32)[0]) * 2 - 1
    scene = strata.Scene().add([[-1, -1, z], [3, -1, z], [-1, 3, z]], color=(1, 1, 1, 0.5))
    picture = strata.render(scene, "front_to_back", size=(4, 4), depth_format="d32f")
    assert (picture.depth.view(np.uint32) == NEAR_ONE_HALF).all()
    picture.save(str(tmp_path / "depth.exr"))
    return str(tmp_path / "depth.exr")


def test_image_buf_loses_bits_of_codes_in_silence(file):
    buf = OpenImageIO.ImageBuf(file)
    channel = buf.spec().channelnames.index("Zbits")
    found = buf.get_pixels(OpenImageIO.FLOAT)[..., channel].astype(np.float64)
    assert not buf.has_error
    assert (found.astype(np.uint64) != NEAR_ONE_HALF[0]).all()  # 1056964609 is not a float; its neighbour 1056964608 is


def test_strata_and_image_input_keep_them(file):
    arrays = strata.read(file).arrays
    assert (arrays["depth"].view(np.uint32) == NEAR_ONE_HALF).all()
    given = OpenImageIO.ImageInput.open(file)
    channel = given.spec().channelnames.index("Zbits")
    codes = given.read_image(0, 0, channel, channel + 1, OpenImageIO.UINT32)
    given.close()
    assert (np.asarray(codes).ravel() == NEAR_ONE_HALF[0]).all()
