#pragma once
// Where prongs stand round a girdle.

#include <vector>

#include "stone/solid/plan.h"

namespace culet {

/// A place on the girdle's outline and the unit normal there.
struct GirdlePlace {
    PlanPoint at{0, 0}, outward{1, 0};
};

/// What of an outline may be gripped from outside: its convex hull, without the stretches that
/// bridge a notch, and the corners on it. A corner is where the outline turns by 40 degrees or more
/// within a fortieth of its length; two of them that one short side joins (a cut corner) are one.
class GripOutline {
public:
    explicit GripOutline(const PlanOutline& outline);

    const PlanOutline& hull() const { return hull_; }
    int corners() const { return static_cast<int>(corners_.size()); }

    /// As the trade has it: a prong at every corner, and as many beside as hold the stone. Of
    /// outlines without corners rounded rectangles have 4, others 6.
    int usual_prongs() const;

    /// `count` places, at least 2, counter-clockwise from azimuth 0. First the corners are taken
    /// (spread evenly where there are more of them than prongs), then the rest stands between them
    /// at even distances. Without corners they stand evenly about the x axis. Normals are means
    /// over `width` of outline.
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
    double way_to(const PlanPoint& direction) const;

    PlanOutline hull_;
    std::vector<double> ways_;   // of the hull's corners, round it from the first
    std::vector<bool> bridges_;  // sides of the hull that lie off the outline
    std::vector<double> corners_;
    double length_ = 0;
};

}  // namespace culet
