#pragma once
// Where prongs stand around a girdle.

#include <vector>

#include "stone/solid/plan.h"

namespace culet {

/// A place on the girdle's outline, with the unit normal there.
struct GirdlePlace {
    PlanPoint at{0, 0}, outward{1, 0};
};

/// What can be gripped of an outline from outside: its convex hull, except for sides that bridge a
/// notch, and the corners on it. At a corner the outline turns by 40 degrees or more within a
/// fortieth of its length; two with one short side between (a cut corner) count as one.
class GripOutline {
public:
    explicit GripOutline(const PlanOutline& outline);

    const PlanOutline& hull() const { return hull_; }
    int corners() const { return static_cast<int>(corners_.size()); }

    /// The trade's number: one per corner, and as many more as hold the stone. Without corners: 4
    /// for rounded rectangles, else 6.
    int usual_prongs() const;

    /// `count` places, at least 2, counter-clockwise from azimuth 0: corners first (evenly chosen
    /// if there are too many), the others evenly between them. Without corners all stand evenly
    /// about the x axis. Normals are means over `width` of outline.
    std::vector<GirdlePlace> places(int count, double width) const;

private:
    struct Stretch {  // between two corners or bridges
        double from = 0, to = 0;
        bool corner_first = false, corner_last = false;
    };
    void find_corners();
    std::vector<Stretch> stretches() const;
    GirdlePlace place_at(double way, double width) const;
    PlanPoint point_at(double way) const;
    double arc_length_to(const PlanPoint& direction) const;

    PlanOutline hull_;
    std::vector<double> arc_lengths_;  // arc lengths to the hull's corners, from the first
    std::vector<bool> bridges_;        // sides of the hull that are not on the outline
    std::vector<double> corners_;
    double length_ = 0;
};

}  // namespace culet
