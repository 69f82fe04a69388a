#include "stone/solid/automorphisms.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// One side of an edge: runs from one corner to the next along its facet, counter-clockwise.
struct Dart {
    int from = -1, facet = -1;
    int next = -1, before = -1, twin = -1;
};

std::vector<Dart> darts_of(const Solid& solid) {
    std::vector<Dart> darts;
    std::map<std::pair<int, int>, int> at;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& loop = solid.facets[f].corners;
        const int first = static_cast<int>(darts.size()), count = static_cast<int>(loop.size());
        for (int i = 0; i < count; ++i) {
            const int from = loop[i], to = loop[(i + 1) % count];
            check(at.emplace(std::pair(from, to), first + i).second,
                  "automorphisms of facets that do not form one closed surface");
            darts.push_back({from, static_cast<int>(f), first + (i + 1) % count,
                             first + (i + count - 1) % count, -1});
        }
    }
    for (const auto& [ends, dart] : at) {
        const auto back = at.find({ends.second, ends.first});
        check(back != at.end(), "automorphisms of a surface that is not closed");
        darts[dart].twin = back->second;
    }
    return darts;
}

// Invariants of a dart: the number of corners of its facet and of the neighbour, and of facets at
// either end, which a mirroring swaps.
using Shape = std::array<int, 4>;

std::vector<Shape> shapes_of(const Solid& solid, const std::vector<Dart>& darts) {
    std::vector<int> valence(solid.vertices.size(), 0);
    for (const Dart& d : darts) ++valence[d.from];
    const auto corners = [&](int facet) {
        return static_cast<int>(solid.facets[facet].corners.size());
    };
    std::vector<Shape> shapes;
    for (const Dart& d : darts) {
        shapes.push_back({corners(d.facet), corners(darts[d.twin].facet), valence[d.from],
                          valence[darts[d.twin].from]});
    }
    return shapes;
}

Shape mirrored(const Shape& s) {
    return {s[0], s[1], s[3], s[2]};
}

// A mirroring maps a dart to one of the same facet that runs the other way, so next becomes
// previous.
class Propagation {
public:
    Propagation(const Solid& solid, const std::vector<Dart>& darts)
        : solid_(solid), darts_(darts), shapes_(shapes_of(solid, darts)) {}

    int rarest_dart() const {
        std::map<Shape, int> count;
        for (const Shape& s : shapes_) ++count[std::min(s, mirrored(s))];
        int best = 0;
        const auto times = [&](int d) { return count[std::min(shapes_[d], mirrored(shapes_[d]))]; };
        for (std::size_t d = 1; d < darts_.size(); ++d) {
            if (times(static_cast<int>(d)) < times(best)) best = static_cast<int>(d);
        }
        return best;
    }

    // True if `from` may go to `to` with all that follows; then `result` holds the map.
    bool follow(int from, int to, bool turns_over, Automorphism& result) {
        image_.assign(darts_.size(), -1);
        source_.assign(darts_.size(), -1);
        waiting_.clear();
        if (!put(from, to, turns_over)) return false;
        while (!waiting_.empty()) {
            const int d = waiting_.back();
            waiting_.pop_back();
            const Dart &here = darts_[d], &there = darts_[image_[d]];
            if (!put(here.next, turns_over ? there.before : there.next, turns_over) ||
                !put(here.twin, there.twin, turns_over)) {
                return false;
            }
        }
        result.turns_over = turns_over;
        result.facets.assign(solid_.facets.size(), -1);
        result.vertices.assign(solid_.vertices.size(), -1);
        for (std::size_t d = 0; d < darts_.size(); ++d) {
            if (image_[d] < 0) return false;  // a separate piece
            const Dart& there = darts_[image_[d]];
            result.facets[darts_[d].facet] = there.facet;
            result.vertices[darts_[d].from] = turns_over ? darts_[there.twin].from : there.from;
        }
        // Vertices without facets stay.
        for (std::size_t v = 0; v < result.vertices.size(); ++v) {
            if (result.vertices[v] < 0) result.vertices[v] = static_cast<int>(v);
        }
        return true;
    }

private:
    bool put(int dart, int image, bool turns_over) {
        if (image_[dart] >= 0) return image_[dart] == image;
        if (source_[image] >= 0) return false;
        if (shapes_[dart] != (turns_over ? mirrored(shapes_[image]) : shapes_[image])) return false;
        image_[dart] = image;
        source_[image] = dart;
        waiting_.push_back(dart);
        return true;
    }

    const Solid& solid_;
    const std::vector<Dart>& darts_;
    std::vector<Shape> shapes_;
    std::vector<int> image_, source_, waiting_;
};

}  // namespace

std::vector<Automorphism> automorphisms(const Solid& solid) {
    const std::vector<Dart> darts = darts_of(solid);
    check(!darts.empty(), "automorphisms of a solid without facets");
    Propagation propagation(solid, darts);
    const int first = propagation.rarest_dart();
    std::vector<Automorphism> all;
    Automorphism found;
    if (!propagation.follow(first, first, false, found)) {
        found.facets.resize(solid.facets.size());
        found.vertices.resize(solid.vertices.size());
        std::iota(found.facets.begin(), found.facets.end(), 0);
        std::iota(found.vertices.begin(), found.vertices.end(), 0);
        return {found};
    }
    all.push_back(found);
    for (const bool turns_over : {false, true}) {
        for (std::size_t d = 0; d < darts.size(); ++d) {
            check_stop();
            const int to = static_cast<int>(d);
            if (!turns_over && to == first) continue;
            if (propagation.follow(first, to, turns_over, found)) all.push_back(found);
        }
    }
    return all;
}

std::vector<Automorphism> that_keep(const std::vector<Automorphism>& all, int pole) {
    std::vector<Automorphism> kept;
    for (const Automorphism& a : all) {
        if (a.facets.at(pole) == pole) kept.push_back(a);
    }
    return kept;
}

Automorphism followed_by(const Automorphism& first, const Automorphism& second) {
    Automorphism both = first;
    for (int& f : both.facets) f = second.facets.at(f);
    for (int& v : both.vertices) v = second.vertices.at(v);
    both.turns_over = first.turns_over != second.turns_over;
    return both;
}

int order_of(const Automorphism& automorphism) {
    long order = 1;
    for (const std::vector<int>* map : {&automorphism.facets, &automorphism.vertices}) {
        std::vector<bool> seen(map->size(), false);
        for (std::size_t i = 0; i < map->size(); ++i) {
            long length = 0;
            for (int at = static_cast<int>(i); !seen[at]; at = (*map)[at]) {
                seen[at] = true;
                ++length;
            }
            if (length > 0) order = std::lcm(order, length);
        }
    }
    return static_cast<int>(order);
}

int steps_of_turn(const Solid& solid, int pole, const Automorphism& automorphism) {
    const std::vector<int>& loop = solid.facets.at(pole).corners;
    const auto found = std::find(loop.begin(), loop.end(), automorphism.vertices.at(loop.front()));
    check(automorphism.facets.at(pole) == pole && found != loop.end(),
          "the turn of a facet that does not stay in its place");
    return static_cast<int>(found - loop.begin());
}

std::vector<std::vector<int>> facet_orbits(const std::vector<Automorphism>& group,
                                           std::size_t facets) {
    std::vector<std::vector<int>> orbits;
    std::vector<bool> seen(facets, false);
    for (std::size_t f = 0; f < facets; ++f) {
        if (seen[f]) continue;
        std::vector<int> orbit{static_cast<int>(f)};
        seen[f] = true;
        for (std::size_t i = 0; i < orbit.size(); ++i) {
            for (const Automorphism& a : group) {
                const int image = a.facets.at(orbit[i]);
                if (seen[image]) continue;
                seen[image] = true;
                orbit.push_back(image);
            }
        }
        orbits.push_back(std::move(orbit));
    }
    return orbits;
}

}  // namespace culet
