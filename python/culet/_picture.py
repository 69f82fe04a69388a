"""Pictures as arrays that show themselves."""

from __future__ import annotations

import json
from typing import Any, Optional

import numpy as np

from . import _culet


class Picture(np.ndarray):
    """A picture in linear light: a numpy array (H, W, 3) of float32, sRGB primaries (white D65).

    In a notebook it shows itself. Beside the array there is, None where it is not known:

    coverage        (H, W): share of the pixel that the stone fills, 0 to 1
    wavelengths_nm  (B,): of the planes of `spectral` (render(..., spectral=True))
    spectral        (B, H, W): radiance relative to D65 at each wavelength
    stokes          (4, B, H, W): S0 (the radiance), S1, S2, S3, where light is polarised
    planes          dict of (H, W): further channels, such as `mean.R`, `sigma.Y` and the bands
                    `p02.Y` to `p98.Y` of render(..., uncertainty=fit)
    stats           dict: what was left out, the error bound, times (docs/rendering.md, STATS.json)
    usable          False: nobody found out how near the picture is, or its error bound is too low
    notes           list of lines that a person should know
    exposure        factor on linear light with which it is shown

    Parts of a picture (`picture[:100]`) and what is computed of it are arrays without these.
    """

    _about: dict

    def __new__(cls, arrays: dict) -> "Picture":
        picture = arrays["rgb"].view(cls)
        picture._about = {key: value for key, value in arrays.items() if key != "rgb"}
        if isinstance(picture._about.get("stats"), str):
            picture._about["stats"] = json.loads(picture._about["stats"])
        return picture

    def __array_finalize__(self, other: Any) -> None:
        self._about = {}

    def __reduce__(self) -> tuple:
        arrays = dict(self._about, rgb=np.asarray(self))
        return (Picture, (arrays,))

    @property
    def coverage(self) -> Optional[np.ndarray]:
        return self._about.get("coverage")

    @property
    def wavelengths_nm(self) -> Optional[np.ndarray]:
        return self._about.get("wavelengths_nm")

    @property
    def spectral(self) -> Optional[np.ndarray]:
        return self._about.get("spectral")

    @property
    def stokes(self) -> Optional[np.ndarray]:
        return self._about.get("stokes")

    @property
    def planes(self) -> dict:
        return self._about.get("planes", {})

    @property
    def stats(self) -> dict:
        return self._about.get("stats", {})

    @property
    def usable(self) -> bool:
        return self._about.get("usable", True)

    @property
    def notes(self) -> list:
        return self._about.get("notes", [])

    @property
    def exposure(self) -> Optional[float]:
        return self._about.get("exposure")

    def arrays(self) -> dict:
        """The picture as a dict of plain arrays: `rgb` and those above."""
        return dict(self._about, rgb=np.asarray(self))

    def save(self, file: Any, exposure: Optional[float] = None) -> None:
        """Writes .exr (linear, with spectral planes and all channels), .hdr or .png (8-bit sRGB).

        exposure: factor on linear light in a PNG; None: the picture's own.
        """
        _culet.save_picture(self.arrays(), file, self.exposure if exposure is None else exposure)

    def png(self, exposure: Optional[float] = None, alpha: bool = False) -> bytes:
        """The bytes of a PNG. alpha: with the stone's coverage as the file's alpha."""
        exposure = self.exposure if exposure is None else exposure
        return _culet.png(self.arrays(), exposure, alpha)

    def _repr_png_(self) -> Optional[bytes]:
        return self.png() if self.ndim == 3 and self.shape[2:] == (3,) and self.size else None


def as_arrays(picture: Any) -> dict:
    """Any array (H, W, 3), as the compiled half takes it."""
    return picture.arrays() if isinstance(picture, Picture) else {"rgb": np.asarray(picture)}
