"""A program with type annotations that uses the package; it is checked by mypy and never executed."""
from typing import Any

import numpy.typing as npt

import strata

scene: strata.Scene = strata.Scene().add([[0, 0, 0], [1, 0, 0], [0, 1, 0]], color=(1, 0, 0, 0.5))
rendering: strata.Rendering = strata.render(scene, "dual", profile="geforce8", size=(64, 64))
pixels: npt.NDArray[Any] = rendering.color
equal: bool = strata.compare(pixels, "reference.exr").equal
ends: list[bool] = [layer.is_from_behind for layer in strata.layers(scene)]
named: list[str] = strata.diagnose(scene, pixels, "dual", profile="geforce8").mistakes
expected: npt.NDArray[Any] = strata.read("pack", "dual").arrays["color"]
judged: bool = strata.judge(scene, pixels, samples=4).is_right
own: strata.Rendering = strata.render(scene, lambda region: region.behind)
words: str = strata.explain(scene, 1, 2).text
