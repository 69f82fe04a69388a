#include "page/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "page/facet_labels.h"
#include "page/html.h"

namespace culet {

namespace {

constexpr double k_size = 1000;  // of a view's longer side, in its own units

struct DrawnView {
    std::string content;
    double left = 0, width = 0, height = 0;  // x starts at -left; width is the total
    double top = 0;                          // y starts at -top; height is the total
};

std::string point_list(const std::vector<glm::dvec2>& corners) {
    std::string points;
    for (const auto& c : corners) points += fmt::format("{:.2f},{:.2f} ", c.x, c.y);
    if (!points.empty()) points.pop_back();
    return points;
}

std::string label_svg(const FacetLabel& label) {
    if (label.has_leader) {
        return fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" "
            "text-anchor=\"{}\">{}</text>",
            label.at.x, label.at.y + 0.35 * label.size, label.size,
            label.at_right ? "start" : "end", escaped(label.text));
    }
    const std::string turn = label.turn_deg == 0
                                 ? ""
                                 : fmt::format(" transform=\"rotate({:.1f} {:.1f} {:.1f})\"",
                                               label.turn_deg, label.at.x, label.at.y);
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" "
        "text-anchor=\"middle\"{}>{}</text>",
        label.at.x, label.at.y + 0.35 * label.size, label.size, turn, escaped(label.text));
}

// A tick for every tooth, outside the drawing; about sixteen have numbers.
void add_wheel(const FacetView& view, ViewSide side, const IndexWheel& wheel, DrawnView& drawn) {
    const int teeth = static_cast<int>(std::lround(std::abs(wheel.gear)));
    if (teeth < 1 || side == ViewSide::girdle) return;
    constexpr int k_numbers = 16;
    constexpr double k_gap = 14, k_tick = 10, k_long = 20, k_room = 70, k_letters = 34;
    int step = 1;
    while (teeth % step != 0 || teeth / step > k_numbers) ++step;
    double radius = 0;
    for (const SeenFacet& seen : view.facets) {
        for (const auto& c : seen.corners)
            radius = std::max(radius, std::hypot(c.x - view.origin.x, c.y - view.origin.y));
    }
    radius += k_gap;
    std::string ticks, numbers;
    for (int tooth = 1; tooth <= teeth; ++tooth) {
        const double turn = 2 * std::numbers::pi * (tooth - wheel.offset) / wheel.gear;
        const double x = (side == ViewSide::pavilion ? -1 : 1) * std::sin(turn),
                     y = -std::cos(turn);
        const auto at = [&](double r) {
            return fmt::format("{:.1f} {:.1f}", view.origin.x + r * x, view.origin.y + r * y);
        };
        const bool numbered = tooth % step == 0;
        ticks += "M" + at(radius) + "L" + at(radius + (numbered ? k_long : k_tick));
        if (!numbered) continue;
        const double r = radius + k_long + 0.75 * k_letters;
        numbers += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", view.origin.x + r * x,
                               view.origin.y + r * y + 0.35 * k_letters, tooth);
    }
    drawn.content += fmt::format(
        "<g class=\"wheel\" aria-hidden=\"true\" font-family=\"{}\" font-size=\"{}\" "
        "text-anchor=\"middle\" fill=\"currentColor\"><path d=\"{}\" fill=\"none\" "
        "stroke=\"currentColor\" stroke-width=\"2\"/>{}</g>\n",
        k_svg_font, k_letters, ticks, numbers);
    const double right = std::max(drawn.width - drawn.left, view.origin.x + radius + k_room);
    drawn.left = std::max(drawn.left, radius + k_room - view.origin.x);
    drawn.width = right + drawn.left;
    drawn.top = std::max(0.0, radius + k_room - view.origin.y);
    drawn.height = std::max(drawn.height, view.origin.y + radius + k_room) + drawn.top;
}

DrawnView drawn_view(const Solid& solid, ViewSide side, const std::vector<FacetPaint>& paint,
                     bool focusable, const IndexWheel& wheel = {}) {
    const FacetView view = view_of(solid, side, k_size);
    if (view.facets.empty()) return {};
    DrawnView result;
    std::string marks;
    for (const SeenFacet& seen : view.facets) {
        const auto f = static_cast<std::size_t>(seen.facet);
        const Facet& facet = solid.facets[f];
        const FacetPaint own = f < paint.size() ? paint[f] : FacetPaint{};
        const std::string about = own.about.empty() ? facet.name : facet.name + ": " + own.about;
        const std::string points = point_list(seen.corners);
        result.content += fmt::format(
            "<g class=\"facet\"{2} role=\"img\" aria-label=\"{0}\"><title>{0}</title>"
            "<polygon points=\"{1}\" fill=\"{3}\" stroke=\"#23303a\" stroke-width=\"2.4\" "
            "stroke-linejoin=\"round\"/></g>\n",
            escaped(about), points, focusable ? " tabindex=\"0\"" : "", escaped(own.colour));
        if (own.marked) {
            marks += fmt::format(
                "<polygon class=\"mark\" points=\"{}\" fill=\"none\" "
                "stroke=\"#10161a\" stroke-width=\"7\" stroke-dasharray=\"16 9\" "
                "stroke-linejoin=\"round\" pointer-events=\"none\"/>\n",
                points);
        }
    }
    const FacetLabels labels = place_labels(solid, view);
    std::string lines, names, led;
    for (const FacetLabel& label : labels.labels) {
        if (label.has_leader) {
            const double end = label.at.x + (label.at_right ? -4 : 4);
            lines += fmt::format(
                "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/><circle cx=\"{:.1f}\" cy=\"{:.1f}\" "
                "r=\"3\"/>",
                label.foot.x, label.foot.y, end, label.at.y, label.foot.x, label.foot.y);
        }
        (label.has_leader ? led : names) += label_svg(label);
    }
    result.content += marks;
    result.content += fmt::format(
        "<g class=\"leaders\" aria-hidden=\"true\" fill=\"#10161a\" stroke=\"#10161a\" "
        "stroke-width=\"1.1\" pointer-events=\"none\">{}</g>\n",
        lines);
    result.content += fmt::format(
        "<g class=\"names\" aria-hidden=\"true\" font-family=\"{0}\" font-weight=\"600\" "
        "fill=\"#10161a\" stroke=\"#ffffff\" stroke-opacity=\"0.75\" stroke-width=\"4\" "
        "paint-order=\"stroke\" pointer-events=\"none\">{1}</g>\n"
        "<g class=\"led\" aria-hidden=\"true\" font-family=\"{0}\" font-weight=\"600\" "
        "fill=\"#10161a\" pointer-events=\"none\">{2}</g>\n",
        k_svg_font, names, led);
    // Keeps the drawing in the middle.
    result.left = std::max(labels.left, labels.right);
    result.width = view.width + 2 * result.left;
    result.height = view.height;
    add_wheel(view, side, wheel, result);
    return result;
}

const char* short_name(ViewSide side) {
    switch (side) {
        case ViewSide::crown:
            return "crown view";
        case ViewSide::pavilion:
            return "pavilion view";
        case ViewSide::girdle:
            return "girdle view";
    }
    return "";
}

// A ramp of many small steps, which every program draws alike.
std::string ramp(const PaintLegend& legend, double x, double y, double width) {
    std::string svg;
    constexpr int k_steps = 40;
    for (int i = 0; i < k_steps; ++i) {
        svg += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"26\" fill=\"{}\"/>",
            x + width * i / k_steps, y, width / k_steps + 0.6,
            css_colour(legend.map, (i + 0.5) / k_steps));
    }
    const auto tick = [&](double at, const char* anchor, const std::string& text) {
        svg += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"24\" "
            "text-anchor=\"{}\">{}</text>",
            at, y + 54, anchor, escaped(text));
    };
    tick(x, "start", legend.from);
    tick(x + 0.5 * width, "middle", legend.middle);
    tick(x + width, "end", legend.to);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"24\">{}</text>\n", x, y + 90,
                       escaped(legend.what));
    if (!legend.mark.empty()) {
        svg += fmt::format(
            "<path d=\"M{0:.1f} {1:.1f}h70\" stroke=\"#10161a\" stroke-width=\"7\" "
            "stroke-dasharray=\"16 9\"/><text x=\"{2:.1f}\" y=\"{3:.1f}\" "
            "font-size=\"24\">{4}</text>\n",
            x, y + 118, x + 84, y + 126, escaped(legend.mark));
    }
    return svg;
}

}  // namespace

const char* caption_of(ViewSide side) {
    switch (side) {
        case ViewSide::crown:
            return "Crown, from above";
        case ViewSide::pavilion:
            return "Pavilion, turned over about the vertical";
        case ViewSide::girdle:
            return "Girdle, from azimuth 270";
    }
    return "";
}

std::string draw_facets_svg(const Solid& solid, ViewSide side, const std::vector<FacetPaint>& paint,
                            const IndexWheel& wheel) {
    const DrawnView view = drawn_view(solid, side, paint, true, wheel);
    if (view.content.empty()) return {};
    return fmt::format(
        "<svg class=\"stone\" viewBox=\"{:.0f} {:.0f} {:.0f} {:.0f}\" role=\"group\" "
        "aria-label=\"{}\">{}</svg>",
        0.0 - view.left, 0.0 - view.top, view.width, view.height, short_name(side), view.content);
}

std::string drawing_svg(const std::string& title, const std::string& subtitle, const Solid& solid,
                        const std::vector<FacetPaint>& paint, const PaintLegend& legend) {
    constexpr double k_between = 70, k_top = 130, k_caption = 56;
    const std::array sides{ViewSide::crown, ViewSide::pavilion, ViewSide::girdle};
    std::array<DrawnView, 3> views;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        views[i] = drawn_view(solid, sides[i], paint, false);
    }
    const double first_row = views[0].width + k_between + views[1].width;
    const double width = std::max({first_row, views[2].width, 1400.0}) + 2 * k_between;
    const double second = k_top + std::max(views[0].height, views[1].height) + 2 * k_caption;
    const double legend_top = second + views[2].height + 2 * k_caption;
    const double height = legend_top + 150;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" font-family=\"{4}\" fill=\"#10161a\">\n"
        "<title>{2}</title>\n<desc>{3}</desc>\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n"
        "<text x=\"{5:.0f}\" y=\"62\" font-size=\"40\" font-weight=\"600\">{2}</text>\n"
        "<text x=\"{5:.0f}\" y=\"102\" font-size=\"26\" fill=\"#4a555c\">{3}</text>\n",
        width, height, escaped(title), escaped(subtitle), k_svg_font, k_between);
    const auto place = [&](std::size_t i, double x, double y) {
        if (views[i].content.empty()) return;
        svg += fmt::format(
            "<g transform=\"translate({:.1f} {:.1f})\">\n{}</g>\n"
            "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"26\" text-anchor=\"middle\" "
            "fill=\"#4a555c\">{}</text>\n",
            x + views[i].left, y, views[i].content, x + 0.5 * views[i].width,
            y + views[i].height + 0.8 * k_caption, caption_of(sides[i]));
    };
    const double x = 0.5 * (width - first_row);
    place(0, x, k_top);
    place(1, x + views[0].width + k_between, k_top);
    place(2, 0.5 * (width - views[2].width), second);
    if (!legend.what.empty()) svg += ramp(legend, k_between, legend_top, 620);
    return svg + "</svg>\n";
}

}  // namespace culet
