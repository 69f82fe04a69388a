#pragma once
// What is known of an effect before anything is drawn: when leaving it out changes nothing, and how
// much it can change at most.

#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// One unpolarised radiance from all directions. Then every effect but absorption and depth drops
/// out exactly, because the weights of all light paths sum to 1.
bool same_light_everywhere(const Lights& lights);

/// Largest difference of the refractive index over the wavelengths, and of two principal indices at
/// one wavelength (D line), over the outside's.
struct IndexSpans {
    double dispersion = 0, birefringence = 0, mean = 1.5;
};
IndexSpans index_spans(const Scene& scene);

/// Largest change of the direction in which light leaves, radians, of a change `span` of the index:
/// |dK| <= dn m / sqrt(m^2 - 1), m the smaller index, whatever the depth.
double exit_deviation(double span, double index);

/// How far apart the two waves' images of the stone's far side lie, pixels: the angle between them
/// is about |n1 - n2| (1/n + 1/sqrt(n^2 - 1)) at most (Snell's law and the walk-off), over the
/// stone's size. `index` is the mean of the two, over the outside's; NaN below 1.
double images_apart(const Scene& scene, double index, double birefringence);
double images_apart(const Scene& scene);

/// Length of one pixel at the stone's middle.
double pixel_on_stone(const Scene& scene);

/// Largest blur of a point of the stone by the aperture, pixels: 2 A |z - zf| / zf.
double aperture_blur(const Scene& scene);

/// Largest share of light that one pass through the stone loses: 1 - exp(-K d).
double absorbed_across(const Scene& scene);
/// Waves that one of a crystal's two lags behind the other on one way across, at most (D line).
double waves_behind(const Scene& scene);
/// Largest difference of two principal rays' absorbance (decadic) on one way across.
double absorbance_apart(const Scene& scene);

}  // namespace culet
