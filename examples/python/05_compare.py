# %% [markdown]
# # A photograph against a render
# Here the photograph is computed as well: the same stone with noise, two pixels further right.

# %%
import sys
from pathlib import Path

import numpy as np

import culet

samples = Path(sys.argv[1] if len(sys.argv) > 1 else "samples")
out = Path(sys.argv[2] if len(sys.argv) > 2 else ".")
render = culet.render(samples / "effects" / "garnet-depth.toml", size=160, engine="beams")
noise = np.random.default_rng(1).normal(0, 0.01 * np.mean(render), render.shape)
photograph = np.roll(np.maximum(np.asarray(render) + noise, 0), 2, axis=1)

# %% Registered by the outlines, scored, and held against chance.
compared = culet.compare(photograph, render, simulated=True,
                         mask=np.roll(render.coverage > 0.5, 2, axis=1))
print(compared.verdict, "-", compared.reason)
for name, score in compared.scores["scores"].items():
    print(name, score)

# %% Where they differ, pixel by pixel, and the whole report.
difference = compared.maps["visible_difference"]
print(f"visible difference: {np.nanmean(difference):.3f} in the mean, "
      f"{np.nanmax(difference):.3f} at most")
compared.save(out / "report.html")
