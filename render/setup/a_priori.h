#pragma once
// Bounds on an effect's influence that need no drawing.

#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// True if one unpolarised radiance comes from all directions. Then only absorption and depth have
/// an influence, because the weights of all light paths sum to 1.
bool same_light_everywhere(const Lights& lights);

/// Largest difference of the index over the wavelengths, and of two principal indices at the D
/// line; relative to the outside's index, as is `mean`.
struct IndexSpans {
    double dispersion = 0, birefringence = 0, mean = 1.5;
};
IndexSpans index_spans(const Scene& scene);

/// Largest change of the exit direction (radians) for a change `span` of the index, at any depth:
/// |dK| <= dn m / sqrt(m^2 - 1), m the smaller index.
double exit_deviation(double span, double index);

/// Distance of the two waves' images of the stone's far side, pixels; their angle is at most about
/// |n1 - n2| (1/n + 1/sqrt(n^2 - 1)) (Snell's law and walk-off). `index`: mean of the two, relative
/// to the outside; NaN below 1.
double images_apart(const Scene& scene, double index, double birefringence);
double images_apart(const Scene& scene);

/// Length of one pixel at the stone's middle.
double pixel_on_stone(const Scene& scene);

/// Largest blur of a point of the stone by the aperture, pixels: 2 A |z - zf| / zf.
double aperture_blur(const Scene& scene);

/// Largest part of the light absorbed in one pass through the stone: 1 - exp(-K d).
double absorbed_across(const Scene& scene);
/// Largest retardation between a crystal's waves in one pass, in waves (D line).
double retardation_in_waves(const Scene& scene);
/// Largest difference of decadic absorbance between two principal rays in one pass.
double absorbance_apart(const Scene& scene);

}  // namespace culet
