#include "fit/known_ends.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace culet {

namespace {

constexpr double k_apart = 1e-5;

}  // namespace

bool is_same_place(const Shape& one, const Shape& other) {
    for (std::size_t p = 0; p < one.points.size(); ++p) {
        if (glm::distance(one.points[p], other.points[p]) > k_apart) return false;
    }
    return true;
}

void KnownEnds::add(const std::vector<Shape>& ways, const Settled& end) {
    known_.push_back({ways, end});
}

const Settled* KnownEnds::end_from(const Shape& shape) const {
    for (const Known& known : known_) {
        if (std::any_of(known.ways.begin(), known.ways.end(),
                        [&](const Shape& way) { return is_same_place(way, shape); })) {
            return &known.end;
        }
    }
    return nullptr;
}

}  // namespace culet
