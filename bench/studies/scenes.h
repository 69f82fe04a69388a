#pragma once
// Scenes that studies draw.

#include <string>
#include <vector>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"

namespace culet {

/// A stone face up in a light by name, `pixels` square. Nothing is checked after it is drawn, and
/// the tolerance is that of scenes.
Scene face_up(const Solid& solid, const Material& material, const std::string& light, int pixels);

/// Red, green and blue of Voelker & Hamann.
inline const std::vector<double> k_three_wavelengths{445, 540, 620};

/// A clear or coloured stone from so many of its diameters away, in smooth light (bench_scenes.h),
/// to that depth with nothing cut; one wavelength, no polarisation.
Scene tree_scene(const Solid& solid, const Material& material, double diameters, int pixels,
                 int depth);

/// A stone in four prongs of a gold ring, as `culet setting` makes it. `material`: of the
/// catalogue, or a file.
Scene in_ring(const Solid& solid, const std::string& material, int pixels);

/// Mean of |luminance|'s difference over the stone's pixels, over their mean.
double mean_difference(const Picture& picture, const Picture& truth);

/// |difference| of each pixel, in grey.
Picture difference_picture(const Picture& picture, const Picture& truth);

/// Brilliants' facets without a brilliant's symmetry: planes tangent to two half ellipsoids, in
/// rings. 93 or 115 facets, as many as Guy & Soler's two stones.
Solid stone_of_facets(int facets);

}  // namespace culet
