// What a fit changed, facet by facet.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page/drawing.h"
#include "page/fit_page.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/templates.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

struct Angles {
    double inclination_deg = 0, azimuth_deg = 0;
};

// Inclination from the horizontal, positive for pavilion facets too; azimuth counter-clockwise.
Angles angles_of(const Vec3& normal) {
    const double level = std::hypot(normal.x, normal.y);
    double azimuth = degrees(std::atan2(normal.y, normal.x));
    if (azimuth < 0) azimuth += 360;
    return {degrees(std::atan2(level, std::abs(normal.z))), azimuth};
}

View figures_of(double from, double to, double change, int places) {
    const std::string text = decimals(change, places);
    const bool grows = change > 0 && text.find_first_of("123456789") != std::string::npos;
    return {{"known", true},
            {"before", decimals(from, places)},
            {"after", decimals(to, places)},
            {"change", (grows ? "+" : "") + text}};
}

View change_row(const Solid& before, const Facet& old_facet, const Solid& after,
                const Facet& new_facet) {
    const Angles a = angles_of(old_facet.plane.normal), b = angles_of(new_facet.plane.normal);
    const double old_area = area(before, old_facet), new_area = area(after, new_facet);
    // A level facet has no azimuth. Azimuths differ by the shorter way round.
    const bool level = std::min(a.inclination_deg, b.inclination_deg) < 0.05;
    const double turn = std::remainder(b.azimuth_deg - a.azimuth_deg, 360.0);
    const View none{{"known", false}, {"before", "–"}, {"after", "–"}, {"change", "–"}};
    const std::vector<View> figures{
        figures_of(a.inclination_deg, b.inclination_deg, b.inclination_deg - a.inclination_deg, 2),
        level ? none : figures_of(a.azimuth_deg, b.azimuth_deg, turn, 2),
        figures_of(old_area, new_area, new_area - old_area, 3)};
    return {{"name", new_facet.name}, {"figures", figures}};
}

}  // namespace

std::string changes_table(const Solid& before, const Solid& after, const std::string& length_unit) {
    std::vector<View> rows;
    double squares = 0, worst = 0;
    std::string worst_name;
    for (const Facet& facet : after.facets) {
        const int old_index = find_facet(before, facet.name);
        if (old_index < 0) continue;
        const Facet& old_facet = before.facets[static_cast<std::size_t>(old_index)];
        rows.push_back(change_row(before, old_facet, after, facet));
        const double tilt = std::abs(angles_of(facet.plane.normal).inclination_deg -
                                     angles_of(old_facet.plane.normal).inclination_deg);
        squares += tilt * tilt;
        if (tilt > worst) {
            worst = tilt;
            worst_name = facet.name;
        }
    }
    if (rows.empty()) return {};
    const double mean = std::sqrt(squares / static_cast<double>(rows.size()));
    return filled(templates::fit_changes, {{"mean", decimals(mean, 2)},
                                           {"count", std::to_string(rows.size())},
                                           {"worst", decimals(worst, 2)},
                                           {"worst_name", worst_name},
                                           {"volume_before", significant(volume(before), 5)},
                                           {"volume_after", significant(volume(after), 5)},
                                           {"unit", length_unit},
                                           {"tall", is_tall(rows)},
                                           {"rows", rows}});
}

std::string change_drawings(const Solid& start, const Solid& fitted) {
    std::vector<FacetPaint> paint;
    std::vector<double> steeper;
    double worst = 0;
    for (const Facet& facet : fitted.facets) {
        const int old_index = find_facet(start, facet.name);
        FacetPaint own{"#d9dde0", "not in the starting mesh"};
        steeper.push_back(0);
        if (old_index >= 0) {
            const Facet& before = start.facets[static_cast<std::size_t>(old_index)];
            const double from = angles_of(before.plane.normal).inclination_deg;
            const double to = angles_of(facet.plane.normal).inclination_deg;
            steeper.back() = to - from;
            worst = std::max(worst, std::abs(to - from));
            own = {"",
                   fmt::format("inclination {}° in place of {}°, {}{}°", decimals(to, 2),
                               decimals(from, 2), to > from ? "+" : "", decimals(to - from, 2))};
        }
        paint.push_back(own);
    }
    // At least a tenth of a degree, so that equal stones look equal.
    const double range = std::max(0.1, std::ceil(10 * worst) / 10);
    for (std::size_t f = 0; f < paint.size(); ++f) {
        if (!paint[f].colour.empty()) continue;
        paint[f].colour = css_colour(ColourMap::difference, 0.5 + 0.5 * steeper[f] / range);
    }
    const std::string both = stone_views(fitted, paint);
    if (both.empty()) return {};
    return both + colour_bar(ColourMap::difference, "blue: flatter than designed, red: steeper",
                             decimals(-range, 1) + "°", "0", "+" + decimals(range, 1) + "°");
}

}  // namespace culet
