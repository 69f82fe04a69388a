#pragma once
// Finds room for names beside the points of a chart.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace culet {

struct LabelBox {
    double x0, y0, x1, y1;
    bool meets(const LabelBox& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

class LabelRoom {
public:
    explicit LabelRoom(const LabelBox& frame) : frame_(frame) {}
    void take(const LabelBox& box) { taken_.push_back(box); }
    /// Keeps names off a line.
    void take_line(double x0, double y0, double x1, double y1) {
        const int pieces = 1 + static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 6);
        for (int i = 0; i <= pieces; ++i) {
            const double t = static_cast<double>(i) / pieces, x = x0 + t * (x1 - x0),
                         y = y0 + t * (y1 - y0);
            take({x - 2, y - 2, x + 2, y + 2});
        }
    }
    /// Returns nothing when every place is taken.
    std::optional<LabelBox> find(double x, double y, double width, double height) {
        for (const double away : {9.0, 20.0, 34.0}) {
            const double w = 0.5 * width, h = 0.5 * height;
            const std::array<std::pair<double, double>, 8> places{{{away + w, 0},
                                                                   {-away - w, 0},
                                                                   {0, -away - h},
                                                                   {0, away + h},
                                                                   {away + w, -away},
                                                                   {-away - w, -away},
                                                                   {away + w, away},
                                                                   {-away - w, away}}};
            for (const auto& [dx, dy] : places) {
                const LabelBox box{x + dx - w, y + dy - h, x + dx + w, y + dy + h};
                if (box.x0 < frame_.x0 || box.x1 > frame_.x1 || box.y0 < frame_.y0 ||
                    box.y1 > frame_.y1) {
                    continue;
                }
                if (std::none_of(taken_.begin(), taken_.end(),
                                 [&](const LabelBox& t) { return t.meets(box); })) {
                    taken_.push_back(box);
                    return box;
                }
            }
        }
        return std::nullopt;
    }

private:
    LabelBox frame_;
    std::vector<LabelBox> taken_;
};

}  // namespace culet
