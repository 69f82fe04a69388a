#include "fit/readings/reading_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/solid/half_edges.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Overall lengths of stone and mesh agree within tens of per cent: a ratio near that of two units
// is a slip.
void refuse_other_unit(const Reading& reading, const Stone& stone) {
    double of_mesh = 0;
    if (reading.kind == ReadingKind::depth) {
        of_mesh = width_along(stone.solid, stone.up);
    } else if (reading.kind == ReadingKind::width) {
        // Any girdle direction is good enough for a factor of ten.
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

// Logarithms of reading / mesh in the readings' order, and the first reading.
struct SizeRatios {
    std::vector<double> logs;
    const Reading* first = nullptr;

    void add(const Reading& reading, double of_mesh) {
        if (!(of_mesh > 0) || !(reading.value > 0)) return;
        logs.push_back(std::log(reading.value / of_mesh));
        if (first == nullptr) first = &reading;
    }
    double middle() const { return upper_median(logs); }
};

SizeRatios size_ratios_of_overall_lengths(const std::vector<Reading>& readings,
                                          const Stone& stone) {
    SizeRatios ratios;
    for (const Reading& r : readings) {
        if (r.kind == ReadingKind::depth) ratios.add(r, width_along(stone.solid, stone.up));
        if (r.kind == ReadingKind::width) ratios.add(r, diameter(stone.solid));
    }
    return ratios;
}

// Fewer overall lengths cannot outvote the mesh.
constexpr std::size_t k_enough_lengths = 3;
// A mesh in the stone's own unit is not off by such a factor.
constexpr double k_other_size = 2.5;
// Wrong proportions of a mesh explain less than this factor.
constexpr double k_one_size = 8;

// True if overall lengths agree on another size: the mesh has another unit, which does not matter,
// since only its shape counts.
bool mesh_is_in_another_unit(const SizeRatios& overall) {
    if (overall.logs.size() < k_enough_lengths) return false;
    const auto [least, most] = std::minmax_element(overall.logs.begin(), overall.logs.end());
    return std::abs(overall.middle()) > std::log(k_other_size) &&
           *most - *least < std::log(k_one_size);
}

// True if most overall lengths agree with each other and the mesh. Another one is a slip that the
// first check names (first_check.h), no matter of units.
bool most_lengths_agree(const SizeRatios& overall) {
    if (overall.logs.size() < k_enough_lengths) return false;
    const double middle = overall.middle();
    const auto near = std::count_if(overall.logs.begin(), overall.logs.end(),
                                    [&](double l) { return std::abs(l - middle) < std::log(2.0); });
    return std::abs(middle) < std::log(k_other_size) &&
           2 * near > std::ptrdiff_t(overall.logs.size());
}

SizeRatios size_ratios_of_edges(const std::vector<Reading>& readings, const Stone& stone) {
    SizeRatios ratios;
    std::map<std::pair<int, int>, double> lengths;
    for (const Edge& e : half_edges(stone.solid).edges) {
        lengths[std::minmax(e.left, e.right)] =
            glm::length(stone.solid.vertices[e.from] - stone.solid.vertices[e.to]);
    }
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::edge || r.facets.size() != 2) continue;
        const auto found = lengths.find(std::minmax(r.facets[0], r.facets[1]));
        if (found != lengths.end()) ratios.add(r, found->second);
    }
    return ratios;
}

// Even a rough mesh's edges are not wrong by this factor against its widths.
constexpr double k_two_units = 8;
constexpr std::size_t k_enough_edges = 5;

void refuse_lengths_of_two_units(const SizeRatios& overall, const SizeRatios& edges,
                                 const Stone& stone) {
    if (overall.logs.empty() || edges.logs.size() < k_enough_edges) return;
    const double apart = overall.middle() - edges.middle();
    if (std::abs(apart) < std::log(k_two_units)) return;
    const bool few_overall = overall.logs.size() < edges.logs.size();
    const Reading& named = few_overall ? *overall.first : *edges.first;
    throw InputError(
        named.file, named.line,
        fmt::format("{} '{}' and others like it are about {:.3g} times too {} for the {} {}: is "
                    "one kind in another unit? Every length must be in the stone's unit ({})",
                    name_of(named.kind), named.id, std::exp(std::abs(apart)),
                    (apart < 0) == few_overall ? "small" : "large",
                    few_overall ? edges.logs.size() : overall.logs.size(),
                    few_overall ? "edges that were read" : "widths and depths that were read",
                    name_of(stone.unit)));
}

// A rough mesh may be collapsed to a twentieth of its volume, but not further.
constexpr double k_impossible_volume = 100;

void refuse_impossible_volume(const Reading& reading, const Stone& stone, double larger) {
    const bool weighed = reading.kind == ReadingKind::weight;
    const double mm3 =
        std::abs(volume(stone.solid)) * std::pow(std::exp(larger) * mm_per(stone.unit), 3);
    const double expected = weighed ? carat(mm3, stone.material.density_g_cm3.value_or(0)) : mm3;
    if (!(expected > 0) || !(reading.value > 0)) return;
    const double ratio = reading.value / expected;
    if (std::max(ratio, 1 / ratio) < k_impossible_volume) return;
    throw InputError(
        reading.file, reading.line,
        fmt::format("{} '{}' is {:g} {}, but a stone of this mesh's shape and of the lengths that "
                    "were read has about {:.3g}; check the value{}",
                    name_of(reading.kind), reading.id, reading.value, weighed ? "ct" : "mm3",
                    expected,
                    weighed ? ", its unit (carat) and the density" : " and its unit (mm3)"));
}

}  // namespace

void refuse_other_units(const std::vector<Reading>& readings, const Stone& stone) {
    const SizeRatios overall = size_ratios_of_overall_lengths(readings, stone),
                     edges = size_ratios_of_edges(readings, stone);
    const bool agree = most_lengths_agree(overall);
    if (!agree && !mesh_is_in_another_unit(overall)) {
        for (const Reading& reading : readings) refuse_other_unit(reading, stone);
    }
    refuse_lengths_of_two_units(overall, edges, stone);
    if (agree) return;
    const SizeRatios& lengths = overall.logs.empty() ? edges : overall;
    const double larger = lengths.logs.empty() ? 0 : lengths.middle();
    for (const Reading& r : readings) {
        if (r.kind == ReadingKind::volume || r.kind == ReadingKind::weight) {
            refuse_impossible_volume(r, stone, larger);
        }
    }
}

}  // namespace culet
