"""culet: a real gemstone as a model one can trust.

    import culet

    fit = culet.fit(culet.load("stone.toml"))     # facets from readings, with their sigmas
    picture = culet.render(fit.stone, light="jeweller")
    grade = culet.grade(fit)
    comparison = culet.compare("photo.tif", culet.load("scene.toml"))

Arrays are numpy's. Lengths are in the stone's unit (mm, unless its file says otherwise), angles in
degrees, wavelengths in nm, pictures in linear light, rows from the top. Errors of input are
`culet.InputError`, one line with file, line and what to do. All work is ended by Ctrl-C, runs
without Python's global lock, and tells `progress`, a callable that is given the fraction done, 0 to
1; where that returns False the work ends with `culet.Interrupted`. Same input, same result, whatever
the number of threads.
"""

from ._culet import InputError, InternalError, Interrupted, Scene, Stone, version as __version__
from ._functions import compare, fit, grade, load, render, scene
from ._picture import Picture
from ._results import Comparison, Fit, Grade

for _thing in (InputError, InternalError, Interrupted, Scene, Stone):
    _thing.__module__ = "culet"

__all__ = [
    "Comparison",
    "Fit",
    "Grade",
    "InputError",
    "InternalError",
    "Interrupted",
    "Picture",
    "Scene",
    "Stone",
    "compare",
    "fit",
    "grade",
    "load",
    "render",
    "scene",
]
