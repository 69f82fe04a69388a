#include "fit/findings/plan_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace culet {

namespace {

Quantity length_of(const Quantity& x, const Quantity& y) {
    Quantity q{std::hypot(x.value, y.value), {}};
    if (!(q.value > 0)) return q;
    const double length = q.value;
    q.add(x, x.value / length);
    q.add(y, y.value / length);
    q.value = length;
    return q;
}

double flat_distance(const Vec3& a, const Vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

Quantity operator+(Quantity a, const Quantity& b) {
    a.add(b, 1);
    return a;
}

Quantity operator-(Quantity a, const Quantity& b) {
    a.add(b, -1);
    return a;
}

Quantity operator*(double factor, const Quantity& a) {
    Quantity q;
    q.add(a, factor);
    return q;
}

Quantity operator*(const Quantity& a, const Quantity& b) {
    Quantity q = b.value * a;
    q.add(b, a.value);
    q.value = a.value * b.value;
    return q;
}

Quantity operator/(const Quantity& a, const Quantity& b) {
    Quantity q = 1 / b.value * a;
    q.add(b, -a.value / (b.value * b.value));
    q.value = a.value / b.value;
    return q;
}

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

Quantity PlanView::along(int corner, const Vec3& direction) const {
    Quantity q{glm::dot(direction, place(corner)), {}};
    add_corner(q, shape_, outline_.corners[std::size_t(corner)], direction);
    return q;
}

PlanView::Flat PlanView::between(int from, int to) const {
    const Vec3 x{1, 0, 0}, y{0, 1, 0};
    return {along(to, x) - along(from, x), along(to, y) - along(from, y)};
}

Quantity PlanView::distance(int a, int b) const {
    const Flat d = between(a, b);
    return length_of(d.x, d.y);
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
            const double apart = flat_distance(place(hull_[i]), place(hull_[j]));
            // Of equal ones, to rounding, the first.
            if (apart <= most * (1 + 1e-12)) continue;
            most = apart;
            from = hull_[i];
            to = hull_[j];
        }
    }
    return distance(from, to);
}

Quantity PlanView::mean_across(const std::vector<int>& loop) const {
    const double count = double(loop.size());
    Quantity q;
    if (loop.size() % 2 == 0) {
        const std::size_t half = loop.size() / 2;
        for (std::size_t i = 0; i < half; ++i) q.add(distance(loop[i], loop[i + half]), 2 / count);
        return q;
    }
    // An odd loop's corners face the middle of edges: twice the mean distance from the middle.
    Flat middle;
    for (const int c : loop) {
        middle.x.add(along(c, {1, 0, 0}), 1 / count);
        middle.y.add(along(c, {0, 1, 0}), 1 / count);
    }
    for (const int c : loop) {
        q.add(length_of(along(c, {1, 0, 0}) - middle.x, along(c, {0, 1, 0}) - middle.y), 2 / count);
    }
    return q;
}

PlanView::Jaws PlanView::narrowest() const {
    Jaws best;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        Jaws jaws{hull_[i], hull_[(i + 1) % hull_.size()], 0};
        const Vec3 edge = place(jaws.to) - place(jaws.from);
        const Vec3 inward = Vec3{-edge.y, edge.x, 0} / std::hypot(edge.x, edge.y);
        for (const int c : hull_) {
            jaws.width = std::max(jaws.width, glm::dot(inward, place(c) - place(jaws.from)));
        }
        if (jaws.width < best.width) best = jaws;
    }
    return best;
}

Quantity PlanView::extent(const Jaws& jaws, const std::vector<int>& corners, bool across) const {
    const Flat edge = between(jaws.from, jaws.to);
    Flat direction = across ? Flat{-1 * edge.y, edge.x} : edge;
    const auto order = [&](int a, int b) {
        const Vec3 d{direction.x.value, direction.y.value, 0};
        return glm::dot(d, place(a)) < glm::dot(d, place(b));
    };
    // The jaw lies on both of the edge's corners: either says the same.
    const bool on_edge =
        across && std::find(corners.begin(), corners.end(), jaws.from) != corners.end();
    const int high = *std::max_element(corners.begin(), corners.end(), order),
              low = on_edge ? jaws.from : *std::min_element(corners.begin(), corners.end(), order);
    const Flat d = between(low, high);
    return (direction.x * d.x + direction.y * d.y) / length_of(edge.x, edge.y);
}

}  // namespace culet
