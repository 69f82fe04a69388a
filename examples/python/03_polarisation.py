# %% [markdown]
# # Polarised light
# Each wavelength has a Stokes vector. At Brewster's angle a facet reflects one direction of
# vibration alone.

# %%
import sys
from pathlib import Path

import numpy as np

import culet

samples = Path(sys.argv[1] if len(sys.argv) > 1 else "samples")
picture = culet.render(samples / "effects" / "brewster.toml", size=60, spectral=True)
bands, height, width = picture.spectral.shape
print(f"{bands} wavelengths: {picture.wavelengths_nm} nm")

# %% Degree of linear polarisation, of each pixel and wavelength.
s0, s1, s2, s3 = picture.stokes
lit = s0 > 0.01 * s0.max()
degree = np.zeros_like(s0)
degree[lit] = np.sqrt(s1[lit] ** 2 + s2[lit] ** 2) / s0[lit]
print(f"degree of polarisation up to {degree.max():.3f}")

# %% The spectrum of the brightest pixel.
y, x = np.unravel_index(picture.spectral.sum(axis=0).argmax(), (height, width))
for wavelength, radiance in zip(picture.wavelengths_nm, picture.spectral[:, y, x]):
    print(f"{wavelength:6.1f} nm {radiance:.4f}")
