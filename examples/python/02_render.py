# %% [markdown]
# # Pictures of a stone
# A picture is an array of linear light. In a notebook it shows itself.

# %%
import sys
from pathlib import Path

import numpy as np

import culet

samples = Path(sys.argv[1] if len(sys.argv) > 1 else "samples")
out = Path(sys.argv[2] if len(sys.argv) > 2 else ".")
stone = culet.load(samples / "studies" / "brilliant.obj", material="diamond")

# %% In a jeweller's light, and as an ASET shows it.
picture = culet.render(stone, light="jeweller", size=200)
picture.save(out / "brilliant.png")
aset = culet.render(stone, light="aset", size=200)
print(f"error bound {picture.stats['error_bound']:.3f} of the mean radiance")

# %% Green of an ASET is light from the side, red from above: shares of the stone's pixels.
inside = aset.coverage > 0.99
brightest = np.asarray(aset)[inside].argmax(axis=1)
for colour, channel in (("red", 0), ("green", 1), ("blue", 2)):
    print(f"{colour:5s} {np.mean(brightest == channel):.2f}")

# %% A turntable: one scene, several views.
scene = culet.scene(stone, light="jeweller")
for i, azimuth in enumerate(np.radians([0, 10, 20])):
    eye = [40 * np.sin(0.3) * np.cos(azimuth), 40 * np.sin(0.3) * np.sin(azimuth), 40 * np.cos(0.3)]
    view = scene.with_settings([f"camera.position={eye}"])
    culet.render(view, size=120, engine="beams", tolerance=0.1).save(out / f"view-{i}.png")
