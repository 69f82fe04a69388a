# %% [markdown]
# # What an angle does to a cut
# The pavilion of a brilliant, steeper and flatter: stones of planes, graded.

# %%
import sys
from pathlib import Path

import numpy as np

import culet

samples = Path(sys.argv[1] if len(sys.argv) > 1 else "samples")
stone = culet.load(samples / "studies" / "brilliant.obj")
below = (stone.normals[:, 2] < -0.1) & (stone.inclinations > 1)


def with_steeper_pavilion(degrees):
    """All pavilion facets turned by so much about their line on the girdle's plane."""
    normals, offsets = stone.normals.copy(), stone.offsets.copy()
    for i in np.flatnonzero(below):
        level = np.hypot(*normals[i, :2])
        out = np.array([*(normals[i, :2] / level), 0])
        foot = out * offsets[i] / level  # where the facet's steepest line meets z = 0
        angle = np.radians(stone.inclinations[i] + degrees)
        normals[i] = out * np.sin(angle) - [0, 0, np.cos(angle)]
        offsets[i] = normals[i] @ foot
    return culet.Stone.of_planes(normals, offsets, stone.facets, material="diamond")


# %%
for turn in (0.0, 2.0):
    grade = culet.grade(with_steeper_pavilion(turn), tilts=[0])
    print(f"{turn:+.1f} degrees: weighted light return {grade['weighted_light_return']:.3f}")
