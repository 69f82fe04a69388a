#include "bench/studies/table_flip.h"

#include <cmath>

#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"

namespace culet {

ScopeBands diamond_webgl_bands() {
    ScopeBands bands = aset_bands();
    bands.eye = std::acos(0.98);
    bands.inner = std::acos(0.70);
    return bands;
}

double table_flip_deg(double n) {
    // Red where the pavilion is steep.
    double flat = 39, steep = 43;
    while (steep - flat > 1e-6) {
        const double middle = 0.5 * (flat + steep);
        const Solid solid = make_cut("round-brilliant", {{"pavilion-angle", middle}});
        const EyeLight light = EyeLightTracer(solid).trace({0, 0, 1}, n);
        const bool red = table_reflection(light, find_facet(solid, "T")).colour[0] == 'r';
        (red ? steep : flat) = middle;
    }
    return 0.5 * (flat + steep);
}

double closed_form_table_flip_deg(double n) {
    return (180 - degrees(std::asin(std::sin(radians(k_aset_red_deg)) / n))) / 4;
}

}  // namespace culet
