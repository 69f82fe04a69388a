#include "fit/findings/plan_view.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace culet {

namespace {

Vec3 flat(const Vec3& v) {
    return {v.x, v.y, 0};
}

}  // namespace

PlanView::PlanView(const Shape& shape, const Outline& outline) : shape_(shape), outline_(outline) {
    for (const Corner& c : outline.corners) places_.push_back(place_of(shape, c));
    std::set<int> used;
    for (const std::vector<int>& loop : outline.loops) used.insert(loop.begin(), loop.end());
    corners_.assign(used.begin(), used.end());
    find_hull();
}

// Andrew's monotone chain.
void PlanView::find_hull() {
    std::vector<int> order = corners_;
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        return std::make_pair(place(a).x, place(a).y) < std::make_pair(place(b).x, place(b).y);
    });
    const auto left = [&](int a, int b, int c) {
        const Vec3 u = place(b) - place(a), v = place(c) - place(a);
        return u.x * v.y - u.y * v.x > 1e-12;
    };
    std::vector<int> chain;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t begin = chain.size();
        for (const int c : order) {
            while (chain.size() >= begin + 2 && !left(chain[chain.size() - 2], chain.back(), c)) {
                chain.pop_back();
            }
            chain.push_back(c);
        }
        chain.pop_back();
        std::reverse(order.begin(), order.end());
    }
    hull_ = std::move(chain);
}

void PlanView::put(Quantity& q, int corner, const Vec3& slope) const {
    add_corner(q, shape_, outline_.corners[std::size_t(corner)], slope);
}

Vec3 PlanView::flat_between(int from, int to) const {
    return flat(place(to) - place(from));
}

double PlanView::edge_length(const Jaws& jaws) const {
    return glm::length(flat_between(jaws.from, jaws.to));
}

Vec3 PlanView::along(const Jaws& jaws) const {
    return flat_between(jaws.from, jaws.to) / edge_length(jaws);
}

Quantity PlanView::distance(int a, int b) const {
    const Vec3 d = flat_between(a, b);
    const double length = glm::length(d);
    Quantity q{length, {}};
    if (!(length > 0)) return q;
    put(q, b, d / length);
    put(q, a, -d / length);
    return q;
}

Quantity PlanView::perimeter() const {
    Quantity q;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        q.add(distance(hull_[i], hull_[(i + 1) % hull_.size()]), 1);
    }
    return q;
}

Quantity PlanView::widest() const {
    int from = hull_[0], to = hull_[1];
    double most = 0;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        for (std::size_t j = i + 1; j < hull_.size(); ++j) {
            const double apart = glm::length(flat_between(hull_[i], hull_[j]));
            // Of equal ones, to rounding, the first.
            if (apart <= most * (1 + 1e-12)) continue;
            most = apart;
            from = hull_[i];
            to = hull_[j];
        }
    }
    return distance(from, to);
}

PlanView::Jaws PlanView::narrowest() const {
    Jaws best;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        Jaws jaws{hull_[i], hull_[(i + 1) % hull_.size()], -1, 0};
        const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
        for (const int c : hull_) {
            const double away = glm::dot(inward, place(c) - place(jaws.from));
            if (away > jaws.width || jaws.opposite < 0) {
                jaws.width = away;
                jaws.opposite = c;
            }
        }
        if (jaws.width < best.width) best = jaws;
    }
    return best;
}

Quantity PlanView::width(const Jaws& jaws) const {
    const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
    const Vec3 off = flat_between(jaws.from, jaws.opposite);
    const double t = glm::dot(off, e) / edge_length(jaws);
    Quantity q{glm::dot(inward, off), {}};
    put(q, jaws.opposite, inward);
    put(q, jaws.from, -(1 - t) * inward);
    put(q, jaws.to, -t * inward);
    return q;
}

Quantity PlanView::extent(const Jaws& jaws, const std::vector<int>& corners, bool across) const {
    const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
    const Vec3 direction = across ? inward : e;
    const auto order = [&](int a, int b) {
        return glm::dot(direction, place(a)) < glm::dot(direction, place(b));
    };
    const int high = *std::max_element(corners.begin(), corners.end(), order),
              low = *std::min_element(corners.begin(), corners.end(), order);
    const Vec3 between = flat_between(low, high);
    Quantity q{glm::dot(direction, between), {}};
    put(q, high, direction);
    put(q, low, -direction);
    // d(e) = inward (inward . d(to - from)) / length; d(inward) = -e times the same.
    const double turn = across ? -glm::dot(e, between) : glm::dot(inward, between);
    const Vec3 slope = inward * (turn / edge_length(jaws));
    put(q, jaws.to, slope);
    put(q, jaws.from, -slope);
    return q;
}

Quantity PlanView::mean_across(const std::vector<int>& loop) const {
    const std::size_t count = loop.size();
    Quantity q;
    if (count % 2 == 0) {
        for (std::size_t i = 0; i < count / 2; ++i) {
            q.add(distance(loop[i], loop[i + count / 2]), 2 / double(count));
        }
        return q;
    }
    // An odd loop's corners face the middle of edges: twice the mean distance from the middle.
    Vec3 middle(0);
    for (const int c : loop) middle += place(c) / double(count);
    Vec3 mean_slope(0);
    for (const int c : loop) {
        const Vec3 d = flat(place(c) - middle);
        const double length = glm::length(d);
        q.value += 2 * length / double(count);
        if (!(length > 0)) continue;
        put(q, c, 2.0 / double(count) * d / length);
        mean_slope += 2.0 / double(count) * d / length;
    }
    for (const int c : loop) put(q, c, -mean_slope / double(count));
    return q;
}

}  // namespace culet
