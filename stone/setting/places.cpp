#include "stone/setting/places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

const double k_corner_turn = radians(40);
constexpr double k_corner_window = 1.0 / 40;  // of the length of the outline
constexpr double k_cut_corner = 0.12;         // longest side of a cut corner, of the length of the
                                              // outline
constexpr double k_bridge = 1e-3;             // least distance of a bridge from the outline, of its
                                              // length

double wrapped(double way, double length) {
    way = std::fmod(way, length);
    return way < 0 ? way + length : way;
}

// Arc length from `a` to `b`, the shorter way round.
double apart(double a, double b, double length) {
    const double d = wrapped(b - a, length);
    return d > 0.5 * length ? d - length : d;
}

// True for a cushion: fuller than the ellipse with its extents along x and y.
bool is_rounded_rectangle(const PlanOutline& outline) {
    constexpr double k_fuller = 1.03;
    PlanPoint low = outline[0], high = outline[0];
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        low = glm::min(low, outline[i]);
        high = glm::max(high, outline[i]);
        area += 0.5 * cross(outline[i], outline[(i + 1) % outline.size()]);
    }
    const PlanPoint extent = high - low;
    return area > k_fuller * 0.25 * std::numbers::pi * extent.x * extent.y;
}

}  // namespace

GripOutline::GripOutline(const PlanOutline& outline) : hull_(convex_hull(outline)) {
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        arc_lengths_.push_back(length_);
        length_ += glm::length(hull_[(i + 1) % hull_.size()] - hull_[i]);
    }
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        const PlanPoint middle = 0.5 * (hull_[i] + hull_[(i + 1) % hull_.size()]);
        bridges_.push_back(std::abs(distance_outside(outline, middle)) > k_bridge * length_);
    }
    find_corners();
}

void GripOutline::find_corners() {
    const std::size_t count = hull_.size();
    std::vector<double> turns;
    for (std::size_t i = 0; i < count; ++i) {
        const PlanPoint before = hull_[i] - hull_[(i + count - 1) % count],
                        after = hull_[(i + 1) % count] - hull_[i];
        turns.push_back(std::atan2(cross(before, after), glm::dot(before, after)));
    }
    struct Corner {
        double way = 0, turn = 0;
    };
    // Sum the turning near each corner of the hull, then take the sharpest first.
    std::vector<Corner> found;
    const double reach = 0.5 * k_corner_window * length_;
    for (std::size_t i = 0; i < count; ++i) {
        Corner corner;
        double moment = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const double distance = apart(arc_lengths_[i], arc_lengths_[k], length_);
            if (std::abs(distance) > reach) continue;
            corner.turn += turns[k];
            moment += turns[k] * distance;
        }
        if (corner.turn < k_corner_turn) continue;
        corner.way = wrapped(arc_lengths_[i] + moment / corner.turn, length_);
        found.push_back(corner);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Corner& a, const Corner& b) { return a.turn > b.turn + 1e-9; });
    std::vector<Corner> corners;
    for (const Corner& corner : found) {
        if (std::none_of(corners.begin(), corners.end(), [&](const Corner& other) {
                return std::abs(apart(corner.way, other.way, length_)) <= 2 * reach;
            }))
            corners.push_back(corner);
    }
    std::sort(corners.begin(), corners.end(),
              [](const Corner& a, const Corner& b) { return a.way < b.way; });
    std::vector<bool> joined(corners.size(), false);
    for (std::size_t i = 0; corners.size() > 2 && i < corners.size(); ++i) {
        const std::size_t next = (i + 1) % corners.size();
        const double side = wrapped(corners[next].way - corners[i].way, length_);
        if (joined[i] || joined[next] || side > k_cut_corner * length_) continue;
        joined[i] = joined[next] = true;
        corners_.push_back(wrapped(corners[i].way + 0.5 * side, length_));
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!joined[i]) corners_.push_back(corners[i].way);
    std::sort(corners_.begin(), corners_.end());
}

int GripOutline::usual_prongs() const {
    switch (corners()) {
        case 0:
            return is_rounded_rectangle(hull_) ? 4 : 6;
        case 1:
            return 5;
        case 2:
            return 6;
        default:
            return corners();
    }
}

std::vector<GripOutline::Stretch> GripOutline::stretches() const {
    struct End {
        double from = 0, to = 0;
        bool corner = false;
    };
    std::vector<End> ends;
    for (const double corner : corners_) ends.push_back({corner, corner, true});
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        if (bridges_[i])
            ends.push_back({arc_lengths_[i],
                            i + 1 < arc_lengths_.size() ? arc_lengths_[i + 1] : length_, false});
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.from < b.from; });
    std::vector<Stretch> parts;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const End &first = ends[i], &last = ends[(i + 1) % ends.size()];
        double to = last.from;
        while (to <= first.to) to += length_;
        parts.push_back({first.to, to, first.corner, last.corner});
    }
    return parts;
}

std::vector<GirdlePlace> GripOutline::places(int count, double width) const {
    check(count >= 2, "a stone is held by two prongs or more");
    std::vector<double> ways;
    const std::vector<Stretch> parts = stretches();
    if (parts.empty()) {
        // An even count stands on both sides of the x axis, an odd one begins on it.
        const double start = arc_length_to({1, 0}) + (count % 2 == 0 ? 0.5 * length_ / count : 0);
        for (int i = 0; i < count; ++i)
            ways.push_back(wrapped(start + i * length_ / count, length_));
    } else if (count <= corners()) {
        for (int i = 0; i < count; ++i)
            ways.push_back(corners_[static_cast<std::size_t>(i) * corners_.size() /
                                    static_cast<std::size_t>(count)]);
    } else {
        ways = corners_;
        // Add prongs one by one where they would stand furthest apart.
        const auto gap = [&](std::size_t part, int prongs) {
            const Stretch& s = parts[part];
            const double ends = 0.5 * (s.corner_first ? 1 : 0) + 0.5 * (s.corner_last ? 1 : 0);
            return (s.to - s.from) / (prongs + ends);
        };
        std::vector<int> prongs(parts.size(), 0);
        for (int i = corners(); i < count; ++i) {
            std::size_t widest = 0;
            for (std::size_t p = 1; p < parts.size(); ++p) {
                if (gap(p, prongs[p]) > gap(widest, prongs[widest]) * (1 + 1e-9)) widest = p;
            }
            ++prongs[widest];
        }
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const double step = gap(p, prongs[p]);
            const double before = parts[p].corner_first ? step : 0.5 * step;
            for (int i = 0; i < prongs[p]; ++i)
                ways.push_back(wrapped(parts[p].from + before + i * step, length_));
        }
    }
    // From azimuth 0 on; a place that rounding puts just before 0 comes first.
    const double first = arc_length_to({1, 0}) - 1e-9 * length_;
    std::sort(ways.begin(), ways.end(), [&](double a, double b) {
        return wrapped(a - first, length_) < wrapped(b - first, length_);
    });
    std::vector<GirdlePlace> places;
    for (const double way : ways) places.push_back(place_at(way, width));
    return places;
}

PlanPoint GripOutline::point_at(double way) const {
    const auto after = std::upper_bound(arc_lengths_.begin(), arc_lengths_.end(), way);
    const std::size_t i = static_cast<std::size_t>(after - arc_lengths_.begin()) - 1;
    const PlanPoint side = hull_[(i + 1) % hull_.size()] - hull_[i];
    return hull_[i] + side * ((way - arc_lengths_[i]) / glm::length(side));
}

GirdlePlace GripOutline::place_at(double way, double width) const {
    // The mean of the normals is the chord's normal.
    const double half = 0.5 * std::min(width, 0.25 * length_);
    const PlanPoint chord =
        point_at(wrapped(way + half, length_)) - point_at(wrapped(way - half, length_));
    return {point_at(way), glm::normalize(PlanPoint(chord.y, -chord.x))};
}

double GripOutline::arc_length_to(const PlanPoint& direction) const {
    const PlanPoint middle = middle_of(hull_);
    const PlanPoint at =
        middle + std::max(0.0, distance_along(hull_, middle, direction)) * direction;
    double best = 0, nearest = 1e300;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        const PlanPoint side = hull_[(i + 1) % hull_.size()] - hull_[i];
        const double t = std::clamp(glm::dot(at - hull_[i], side) / glm::dot(side, side), 0.0, 1.0);
        const double distance = glm::length(hull_[i] + t * side - at);
        if (distance >= nearest) continue;
        nearest = distance;
        best = arc_lengths_[i] + t * glm::length(side);
    }
    return best;
}

}  // namespace culet
