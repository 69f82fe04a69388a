#pragma once
// Scenes for the studies.

#include <string>
#include <vector>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"

namespace culet {

/// A stone face up in a named light, `pixels` square. The picture is not checked, and the tolerance
/// is the scenes' default.
Scene face_up(const Solid& solid, const Material& material, const std::string& light, int pixels);

/// Red, green and blue of Voelker & Hamann.
inline const std::vector<double> k_three_wavelengths{445, 540, 620};

/// A clear or coloured stone seen from a distance of `diameters`, in smooth light (bench_scenes.h),
/// to `depth` with nothing cut; one wavelength, no polarisation.
Scene tree_scene(const Solid& solid, const Material& material, double diameters, int pixels,
                 int depth);

/// A stone in four prongs of a gold ring, as `culet setting` makes it. `material`: catalogue name
/// or file.
Scene in_ring(const Solid& solid, const std::string& material, int pixels);

/// Mean luminance difference over the stone's pixels, relative to their mean.
double mean_difference(const Picture& picture, const Picture& truth);

/// Absolute difference of each pixel, in grey.
Picture difference_picture(const Picture& picture, const Picture& truth);

/// Facets like a brilliant's but without its symmetry: planes tangent to two half ellipsoids, in
/// rings. 93 or 115 facets, as many as Guy & Soler's two stones.
Solid stone_of_facets(int facets);

}  // namespace culet
