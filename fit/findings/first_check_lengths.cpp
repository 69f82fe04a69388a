// Calipers and scale beside each other and the mesh's proportions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "fit/findings/first_check_parts.h"
#include "fit/model/azimuth_turn.h"

namespace culet {

namespace {

// How much honest ones differ, in logarithms: widths of one stone after its mesh's outline; a table
// measured at several azimuths; and against the scale of the widths the depth, the table and the
// volume, whose proportions are off by a few per cent each.
constexpr double k_widths = 0.007, k_tables = 0.01, k_depth = 0.03, k_table = 0.04;
constexpr double k_volume = 0.06, k_others = 0.04;
// So many times more beside a mesh that was drawn by hand.
constexpr double k_drawn = 4;

struct Length {
    Row row;
    double ratio = 0;  ///< log of read over drawn
    double drawn = 0;
    ReadingKind kind = ReadingKind::width;
    long line = 0;  ///< of the file: readings of one row are one number

    bool shares_row(const Length& other) const { return line > 0 && line == other.line; }
};

double drawn_width(const Stone& stone, const Reading& r, double turn) {
    if (r.has_direction) return width_along(stone.solid, r.direction);
    const double a = r.azimuth - turn;
    return width_along(stone.solid, Vec3{std::cos(a), std::sin(a), 0});
}

double drawn_table(const Stone& stone, const Reading& r, double turn) {
    const int table = find_facet(stone.solid, stone.up_facet);
    if (table < 0) return 0;
    const double a = r.azimuth - turn;
    double low = 1e300, high = -1e300;
    for (const int corner : stone.solid.facets[std::size_t(table)].corners) {
        const double along =
            glm::dot(Vec3{std::cos(a), std::sin(a), 0}, stone.solid.vertices[std::size_t(corner)]);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return high - low;
}

std::vector<Length> lengths_of(const Stone& stone, const std::vector<Reading>& readings) {
    const double turn = azimuth_turn(
        readings, [&](int facet) { return stone.solid.facets[std::size_t(facet)].plane.normal; },
        stone.azimuth_from_mesh);
    std::vector<Length> lengths;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& r = readings[i];
        if (r.exact || r.aggregate != Aggregate::single || !(r.value > 0)) continue;
        double drawn = 0;
        if (r.kind == ReadingKind::width) drawn = drawn_width(stone, r, turn);
        if (r.kind == ReadingKind::table_width) drawn = drawn_table(stone, r, turn);
        if (r.kind == ReadingKind::depth) drawn = width_along(stone.solid, stone.up);
        if (!(drawn > 0)) continue;
        lengths.push_back(
            {{{i}, r.value, r.sigma}, std::log(r.value / drawn), drawn, r.kind, r.line});
    }
    return lengths;
}

std::vector<double> ratios_of(const std::vector<Length>& lengths, ReadingKind kind,
                              const Length* but = nullptr) {
    std::vector<double> ratios;
    for (const Length& l : lengths) {
        const bool is_other = but == nullptr || (&l != but && !l.shares_row(*but));
        if (l.kind == kind && is_other) ratios.push_back(l.ratio);
    }
    return ratios;
}

Expected from_ratios(const Length& own, const std::vector<double>& ratios, double floor,
                     const std::string& by) {
    const double scatter = std::max(floor, robust_sigma(ratios));
    const double value = own.drawn * std::exp(median(ratios));
    return {value, value * scatter * std::sqrt(1 + 1.5708 / double(ratios.size())), by};
}

// What a volume or weight would be by the mesh and by how much larger the stone is.
double expected_volume(const Stone& stone, ReadingKind kind, double log_larger) {
    const double mm3 = volume(stone.solid) * std::pow(mm_per(stone.unit), 3) * std::exp(log_larger);
    return kind == ReadingKind::weight ? carat(mm3, stone.material.density_g_cm3.value_or(0)) : mm3;
}

bool is_volume(const Reading& r) {
    return (r.kind == ReadingKind::weight || r.kind == ReadingKind::volume) && !r.exact;
}

// Log of read over drawn, of the first that was read.
std::optional<double> volume_ratio(const Stone& stone, const std::vector<Reading>& readings) {
    for (const Reading& r : readings) {
        const double drawn = is_volume(r) ? expected_volume(stone, r.kind, 0) : 0;
        if (drawn > 0 && r.value > 0) return std::log(r.value / drawn);
    }
    return std::nullopt;
}

void check_volumes(const Stone& stone, const std::vector<Reading>& readings,
                   const std::vector<Length>& lengths, double sigma, std::vector<Doubt>& doubts) {
    // Lengths that are themselves in doubt say nothing of the weight.
    std::vector<Length> believed;
    for (const Length& l : lengths) {
        const bool doubted = std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& d) {
            return d.reading == l.row.readings[0];
        });
        if (!doubted) believed.push_back(l);
    }
    const std::vector<double> widths = ratios_of(believed, ReadingKind::width),
                              depths = ratios_of(believed, ReadingKind::depth);
    if (widths.empty()) return;
    const double larger = 2 * median(widths) + median(depths.empty() ? widths : depths);
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& r = readings[i];
        const double value = is_volume(r) ? expected_volume(stone, r.kind, larger) : 0;
        if (!(value > 0)) continue;
        doubt_if_far(readings, {{i}, r.value, r.sigma},
                     {value, sigma * value,
                      fmt::format("a stone of these widths and this depth {} ({:.4g})",
                                  r.kind == ReadingKind::weight ? "weighs" : "has", value)},
                     doubts);
    }
}

}  // namespace

void check_lengths(const Stone& stone, const std::vector<Reading>& readings, bool is_design,
                   std::vector<Doubt>& doubts) {
    const double rough = is_design ? 1 : k_drawn;
    const std::vector<Length> lengths = lengths_of(stone, readings);
    const std::vector<double> widths = ratios_of(lengths, ReadingKind::width);
    const std::optional<double> weighed = volume_ratio(stone, readings);
    constexpr std::size_t k_enough = 2;  // others: of one other one cannot say which is wrong
    for (const Length& own : lengths) {
        const std::vector<double> sisters = ratios_of(lengths, own.kind, &own);
        const auto among = [&](double floor, const char* what) {
            const Expected e = from_ratios(own, sisters, floor, "");
            doubt_if_far(
                readings, own.row,
                {e.value, e.sigma, fmt::format("the other {} say ({:.4g})", what, e.value)},
                doubts);
        };
        const auto beside_widths = [&](double floor) {
            const Expected e = from_ratios(own, widths, floor, "");
            doubt_if_far(
                readings, own.row,
                {e.value, e.sigma, fmt::format("the widths and the mesh say ({:.4g})", e.value)},
                doubts);
        };
        const auto beside_all = [&] {
            std::vector<double> others;
            for (const Length& l : lengths) {
                if (&l != &own && !l.shares_row(own)) others.push_back(l.ratio);
            }
            // The volume grows with the cube.
            if (weighed) others.push_back(*weighed / 3);
            if (others.size() <= k_enough) return;
            const Expected e = from_ratios(own, others, rough * k_others, "");
            doubt_if_far(readings, own.row,
                         {e.value, e.sigma,
                          fmt::format("the other lengths and the mesh say ({:.4g})", e.value)},
                         doubts);
        };
        if (widths.size() <= k_enough) {
            // One of two that differ may be either.
            beside_all();
        } else if (own.kind == ReadingKind::width && sisters.size() >= k_enough) {
            among(rough * k_widths, "widths");
        } else if (own.kind == ReadingKind::table_width && sisters.size() >= k_enough) {
            among(rough * k_tables, "table widths");
        } else if (own.kind == ReadingKind::table_width && !widths.empty()) {
            beside_widths(rough * k_table);
        } else if (own.kind == ReadingKind::depth && !widths.empty()) {
            beside_widths(rough * k_depth);
        }
    }
    check_volumes(stone, readings, lengths, rough * k_volume, doubts);
}

}  // namespace culet
