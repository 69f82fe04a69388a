#include "compare/turntable/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "compare/turntable/tangency.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A sharp picture's blur and noise leave a residual of 0.1 to 0.2 pixels (turntable_test.cpp).
constexpr double k_doubtful_px = 1;
// With a larger uncertainty of the camera's angles, outlines say nothing useful about a facet.
constexpr double k_unknown = radians(1);
// Several starts: a table's flat top makes a kink at elevation 0, where the search would stop.
constexpr std::array<double, 9> k_starts_deg{0, -0.5, 0.5, -1, 1, -2.5, 2.5, -6, 6};

void judge(const std::vector<BackLitOutline>& outlines, double step, Turntable& table) {
    const bool is_known = table.sigma_roll < k_unknown && table.sigma_elevation < k_unknown;
    if (table.residual_px <= k_doubtful_px && is_known) return;
    table.trouble = table.residual_px > k_doubtful_px
                        ? fmt::format(
                              "the outlines contradict each other by {:.1f} pixels, where a "
                              "steady stone in sharp pictures leaves less than {:g}",
                              table.residual_px, k_doubtful_px)
                        : "the outlines do not tell how the camera stood to the axis";
    std::vector<double> contrasts;
    for (const BackLitOutline& outline : outlines) contrasts.push_back(outline.contrast);
    table.remedy = fmt::format(
        "Light the stone from behind, so that it is dark before a bright, even ground (along these "
        "outlines it is {:.0f} % darker; back-lit stones come to 90 %); check that each picture "
        "shows the stone {:g} degrees further, in this order, that the axis is upright or "
        "--turntable says otherwise, and that the camera is far away and about level",
        100 * upper_median(std::move(contrasts)), degrees(step));
}

}  // namespace

std::vector<std::size_t> order_of_numbers(const std::vector<std::string>& names) {
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return ::strverscmp(names[a].c_str(), names[b].c_str()) < 0;
    });
    return order;
}

Turntable turntable_of(const std::vector<BackLitOutline>& outlines, double step) {
    if (outlines.size() < 3) throw InputError("a turntable needs three pictures at least");
    std::vector<OutlineHull> hulls;
    std::vector<double> turns;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (outlines[i].corners.empty())
            throw InputError(fmt::format("picture {}: {}", i + 1, outlines[i].trouble));
        hulls.push_back({outlines[i].corners, outlines[i].at_top, outlines[i].at_bottom});
        turns.push_back(step * static_cast<double>(i));
    }
    TangencyOptions options;
    for (const double deg : k_starts_deg) options.elevations.push_back(radians(deg));
    const Tangency found = tangency_of(hulls, turns, options);
    Turntable table;
    table.axis_px = found.table[0];
    table.roll = found.table[1];
    table.elevation = found.table[2];
    table.residual_px = found.residual_px;
    table.tangents = found.tangents;
    table.sigma_axis_px = found.sigmas[0];
    table.sigma_roll = found.sigmas[1];
    table.sigma_elevation = found.sigmas[2];
    judge(outlines, step, table);
    return table;
}

std::vector<PlacedOutline> placed(const std::vector<BackLitOutline>& outlines, double step,
                                  const Turntable& table, double scale) {
    std::vector<PlacedOutline> result;
    const double c = std::cos(table.roll), s = std::sin(table.roll);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const double turn = -step * static_cast<double>(i), x = std::cos(turn), y = std::sin(turn);
        const double ce = std::cos(table.elevation), se = std::sin(table.elevation);
        const Vec3 right{-y, x, 0}, up{-se * x, -se * y, ce};
        PlacedOutline& one = result.emplace_back();
        one.direction = {ce * x, ce * y, se};
        for (const glm::dvec2& p : outlines[i].points) {
            const double u = p.x - table.axis_px, v = p.y;
            one.points.push_back(scale * ((c * u - s * v) * right + (s * u + c * v) * up));
        }
    }
    return result;
}

OutlineWidths widths_of(const std::vector<BackLitOutline>& outlines, const Turntable& table) {
    OutlineWidths widths{1e300, 0};
    const double c = std::cos(table.roll), s = std::sin(table.roll);
    for (const BackLitOutline& outline : outlines) {
        double low = 1e300, high = -1e300;
        for (const glm::dvec2& p : outline.points) {
            low = std::min(low, c * p.x - s * p.y);
            high = std::max(high, c * p.x - s * p.y);
        }
        widths.least = std::min(widths.least, high - low);
        widths.largest = std::max(widths.largest, high - low);
    }
    return widths;
}

}  // namespace culet
