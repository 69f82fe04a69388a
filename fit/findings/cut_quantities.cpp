#include "fit/findings/cut_quantities.h"

#include <cmath>

#include "stone/design/cut_measures.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Half diameters: step of central differences. Rounding leaves 1e-9 of a slope; shorter edges have
// no slope.
constexpr double k_step = 1e-7;

CutMeasures measures_of(const FitModel& model, const Shape& shape, const Outline& outline,
                        const std::vector<Vec3>& at) {
    const Stone& stone = model.stone();
    CutRoles roles = cut_roles(stone.solid, stone.up);
    Solid fitted;
    fitted.vertices = at;
    for (std::size_t f = 0; f < outline.loops.size(); ++f)
        fitted.facets.push_back({"", {shape.normals[f], 0}, outline.loops[f]});
    return {fitted, roles};
}

std::vector<CutQuantity> lengths_of(const CutMeasures& measures, const FitModel& model,
                                    const Shape& shape, const Outline& outline,
                                    std::vector<Vec3>& at) {
    std::vector<CutQuantity> all;
    std::vector<double> scales;
    for (const CutMeasure& measure : measures.lengths(at)) {
        const bool length = measure.unit == "length";
        scales.push_back(length ? model.frame().scale() : 1);
        all.push_back({measure.name,
                       length ? std::string(name_of(model.stone().unit)) : measure.unit,
                       {scales.back() * measure.value, {}}});
    }
    for (const int c : measures.decisive()) {
        std::vector<Vec3> slopes(all.size(), Vec3(0));
        for (int k = 0; k < 3; ++k) {
            double& moved = at[std::size_t(c)][k];
            const double here = moved;
            moved = here + k_step;
            const auto ahead = measures.lengths(at);
            moved = here - k_step;
            const auto behind = measures.lengths(at);
            moved = here;
            for (std::size_t q = 0; q < all.size(); ++q)
                slopes[q][k] = scales[q] * (ahead[q].value - behind[q].value) / (2 * k_step);
        }
        for (std::size_t q = 0; q < all.size(); ++q) {
            if (slopes[q] == Vec3(0)) continue;
            add_corner(all[q].quantity, shape, outline.corners[std::size_t(c)], slopes[q]);
        }
    }
    return all;
}

}  // namespace

std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) {
    std::vector<Vec3> at;
    for (const Corner& c : outline->corners) at.push_back(place_of(shape, c));
    const CutMeasures measures = measures_of(model, shape, *outline, at);
    std::vector<CutQuantity> all = lengths_of(measures, model, shape, *outline, at);
    if (all.empty()) return all;
    const Stone& stone = model.stone();
    for (const CutMeasures::Angle& angle : measures.angles()) {
        all.push_back({angle.name, "deg", {}});
        for (const auto& [f, factor] : angle.of)
            all.back().quantity.add(tilt_from_up(f)(shape), factor);
    }
    const Quantity inside = enclosed_volume(outline)(shape);
    const double mm3 = std::pow(model.frame().scale() * mm_per(stone.unit), 3);
    const auto put_size = [&](const char* name, const char* unit, double factor) {
        all.push_back({name, unit, {}});
        all.back().quantity.add(inside, factor);
    };
    put_size("volume", "mm3", mm3);
    if (const auto density = stone.material.density_g_cm3) {
        put_size("weight", "ct", carat(mm3, *density));
    }
    return all;
}

}  // namespace culet
