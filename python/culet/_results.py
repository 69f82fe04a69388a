"""What fits, grades and comparisons come to: plain objects with arrays."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Optional

import numpy as np

from . import _culet


@dataclass(frozen=True)
class Fit:
    """A stone fitted to its readings. F is the number of facets of the mesh.

    Azimuths of level facets have no sigma (NaN).
    """

    status: str  #: converged, not_converged, contradictory or undetermined
    message: str  #: why, in one line
    usable: bool  #: True: converged
    stone: _culet.Stone  #: fitted, up direction +z, with its uncertainty
    facets: List[str]  #: names, in the order of the arrays
    inclinations: np.ndarray  #: (F,) degrees
    azimuths: np.ndarray  #: (F,) degrees
    offsets: np.ndarray  #: (F,) of the planes, in the stone's unit
    sigma_inclinations: np.ndarray  #: (F,) degrees, one standard uncertainty
    sigma_azimuths: np.ndarray  #: (F,) degrees
    sigma_offsets: np.ndarray  #: (F,) in the stone's unit, from the middle of the stone
    #: (3F, 3F): inclination, azimuth (degrees) and offset (unit), three rows per facet; None:
    #: unknown, or over 300 facets
    covariance: Optional[np.ndarray]
    summary: List[str]  #: what a cutter should know, one sentence each
    report: Dict[str, Any] = field(repr=False)  #: all of it (docs/measuring.md, FIT.json)


@dataclass(frozen=True)
class Grade:
    """What a cut does with light (docs/grade.md). `report` is the JSON of `culet grade --json`."""

    report: Dict[str, Any] = field(repr=False)

    def __getitem__(self, key: str) -> Any:
        """A figure of the report: grade["weighted_light_return"]."""
        return self.report[key]

    def keys(self) -> List[str]:
        """Names of what the report has."""
        return list(self.report)


@dataclass(frozen=True)
class Comparison:
    """How far a render is from a photograph, and what that means."""

    verdict: str  #: match, partial, no_evidence or refused
    reason: str  #: the verdict in one sentence
    usable: bool  #: False: the outlines do not fit, so scores mean nothing
    scores: Dict[str, Any] = field(repr=False)  #: all of it, as `culet compare --json`
    #: Arrays in the frame of the photograph's close-up. (H, W, 3): photo and render. (H, W), NaN
    #: where nothing is compared: luminance_difference (-1 to 1), colour_difference (CIEDE2000),
    #: visible_difference (FLIP, 0 to 1), similarity (SSIM), and within_readings (0: within one
    #: sigma of the readings' uncertainty, 0.5: within two, 1: outside)
    maps: Dict[str, np.ndarray] = field(repr=False)
    page: str = field(repr=False)  #: the report as one HTML page

    def save(self, file: Any) -> None:
        """Writes the report page, one HTML file that needs no network."""
        Path(file).write_text(self.page, encoding="utf-8")


def fit_of(result: _culet.FitResult) -> Fit:
    names = [name for name in Fit.__dataclass_fields__ if name != "report"]
    return Fit(report=json.loads(result.report), **{name: getattr(result, name) for name in names})


def comparison_of(result: _culet.ComparisonResult) -> Comparison:
    return Comparison(
        verdict=result.verdict,
        reason=result.reason,
        usable=result.usable,
        scores=json.loads(result.scores),
        maps=result.maps,
        page=result.page,
    )
