#include "page/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "page/html.h"
#include "page/label_room.h"

namespace culet {

namespace {

constexpr double k_width = 760, k_height = 480;
constexpr double k_left = 84, k_right = 24, k_top = 56, k_bottom = 66;
constexpr double k_text = 15;
constexpr std::array k_colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};

/// One axis: maps values to the page.
class Axis {
public:
    /// `least_share`: least length of a plain axis / its largest value.
    Axis(std::vector<double> values, bool logarithmic, double from, double to, double least_share)
        : logarithmic_(logarithmic), from_(from), to_(to) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        low_ = shown(*low);
        high_ = shown(*high);
        // At least a factor of two, or a plain axis of some length, and margins at both ends.
        const double least =
            logarithmic_ ? std::log10(2.0) : std::max(1e-12, least_share * std::abs(high_));
        const double wanted = std::max(least, high_ - low_);
        const double middle = 0.5 * (low_ + high_);
        low_ = middle - 0.56 * wanted;
        high_ = middle + 0.56 * wanted;
    }
    double at(double value) const {
        return from_ + (shown(value) - low_) / (high_ - low_) * (to_ - from_);
    }
    struct Tick {
        double value;
        bool labelled;
    };
    std::vector<Tick> ticks() const {
        if (!logarithmic_) return steps(low_, high_);
        // Less than half a decade has too few round powers.
        return high_ - low_ < 0.6 ? steps(std::pow(10, low_), std::pow(10, high_)) : decades();
    }

private:
    double shown(double value) const { return logarithmic_ ? std::log10(value) : value; }
    std::vector<Tick> decades() const {
        std::vector<Tick> ticks;
        const double span = high_ - low_;
        if (span > 6) {
            // Only as many powers of ten are labelled as fit.
            const double every = std::ceil(span / 9);
            for (double decade = std::ceil(low_); decade <= high_; ++decade) {
                ticks.push_back({std::pow(10, decade), std::fmod(decade, every) == 0});
            }
            return ticks;
        }
        for (double decade = std::floor(low_); decade <= high_; ++decade) {
            for (int digit = 1; digit <= 9; ++digit) {
                const double at = decade + std::log10(digit);
                if (at < low_ || at > high_) continue;
                const bool labelled = digit == 1 || (span < 2.5 && (digit == 2 || digit == 5)) ||
                                      (span < 1.2 && digit == 3);
                ticks.push_back({digit * std::pow(10, decade), labelled});
            }
        }
        return ticks;
    }
    static std::vector<Tick> steps(double low, double high) {
        const double rough = (high - low) / 6;
        const double decade = std::pow(10, std::floor(std::log10(rough)));
        double step = 10 * decade;
        for (const double s : {5.0, 2.0, 1.0}) {
            if (s * decade >= rough) step = s * decade;
        }
        std::vector<Tick> ticks;
        for (double k = std::ceil(low / step); k * step <= high; ++k) {
            ticks.push_back({k * step, true});
        }
        return ticks;
    }

    bool logarithmic_;
    double from_, to_, low_ = 0, high_ = 1;
};

std::string tick_text(double value) {
    const double size = std::abs(value);
    if (size != 0 && (size < 1e-4 || size >= 1e6)) return fmt::format("{:.0e}", value);
    return fmt::format("{:g}", std::round(value * 1e9) / 1e9 + 0.0);  // no -0
}

std::string marker(std::size_t series, double x, double y, const char* colour, bool hollow) {
    const std::string style = fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"2\"",
                                          hollow ? "#ffffff" : colour, colour);
    switch (series % 4) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" {}/>", x, y, style);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\" {}/>",
                               x - 4.5, y - 4.5, style);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l5.5 10h-11z\" {}/>", x, y - 6.3, style);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l6 6l-6 6l-6 -6z\" {}/>", x, y - 6, style);
    }
}

bool shows(const Chart& chart, const ChartPoint& point) {
    const auto fits = [](double value, bool logarithmic) {
        return std::isfinite(value) && (!logarithmic || value > 0);
    };
    return fits(point.x, chart.log_x) && fits(point.y, chart.log_y);
}

std::string frame(const Chart& chart, const Axis& x, const Axis& y) {
    std::string svg;
    const double bottom = k_height - k_bottom, right = k_width - k_right;
    for (const auto& tick : x.ticks()) {
        svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"{3}\"/>", x.at(tick.value), k_top,
                           bottom, tick.labelled ? "#d5d8da" : "#eef0f1");
        if (!tick.labelled) continue;
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                           x.at(tick.value), bottom + 20, tick_text(tick.value));
    }
    for (const auto& tick : y.ticks()) {
        svg += fmt::format("<path d=\"M{0} {1:.1f}H{2}\" stroke=\"{3}\"/>", k_left,
                           y.at(tick.value), right, tick.labelled ? "#d5d8da" : "#eef0f1");
        if (!tick.labelled) continue;
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
                           k_left - 8, y.at(tick.value) + 5, tick_text(tick.value));
    }
    svg += fmt::format(
        "<path d=\"M{0} {1}V{2}H{3}\" stroke=\"#1d2327\" fill=\"none\" stroke-width=\"1.4\"/>\n"
        "<text x=\"{4:.1f}\" y=\"{5:.1f}\" text-anchor=\"middle\">{6}</text>\n"
        "<text transform=\"translate(20 {7:.1f}) rotate(-90)\" text-anchor=\"middle\">{8}</text>\n",
        k_left, k_top, bottom, right, 0.5 * (k_left + right), k_height - 16.0,
        escaped(chart.x_label), 0.5 * (k_top + bottom), escaped(chart.y_label));
    return svg;
}

// A series without a name has the colour of the one before it.
const char* colour_of(const Chart& chart, std::size_t series) {
    std::size_t named = 0;
    for (std::size_t s = 1; s <= series; ++s) named += !chart.series[s].name.empty();
    return k_colours[named % k_colours.size()];
}

const char* dash_of(const ChartSeries& series) {
    return series.dashed ? " stroke-dasharray=\"7 5\"" : "";
}

// Above the chart, in two lines if one is too short.
std::string key_of(const Chart& chart) {
    const auto width_of = [](const ChartSeries& series) {
        return 33 + 0.55 * k_text * static_cast<double>(series.name.size()) + 26;
    };
    double whole = 0;
    for (const ChartSeries& series : chart.series)
        if (!series.name.empty()) whole += width_of(series);
    const double room = k_width - k_left;
    const bool two = whole > room + 26;
    std::string key;
    double x = k_left, y = two ? 16 : 28;
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
        const ChartSeries& series = chart.series[s];
        if (series.name.empty()) continue;
        if (two && y < 28 && x + width_of(series) - 26 > k_width) {
            x = k_left;
            y = 38;
        }
        const char* colour = colour_of(chart, s);
        if (series.line)
            key += fmt::format("<path d=\"M{:.1f} {:.0f}h26\" stroke=\"{}\" stroke-width=\"2\"{}/>",
                               x, y, colour, dash_of(series));
        if (series.markers) key += marker(s, x + 13, y, colour, false);
        key += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\">{}</text>\n", x + 33, y + 5,
                           escaped(series.name));
        x += width_of(series);
    }
    return key;
}

// Points and lines that names keep off.
LabelRoom room_beside(const Chart& chart, const Axis& x, const Axis& y) {
    LabelRoom room({k_left, k_top - 16, k_width - 4, k_height - k_bottom});
    for (const ChartSeries& series : chart.series) {
        const ChartPoint* before = nullptr;
        for (const ChartPoint& p : series.points) {
            if (!shows(chart, p)) continue;
            const double px = x.at(p.x), py = y.at(p.y);
            if (series.markers) room.take({px - 7, py - 7, px + 7, py + 7});
            if (series.line && before != nullptr)
                room.take_line(x.at(before->x), y.at(before->y), px, py);
            before = &p;
        }
    }
    return room;
}

struct Marks {
    std::string lines, points, names;
};

void draw_series(const Chart& chart, std::size_t s, const Axis& x, const Axis& y, LabelRoom& room,
                 Marks& marks) {
    const ChartSeries& series = chart.series[s];
    const char* colour = colour_of(chart, s);
    std::string path;
    for (const ChartPoint& p : series.points) {
        if (!shows(chart, p)) continue;
        const double px = x.at(p.x), py = y.at(p.y);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
        if (shows(chart, {p.x, p.y_low, {}, {}}) && shows(chart, {p.x, p.y_high, {}, {}})) {
            marks.lines += fmt::format(
                "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"{3}\" "
                "stroke-width=\"2\"/>",
                px, y.at(p.y_low), y.at(p.y_high), colour);
        }
        if (!series.markers) continue;
        marks.points +=
            fmt::format("<g role=\"img\" aria-label=\"{0}\"><title>{0}</title>{1}</g>\n",
                        escaped(p.about.empty() ? series.name + " " + p.label : p.about),
                        marker(s, px, py, colour, p.hollow));
        if (p.label.empty()) continue;
        const double width = 0.56 * (k_text - 1) * static_cast<double>(p.label.size()) + 2;
        if (const auto box = room.find(px, py, width, k_text)) {
            marks.names += fmt::format(
                "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" "
                "font-size=\"{:.0f}\" fill=\"{}\">{}</text>\n",
                0.5 * (box->x0 + box->x1), box->y1 - 4, k_text - 1, colour, escaped(p.label));
        }
    }
    if (series.line && !path.empty()) {
        marks.lines +=
            fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", path,
                        colour, dash_of(series));
    }
}

}  // namespace

std::string draw_chart_svg(const Chart& chart) {
    std::vector<double> xs, ys;
    for (const ChartSeries& series : chart.series) {
        for (const ChartPoint& p : series.points) {
            if (!shows(chart, p)) continue;
            xs.push_back(p.x);
            ys.push_back(p.y);
            for (const double end : {p.y_low, p.y_high}) {
                if (shows(chart, {p.x, end, {}, {}})) ys.push_back(end);
            }
        }
    }
    if (xs.empty()) return {};
    // Small differences in height must not look large.
    const Axis x(std::move(xs), chart.log_x, k_left, k_width - k_right, 0.01);
    const Axis y(std::move(ys), chart.log_y, k_height - k_bottom, k_top, 1);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "role=\"img\" font-family=\"{2}\" font-size=\"{3:.0f}\" fill=\"#1d2327\">\n"
        "<title>{4}</title>\n<desc>{5}</desc>\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
        k_width, k_height, k_svg_font, k_text, escaped(chart.title), escaped(chart.about));
    svg += frame(chart, x, y);
    LabelRoom room = room_beside(chart, x, y);
    Marks marks;
    for (std::size_t s = 0; s < chart.series.size(); ++s) draw_series(chart, s, x, y, room, marks);
    return svg + marks.lines + marks.points + marks.names + key_of(chart) + "</svg>\n";
}

}  // namespace culet
