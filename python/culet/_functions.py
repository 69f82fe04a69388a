"""What people call: load, fit, scene, render, grade, compare."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _culet
from ._culet import InputError, Scene, Stone
from ._picture import Picture, as_arrays
from ._results import Comparison, Fit, Grade, comparison_of, fit_of

File = Union[str, "os.PathLike[str]"]
Progress = Callable[[float], Optional[bool]]


def load(
    file: File, *, material: str = "", light: str = "", overrides: Iterable[str] = ()
) -> Union[Stone, Scene, Picture]:
    """Reads any file of culet's: what it gives depends on what the file is.

    A stone file (.toml with [stone]), a mesh (.obj .off .ply .stl) or a cut design (.asc .gem): a
    Stone. A scene (.toml): a Scene. A picture (.exr .hdr .png .jpg .tif): a Picture in linear light.

    material: name of the catalogue, or a material file, in place of the file's own.
    light: of a scene: a preset's name (jeweller, aset, ...) in place of its lights.
    overrides: keys of a TOML file, as `--set` has them: ["stone.unit=cm"].
    """
    kind = _culet.kind_of(file)
    keys = list(overrides)
    if kind in ("solid", "stone"):
        if light:
            raise InputError(f"{os.fspath(file)}: is a stone, which has no light: say it to "
                             "culet.scene or culet.render")
        return _culet.load_stone(file, keys, material)
    if kind == "scene":
        return _culet.scene(os.fspath(file), None, keys, light, material, None)
    if kind == "picture":
        return Picture(_culet.read_picture(file))
    if not os.path.exists(file):
        raise InputError(f"{os.fspath(file)}: no such file")
    raise InputError(f"{os.fspath(file)}: is {_culet.words_for(file)}: culet.load takes stones, "
                     "meshes, cut designs, scenes and pictures")


def _stone_of(what: Union[Stone, Fit, File], material: str = "") -> Stone:
    if isinstance(what, Fit):
        what = what.stone
    if isinstance(what, Stone):
        return what.with_material(material) if material else what
    stone = load(what, material=material)
    if not isinstance(stone, Stone):
        raise InputError(f"{os.fspath(what)}: is no stone")
    return stone


def fit(
    stone: Union[Stone, File],
    *,
    iterations: Optional[int] = None,
    starts: Optional[int] = None,
    find_symmetry: bool = False,
    allow_topology: bool = False,
    meets: Optional[str] = None,
    loss: Optional[str] = None,
    start: Union[Stone, Fit, None] = None,
    progress: Optional[Progress] = None,
) -> Fit:
    """Fits a hand-made mesh to its readings, as `culet fit` does.

    stone: with readings: a stone file, or a mesh and Stone.with_readings.
    iterations: most steps of the last stage. starts: most starts to try.
    find_symmetry: propose the stone's symmetry (report["symmetry"]).
    allow_topology: edges and facets that the readings deny may change or go.
    meets: "exact", "soft" or "released"; loss: "none", "huber" or "cauchy"; None: the file's.
    start: an earlier result of the same stone, to go on from.
    """
    return fit_of(
        _culet.fit(
            _stone_of(stone),
            progress,
            iterations=iterations,
            starts=starts,
            find_symmetry=find_symmetry,
            allow_topology=allow_topology,
            meets=meets,
            loss=loss,
            start=None if start is None else _stone_of(start),
        )
    )


def scene(
    stone: Union[Stone, Fit, File],
    *,
    light: str = "",
    material: str = "",
    width_mm: Optional[float] = None,
    overrides: Iterable[str] = (),
) -> Scene:
    """A stone alone, seen face up.

    light: a preset's name (docs/gallery.md shows them) or an instrument's; "": a jeweller's.
    material: in place of the stone's. width_mm: of the narrower side of its outline, for designs
    without a size. overrides: keys of a scene file: ["camera.size=[640,480]"].
    """
    at_hand = _stone_of(stone, material)
    return _culet.scene("", at_hand, list(overrides), light, material, width_mm)


def _settings(
    engine: Optional[str],
    effects: Union[str, Sequence[str], None],
    tolerance: Optional[float],
    depth: Optional[int],
    check: Optional[str],
    size: Union[int, Tuple[int, int], None],
    overrides: Iterable[str],
) -> List[str]:
    keys = list(overrides)
    if engine is not None:
        keys.append(f'render.engine="{engine}"')
    if effects is not None:
        words = effects if isinstance(effects, str) else list(effects)
        keys.append("render.effects=" + json.dumps(words))
    if tolerance is not None:
        keys.append(f"render.tolerance={float(tolerance)!r}")
    if depth is not None:
        keys.append(f"render.depth={int(depth)}")
    if check is not None:
        keys.append(f'render.check="{check}"')
    if size is not None:
        width, height = (size, size) if isinstance(size, (int, np.integer)) else size
        keys.append(f"camera.size=[{int(width)},{int(height)}]")
    return keys


def render(
    what: Union[Scene, Stone, Fit, File],
    *,
    stone: Union[Stone, Fit, None] = None,
    light: str = "",
    material: str = "",
    width_mm: Optional[float] = None,
    size: Union[int, Tuple[int, int], None] = None,
    engine: Optional[str] = None,
    effects: Union[str, Sequence[str], None] = None,
    tolerance: Optional[float] = None,
    depth: Optional[int] = None,
    check: Optional[str] = None,
    spectral: bool = False,
    uncertainty: Optional[Fit] = None,
    draws: int = 100,
    seed: int = 1,
    threads: int = 0,
    overrides: Iterable[str] = (),
    progress: Optional[Progress] = None,
) -> Picture:
    """One picture of a scene, or of a stone in a light: an array (H, W, 3), see Picture.

    what: a Scene, a Stone, a Fit, or a file of one. stone: in place of the scene's own.
    light, material, width_mm: of a stone or a file; a Scene has its own.
    size: pixels, one number or (width, height). engine: auto, reference, beams, ... .
    effects: "auto", "all", "none" or names (dispersion, birefringence, polarization, absorption,
    pleochroism, aperture, coherence). tolerance: of the mean radiance; None: what some ten seconds
    allow. depth: faces on the longest path; 0: by tolerance. check: none, estimate or full.
    spectral: Picture.spectral (B, H, W), and where light is polarised Picture.stokes (4, B, H, W).
    uncertainty: the stone's Fit: Picture.planes then has mean and sigma over `draws` stones drawn
    from its covariance. seed, threads (0: all): the picture does not depend on the latter.
    """
    keys = _settings(engine, effects, tolerance, depth, check, size, overrides)
    if isinstance(what, Scene):
        if light or material or width_mm is not None:
            raise InputError("a Scene has its light, material and size: say them to culet.load or "
                             "culet.scene")
        drawn = what
    elif isinstance(what, (Stone, Fit)):
        drawn = scene(what, light=light, material=material, width_mm=width_mm)
    else:
        drawn = _culet.scene(os.fspath(what), None, [], light, material, width_mm)
    other = None if stone is None else _stone_of(stone)
    if keys or other is not None:
        drawn = drawn.with_settings(keys, other)
    unsure = None if uncertainty is None else uncertainty.stone
    return Picture(_culet.render(drawn, spectral, seed, threads, unsure, draws, progress))


def grade(
    stone: Union[Stone, Fit, File],
    *,
    material: str = "",
    index: Optional[float] = None,
    head: float = 10,
    tilts: Sequence[float] = tuple(range(-30, 31, 2)),
    draws: int = 30,
    seed: int = 1,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Grade:
    """What the cut does with light, as `culet grade`: the stone as it is given, not fitted.

    Of a Fit the figures have sigmas, from `draws` stones of its covariance (0: none).
    material: in place of the stone's; index: refractive index, in place of the material's.
    head: half angle of the viewer's head, degrees. tilts: degrees, of the curves.
    """
    text = _culet.grade(
        _stone_of(stone, material), index, head, list(tilts), draws, seed, threads, progress
    )
    return Grade(json.loads(text))


def _photo(picture: Any, name: str) -> _culet.Photo:
    if isinstance(picture, (str, os.PathLike)):
        return _culet.Photo.read(picture)
    return _culet.Photo.of_arrays(as_arrays(picture), name)


def compare(
    photo: Any,
    against: Any,
    *,
    mask: Any = None,
    ignore: Any = None,
    simulated: bool = False,
    find_pose: bool = True,
    calibrate: bool = False,
    budget: float = 30,
    draws: int = 8,
    cache: str = "",
    start: Union[Stone, Fit, File, None] = None,
    uncertainty: Optional[Fit] = None,
    seed: int = 1,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Comparison:
    """A photograph against a render or a scene, as `culet compare` does.

    photo: a file, or an array (H, W, 3) of linear light. against: a render (file, Picture or array;
    best a Picture, whose coverage tells the outline), or a Scene or scene file (.toml): then the
    stone's pose is found and the scene drawn in it.
    mask, ignore: files or arrays (H, W) of the photograph's size, over a half: where the stone is,
    and what is not to be compared. simulated: the photograph was computed; the report says so.
    Of scenes only: find_pose; calibrate: say what the scores mean for this stone, pose and light,
    within `budget` seconds of two processors (0: no limit), of at most `draws` a facet error, kept in `cache`;
    start: the mesh that the fit started from; uncertainty: the Fit of the scene's stone: how much of
    the photograph is within what its readings leave open.
    """
    seen = _photo(photo, "the photograph")
    if isinstance(against, (str, os.PathLike)) and os.fspath(against).endswith(".toml"):
        against = load(against)
    if isinstance(against, Scene):
        result = _culet.compare_scene(
            seen, against, mask, ignore, simulated, find_pose, calibrate, budget, draws, cache,
            None if start is None else _stone_of(start),
            None if uncertainty is None else uncertainty.stone, seed, threads, progress,
        )
    else:
        if calibrate:
            raise InputError("calibrate draws the stone anew: give the scene instead of a render")
        render_photo = _photo(against, "the render")
        result = _culet.compare_pictures(
            seen, render_photo, mask, ignore, simulated, seed, threads, progress
        )
    return comparison_of(result)
