from typing import Any, Callable, Final, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

__version__: str

class InputError(ValueError): ...
class Refused(RuntimeError): ...
class FileError(OSError): ...

class Scene:
    def __init__(self, spec: str = ..., *, light: bool = ..., color_space: str = ...) -> None: ...
    def _add(self, positions: npt.NDArray[np.float32], colors: Optional[npt.NDArray[np.float32]],
             indices: Optional[npt.NDArray[np.uint32]], color: Sequence[float], transparent: bool, double_sided: bool,
             model: Optional[Sequence[float]], name: str, primitive: str) -> None: ...
    def look(self, view: Sequence[float], projection: Sequence[float]) -> None: ...
    def look_at(self, eye: Sequence[float], center: Sequence[float] = ..., up: Sequence[float] = ..., *, fovy: float = ...,
                near: float = ..., far: float = ...) -> None: ...
    def orbit(self, azimuth: float, elevation: float) -> None: ...
    warnings: Final[list[str]]
    triangles: Final[int]

class Picture:
    arrays: Final[dict[str, npt.NDArray[Any]]]

class Rendering:
    is_refused: Final[bool]
    refusal: Final[str]
    color: Final[npt.NDArray[Any]]
    depth: Final[npt.NDArray[Any]]
    digest: Final[str]
    audit: Final[dict[str, Any]]
    diagnostics: Final[list[dict[str, Any]]]
    geometry_passes: Final[int]
    def picture(self) -> Picture: ...
    def save(self, path: str) -> None: ...

class History:
    text: Final[str]
    json_text: Final[str]
    svg: Final[str]
    layers: Final[list[list[int]]]
    samples: Final[list[History]]

class Tolerances:
    def __init__(self, *, color: int = ..., depth: int = ..., coverage: int = ..., pixels: int = ...) -> None: ...

class Comparison:
    equal: Final[bool]
    accepted: Final[bool]
    differing: Final[int]
    text: Final[str]
    json_text: Final[str]
    junit: Final[str]
    heat: Final[npt.NDArray[np.uint8]]
    distance: Final[npt.NDArray[np.uint32]]

class ComparedFolders:
    accepted: Final[bool]
    failed: Final[int]
    states: Final[dict[str, str]]
    text: Final[str]
    json_text: Final[str]
    junit: Final[str]

class Diagnosis:
    is_right: Final[bool]
    verdict: Final[str]
    mistakes: Final[list[str]]
    alike: Final[list[str]]
    differing: Final[int]
    text: Final[str]
    json_text: Final[str]

class Judgement:
    is_right: Final[bool]
    is_undecided: Final[bool]
    sentence: Final[str]
    mistakes: Final[list[str]]
    forgotten: Final[list[str]]
    leads: Final[list[str]]
    text: Final[str]
    json_text: Final[str]
    def __bool__(self) -> bool: ...

def profiles() -> list[str]: ...
def algorithms() -> list[str]: ...
def read(path: str, algorithm: str = ...) -> Picture: ...
def _render(scene: Scene, algorithm: str, profile: str, **options: Any) -> Rendering: ...
def _render_own(scene: Scene, body: Callable[..., npt.NDArray[np.float32]], name: str, profile: str, **options: Any) -> Rendering: ...
def _command_words(**options: Any) -> list[str]: ...
def _option_words() -> dict[str, list[str]]: ...
def _judge(scene: Scene, candidate: Picture, profile: str, algorithm: str, **options: Any) -> Judgement: ...
def _layers(scene: Scene, algorithm: str, profile: str,
            **options: Any) -> list[Tuple[npt.NDArray[Any], npt.NDArray[Any], bool]]: ...
def _passes(scene: Scene, algorithm: str, profile: str, **options: Any) -> list[dict[str, Any]]: ...
def _fragments(scene: Scene, algorithm: str, profile: str, **options: Any) -> dict[str, npt.NDArray[Any]]: ...
def _explain(scene: Scene, x: int, y: int, algorithm: str, profile: str, **options: Any) -> History: ...
def _picture(array: npt.NDArray[Any], meaning: str) -> Picture: ...
def _compare(reference: Picture, candidate: Picture, tolerances: Tolerances) -> Comparison: ...
def _compare_folders(reference: str, candidate: str, tolerances: Tolerances, names: str,
                     baselines: str) -> ComparedFolders: ...
def _diagnose(scene: Scene, candidate: Picture, algorithm: str, profile: str, tolerances: Tolerances,
              **options: Any) -> Diagnosis: ...
def _check(candidate: Picture, reference: Picture, name: str, tolerances: Tolerances) -> Tuple[bool, str]: ...
