"""The compiled half of culet: types for what culet/*.py call, and Stone and Scene."""

import os
from typing import Any, Callable, Dict, Iterable, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

_File = Union[str, "os.PathLike[str]"]
_Progress = Optional[Callable[[float], Optional[bool]]]

version: str

class InputError(ValueError): ...
class InternalError(RuntimeError): ...
class Interrupted(RuntimeError): ...

class Stone:
    @staticmethod
    def of_planes(
        normals: ArrayLike, offsets: ArrayLike, names: List[str] = ..., material: str = ""
    ) -> Stone: ...
    def with_material(self, name: str) -> Stone: ...
    def with_readings(self, rows: Iterable[Dict[str, Any]]) -> Stone: ...
    def save(self, file: _File) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def material(self) -> Optional[str]: ...
    @property
    def readings(self) -> List[Dict[str, Any]]: ...
    @property
    def has_uncertainty(self) -> bool: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def facets(self) -> List[str]: ...
    @property
    def normals(self) -> NDArray[np.float64]: ...
    @property
    def offsets(self) -> NDArray[np.float64]: ...
    @property
    def inclinations(self) -> NDArray[np.float64]: ...
    @property
    def azimuths(self) -> NDArray[np.float64]: ...
    @property
    def areas(self) -> NDArray[np.float64]: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def corners(self) -> List[List[int]]: ...
    @property
    def triangles(self) -> Tuple[NDArray[np.int32], NDArray[np.int32]]: ...
    @property
    def volume(self) -> float: ...

class Scene:
    def with_settings(
        self, overrides: Iterable[str] = ..., stone: Optional[Stone] = None
    ) -> Scene: ...
    @property
    def stone(self) -> Stone: ...
    @property
    def size(self) -> Tuple[int, int]: ...
    @property
    def notes(self) -> List[str]: ...

class FitResult:
    stone: Stone
    report: str
    status: str
    message: str
    usable: bool
    summary: List[str]
    facets: List[str]
    inclinations: NDArray[np.float64]
    azimuths: NDArray[np.float64]
    offsets: NDArray[np.float64]
    sigma_inclinations: NDArray[np.float64]
    sigma_azimuths: NDArray[np.float64]
    sigma_offsets: NDArray[np.float64]
    covariance: Optional[NDArray[np.float64]]

class Photo:
    @staticmethod
    def read(file: _File) -> Photo: ...
    @staticmethod
    def of_arrays(arrays: Dict[str, Any], name: str) -> Photo: ...

class ComparisonResult:
    verdict: str
    reason: str
    usable: bool
    scores: str
    page: str
    maps: Dict[str, NDArray[np.float32]]

def kind_of(file: _File) -> str: ...
def words_for(file: _File) -> str: ...
def load_stone(file: _File, overrides: List[str], material: str) -> Stone: ...
def fit(stone: Stone, progress: _Progress, **options: Any) -> FitResult: ...
def scene(
    file: str,
    stone: Optional[Stone],
    overrides: List[str],
    light: str,
    material: str,
    width_mm: Optional[float],
) -> Scene: ...
def render(
    scene: Scene,
    spectral: bool,
    seed: int,
    threads: int,
    uncertainty: Optional[Stone],
    draws: int,
    progress: _Progress,
) -> Dict[str, Any]: ...
def read_picture(file: _File) -> Dict[str, Any]: ...
def save_picture(arrays: Dict[str, Any], file: _File, exposure: Optional[float]) -> None: ...
def png(arrays: Dict[str, Any], exposure: Optional[float], alpha: bool) -> bytes: ...
def grade(
    stone: Stone,
    index: Optional[float],
    head: float,
    tilts: List[float],
    draws: int,
    seed: int,
    threads: int,
    progress: _Progress,
) -> str: ...
def compare_pictures(
    photo: Photo,
    render: Photo,
    mask: Any,
    ignored: Any,
    simulated: bool,
    seed: int,
    threads: int,
    progress: _Progress,
) -> ComparisonResult: ...
def compare_scene(
    photo: Photo,
    scene: Scene,
    mask: Any,
    ignored: Any,
    simulated: bool,
    find_pose: bool,
    calibrate: bool,
    budget: float,
    draws: int,
    cache: str,
    start: Optional[Stone],
    uncertainty: Optional[Stone],
    seed: int,
    threads: int,
    progress: _Progress,
) -> ComparisonResult: ...
