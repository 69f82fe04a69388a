#include "fit/reading_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/errors.h"

namespace culet {

namespace {

// Overall lengths of a stone and of its mesh agree within tens of per cent, whoever modelled it. A
// factor near one between two units is a slip of units, not a finding.
void refuse_other_unit(const Reading& reading, const Stone& stone) {
    double of_mesh = 0;
    if (reading.kind == ReadingKind::depth) {
        of_mesh = width_along(stone.solid, stone.up);
    } else if (reading.kind == ReadingKind::width) {
        // Any girdle direction will do to tell a factor of ten.
        of_mesh = diameter(stone.solid);
    } else if (reading.kind == ReadingKind::table_width) {
        const int table = find_facet(stone.solid, stone.up_facet);
        if (table < 0) return;
        Vec3 low(1e300), high(-1e300);
        for (int corner : stone.solid.facets[table].corners) {
            low = glm::min(low, stone.solid.vertices[corner]);
            high = glm::max(high, stone.solid.vertices[corner]);
        }
        of_mesh = glm::length(high - low) / std::numbers::sqrt2;
    } else {
        return;
    }
    if (!(of_mesh > 0)) return;
    const double ratio = reading.value / of_mesh;
    const double apart = std::max(ratio, 1 / ratio);
    static constexpr std::array<double, 4> factors{10, 25.4, 100, 1000};
    for (double factor : factors) {
        if (apart < factor / 1.5 || apart > factor * 1.5) continue;
        std::string guess;
        for (const LengthUnit unit :
             {LengthUnit::mm, LengthUnit::cm, LengthUnit::m, LengthUnit::inch}) {
            // value [unit] in the stone's unit would be value * mm_per(unit) / mm_per(stone.unit)
            const double wanted = mm_per(unit) / mm_per(stone.unit) * ratio;
            if (wanted > 1 / 1.5 && wanted < 1.5) guess = name_of(unit);
        }
        throw InputError(
            reading.file, reading.line,
            fmt::format("{} '{}' is {:g} {}, but the mesh measures {:.4g}: about {:g} times {}{}",
                        name_of(reading.kind), reading.id, reading.value, name_of(stone.unit),
                        of_mesh, factor, ratio > 1 ? "less" : "more",
                        guess.empty() ? "; check `unit` of [stone]"
                                      : fmt::format("; is the reading in {}? Every length must be "
                                                    "in the stone's unit ({})",
                                                    guess, name_of(stone.unit))));
    }
    if (apart > 5) {
        throw InputError(reading.file, reading.line,
                         fmt::format("{} '{}' is {:g} {}, but the mesh measures {:.4g}; check the "
                                     "value and `unit` of [stone]",
                                     name_of(reading.kind), reading.id, reading.value,
                                     name_of(stone.unit), of_mesh));
    }
}

// Three or more overall lengths that all ask for the same other size: then it is the mesh that was
// drawn in another unit, which is no matter, since only its shape counts.
bool mesh_is_in_another_unit(const std::vector<Reading>& readings, const Stone& stone) {
    std::vector<double> ratios;
    for (const Reading& r : readings) {
        const double mine = r.kind == ReadingKind::depth   ? width_along(stone.solid, stone.up)
                            : r.kind == ReadingKind::width ? diameter(stone.solid)
                                                           : 0;
        if (mine > 0 && r.value > 0) ratios.push_back(r.value / mine);
    }
    if (ratios.size() < 3) return false;
    std::sort(ratios.begin(), ratios.end());
    const double middle = ratios[ratios.size() / 2];
    // Proportions that are drawn wrong by half and more count for less than that.
    return std::max(middle, 1 / middle) > 2.5 && ratios.back() < 8 * ratios.front();
}

}  // namespace

void refuse_other_units(const std::vector<Reading>& readings, const Stone& stone) {
    if (mesh_is_in_another_unit(readings, stone)) return;
    for (const Reading& reading : readings) refuse_other_unit(reading, stone);
}

}  // namespace culet
