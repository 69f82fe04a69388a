#pragma once
// A chart of points and lines on logarithmic or plain axes, as SVG.

#include <limits>
#include <string>
#include <vector>

namespace culet {

struct ChartPoint {
    double x = 0, y = 0;
    std::string label;  ///< beside the point if there is room; empty: none
    std::string about;  ///< one line, shown on pointing at it
    /// Ends of an error bar; NaN: none.
    double y_low = std::numeric_limits<double>::quiet_NaN();
    double y_high = std::numeric_limits<double>::quiet_NaN();
    bool hollow = false;
};

struct ChartSeries {
    std::string name;  ///< for the key; empty: same entry and colour as the series before it
    std::vector<ChartPoint> points;
    bool line = true;     ///< join the points in their order
    bool markers = true;  ///< false: draw only the line
    bool dashed = false;
};

struct Chart {
    std::string title, about;  ///< `about` is the text alternative: what the chart shows
    std::string x_label, y_label;
    bool log_x = true, log_y = true;
    std::vector<ChartSeries> series;
};

/// Draws a self-contained picture, 760 x 480, dark on white. Series differ by shape and by colour
/// (Okabe and Ito 2008). Points that are not finite, or not positive on a logarithmic axis, are
/// omitted. Empty when no point remains. Text is escaped.
std::string draw_chart_svg(const Chart& chart);

}  // namespace culet
