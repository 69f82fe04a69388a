# %% [markdown]
# # A stone from its readings
# Twenty-six readings of an evening become a stone whose every facet has a standard uncertainty.

# %%
import sys
from pathlib import Path

import numpy as np

import culet

samples = Path(sys.argv[1] if len(sys.argv) > 1 else "samples")
stone = culet.load(samples / "cutters-evening" / "mended.toml")
print(stone)

# %% The fit, and what a cutter should know of it.
fit = culet.fit(stone)
print(fit.status)
print("\n".join(fit.summary))

# %% Facets with their sigmas: arrays, degrees.
for name, angle, sigma in zip(fit.facets, fit.inclinations, fit.sigma_inclinations):
    print(f"{name:6s} {angle:7.3f} +- {sigma:.3f}")

# %% What is known together: correlation of the inclinations, from the covariance.
variance = fit.covariance[::3, ::3]
known = np.diag(variance) > 0
sigma = np.sqrt(np.diag(variance)[known])
correlation = variance[np.ix_(known, known)] / np.outer(sigma, sigma)
strongest = np.abs(correlation - np.eye(len(sigma))).max()
print(f"strongest correlation of two facets: {strongest:.2f}")

# %% A reading with a slip of the pen is named.
rows = stone.readings
slipped = next(i for i, row in enumerate(rows) if row["kind"] == "inclination")
rows[slipped]["value"] = rows[slipped]["value"] + 3
doubtful = culet.fit(stone.with_readings(rows))
print(doubtful.status, doubtful.report["suspects"], doubtful.report.get("doubts"))
