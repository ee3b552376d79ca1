"""Exact reference pictures of transparent scenes, for the tests of other renderers.

    scene = strata.Scene("teapot")
    wanted = strata.render(scene, "dual", profile="geforce8", size=(64, 48))
    print(strata.compare(wanted, my_pixels).text)

Arrays have the stored codes: uint8 of 8-bit colours, float16 and float32 of float targets, uint16 and uint32 of D16 and D24. They are read-only;
those of 32-bit channels share the library's memory. Options of the frame are keywords with the names
and values of the command's options (strata render --help all), with _ for -: size=(640, 480), depth_format="d24", samples=4, shading="pixel",
background=(0.1, 0.1, 0.2), quantize_reference=False. Camera and lighting belong to the scene. Rows always begin at the top.
"""
from __future__ import annotations

import json
import os
from typing import Any, Callable, NamedTuple, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _strata
from ._strata import (ComparedFolders, Comparison, Diagnosis, FileError, History, InputError, Judgement, Picture, Refused, Rendering, Tolerances, __version__, algorithms,
                      profiles, read)

__all__ = ["ComparedFolders", "Comparison", "Diagnosis", "FileError", "History", "InputError", "Judgement", "Layer", "Picture", "Refused", "Region", "Rendering", "Scene", "Tolerances",
           "__version__", "algorithms", "assert_matches", "compare", "compare_folders", "diagnose", "explain", "fragments", "history_json", "judge", "layers", "passes", "picture",
           "profiles", "read", "render"]

Array = npt.NDArray[Any]
Comparable = Union[Rendering, Picture, Array, str, "os.PathLike[str]"]


class Scene(_strata.Scene):
    """A model's file (.gltf, .glb, .obj, .ply, .stl, .off), a built-in scene, or added triangles; without a camera their positions are in clip
    space. `color_space` is that of the colours and of blending: "encoded", or "linear", which a target of srgb8_alpha8 needs."""

    def add(self, positions: npt.ArrayLike, *, colors: Optional[npt.ArrayLike] = None, indices: Optional[npt.ArrayLike] = None,
            color: Sequence[float] = (1, 1, 1, 1), transparent: bool = True, double_sided: bool = True,
            model: Optional[npt.ArrayLike] = None, name: str = "", primitive: str = "triangles") -> "Scene":
        """Positions are (vertices, 3) and colors (vertices, 4), straight, as binary32; indices three per triangle; model a 4 x 4 matrix.
        primitive may be "lines", with two indices each, or "points", with one."""
        by_columns = None if model is None else np.asarray(model, dtype=np.float64).reshape(4, 4).T.ravel().tolist()
        self._add(_floats("positions", positions), None if colors is None else _floats("colors", colors),
                  None if indices is None else _indices(indices), list(color), transparent, double_sided, by_columns, name, primitive)
        return self


class Layer(NamedTuple):
    color: Array
    depth: Array
    is_from_behind: bool


def _floats(field: str, values: npt.ArrayLike) -> npt.NDArray[np.float32]:
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise InputError(f"triangles: {field}: expected numbers, found {array.dtype}")
    array = array.astype(np.float32, copy=False)
    # Read in place if the rows are contiguous and in order.
    is_in_order = array.ndim == 2 and array.strides[1] == 4 and (array.shape[0] < 2 or array.strides[0] >= 4 * array.shape[1])
    return array if is_in_order else np.ascontiguousarray(array)


def _indices(values: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    array = np.asarray(values)
    if array.dtype.kind not in "iu" or (array.size and (array.min() < 0 or array.max() > 0xFFFFFFFF)):
        raise InputError(f"triangles: indices: expected whole numbers from 0 to 4294967295, found {array.dtype}")
    return np.ascontiguousarray(array.ravel(), dtype=np.uint32)


class Region(NamedTuple):
    """The whole frame, as an own algorithm gets it."""
    width: int
    height: int
    # pixel, primitive, code, z, color: the transparent fragments in front of the opaque surfaces, in the order of submission.
    fragments: dict[str, Array]
    behind: Array  # (height, width, 4): the opaque surfaces over the background, premultiplied


OwnAlgorithm = Callable[[Region], npt.ArrayLike]


def render(scene: _strata.Scene, algorithm: Union[str, OwnAlgorithm] = "dual", *, profile: str = "ideal", **options: Any) -> Rendering:
    """Renders the picture. A Rendering that is_refused raises Refused when one of its arrays is accessed. `algorithm` is a name, or a function
    that is called with the frame as a Region, once a sample, and returns its colours: (height, width, 4), premultiplied."""
    if not isinstance(algorithm, str):
        own = algorithm
        name = getattr(own, "__name__", "own")
        return _strata._render_own(scene, lambda *parts: np.asarray(own(Region(*parts)), dtype=np.float32), name, profile, **options)
    return _strata._render(scene, algorithm, profile, **options)


def layers(scene: _strata.Scene, algorithm: str = "front_to_back", *, profile: str = "ideal", **options: Any) -> list[Layer]:
    """The layers from near to far."""
    return [Layer(*layer) for layer in _strata._layers(scene, algorithm, profile, **options)]


def passes(scene: _strata.Scene, algorithm: str = "dual", *, profile: str = "ideal", **options: Any) -> list[dict[str, Any]]:
    """Every pass with all targets after it: number, kind, reads, writes, passed, queries, targets."""
    return _strata._passes(scene, algorithm, profile, **options)


def fragments(scene: _strata.Scene, algorithm: str = "a_buffer", *, profile: str = "ideal", **options: Any) -> dict[str, Array]:
    """All fragments of transparent triangles in submission order: pixel, primitive, code, z, color. The arrays share their memory."""
    return _strata._fragments(scene, algorithm, profile, **options)


def explain(scene: _strata.Scene, x: int, y: int, algorithm: str = "dual", *, profile: str = "ideal", **options: Any) -> History:
    """The history of a pixel, counted from the top left: text, json_text, svg, layers. With several samples text and json_text are of all, svg and
    layers of sample 0, and `samples` has the history of each."""
    return _strata._explain(scene, x, y, algorithm, profile, **options)


def history_json(history: History) -> Any:
    """The history as dictionaries and lists, sufficient to repeat every step."""
    return json.loads(history.json_text)


def picture(array: Array, meaning: str = "") -> Picture:
    """Makes a picture from an array of stored codes. A plane of 32-bit words is a depth unless `meaning` is "color"."""
    if not isinstance(array, np.ndarray):
        raise InputError(f"picture: array: expected a numpy.ndarray, found {type(array).__name__}")
    return _strata._picture(array, meaning)


def _picture_of(given: Comparable) -> Picture:
    if isinstance(given, Picture):
        return given
    if isinstance(given, Rendering):
        return given.picture()
    if isinstance(given, np.ndarray):
        return picture(given)
    return read(os.fspath(given))


def compare(reference: Comparable, candidate: Comparable, *, color: int = 0, depth: int = 0, coverage: int = 0) -> Comparison:
    """Compares exactly, unless codes or pixels are tolerated: text, json_text, heat and distance describe the difference."""
    tolerances = Tolerances(color=color, depth=depth, coverage=coverage)
    return _strata._compare(_picture_of(reference), _picture_of(candidate), tolerances)


def compare_folders(reference: Union[str, "os.PathLike[str]"], candidate: Union[str, "os.PathLike[str]"], *, names: str = "", baselines: str = "",
                    color: int = 0, depth: int = 0, coverage: int = 0, pixels: int = 0) -> ComparedFolders:
    """Compares the pictures of two folders by name, as `strata compare FOLDER FOLDER` does: accepted, failed, states, text, json_text, junit. `names`
    and `baselines` are the patterns of its options, such as "{name}-expected.png,{name}-actual.png"; the tolerances are of each picture."""
    tolerances = Tolerances(color=color, depth=depth, coverage=coverage, pixels=pixels)
    return _strata._compare_folders(os.fspath(reference), os.fspath(candidate), tolerances, names, baselines)


def judge(scene: _strata.Scene, candidate: Comparable, algorithm: str = "", *, profile: str = "geforce8", **options: Any) -> Judgement:
    """Whether a picture of the scene by the algorithm, or by any exact one, is right, whatever its formats and rounding: is_right, state, sentence,
    mistakes, forgotten, leads, text. The picture has the size of the candidate; of one with several samples per pixel, `samples` is their number."""
    return _strata._judge(scene, _picture_of(candidate), profile, algorithm, **options)


def diagnose(scene: _strata.Scene, candidate: Comparable, algorithm: str = "dual", *, profile: str = "ideal",
             tolerances: Optional[Tolerances] = None, **options: Any) -> Diagnosis:
    """The known mistake, or the two, that explain a picture of the scene: verdict, mistakes, alike, text. The picture has the size of the
    candidate."""
    return _strata._diagnose(scene, _picture_of(candidate), algorithm, profile, tolerances or Tolerances(), **options)


def assert_matches(candidate: Comparable, reference: Comparable, *, name: str = "", color: int = 0, depth: int = 0,
                   coverage: int = 0) -> None:
    """Raises AssertionError with the kinds of mistakes, the first pixel, and the folder of the pictures (STRATA_PICTURES)."""
    __tracebackhide__ = True
    known = name or (os.fspath(reference) if isinstance(reference, (str, os.PathLike)) else "reference")
    tolerances = Tolerances(color=color, depth=depth, coverage=coverage)
    accepted, message = _strata._check(_picture_of(candidate), _picture_of(reference), known, tolerances)
    if not accepted:
        raise AssertionError(message)
