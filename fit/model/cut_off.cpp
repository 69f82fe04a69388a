#include "fit/model/cut_off.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/solid.h"

namespace culet {

bool CutOff::takes(int corner) const {
    return std::find(gone.begin(), gone.end(), corner) != gone.end();
}

CornerNet::CornerNet(const Shape& shape, const Outline& outline) : loops_(outline.loops) {
    for (const Corner& c : outline.corners) places_.push_back(place_of(shape, c));
    neighbours_.resize(places_.size());
    facets_of_.resize(places_.size());
    std::map<std::pair<int, int>, int> left_of;
    for (std::size_t f = 0; f < loops_.size(); ++f) {
        const std::vector<int>& loop = loops_[f];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            facets_of_[std::size_t(loop[i])].push_back(int(f));
            left_of[{loop[i], loop[(i + 1) % loop.size()]}] = int(f);
        }
    }
    for (const auto& [ends, facet] : left_of) {
        const auto mate = left_of.find({ends.second, ends.first});
        if (mate == left_of.end()) continue;
        const std::pair<int, int> facets = std::minmax(facet, mate->second);
        neighbours_[std::size_t(ends.first)].push_back({ends.second, facets});
        edges_.emplace(facets, ends);
    }
}

std::optional<std::pair<int, int>> CornerNet::edge(int facet, int other) const {
    const auto found = edges_.find(std::minmax(facet, other));
    if (found == edges_.end()) return std::nullopt;
    return found->second;
}

int CornerNet::highest(const std::vector<int>& facets, const Vec3& direction) const {
    int best = -1;
    double most = 0;
    for (const int f : facets) {
        for (const int c : loop(f)) {
            const double along = glm::dot(direction, places_[std::size_t(c)]);
            if (best >= 0 && !(along > most)) continue;
            best = c;
            most = along;
        }
    }
    return best;
}

std::optional<CutOff> CornerNet::above(const Plane& plane, int from, std::size_t most) const {
    const auto height = [&](int c) { return height_above(plane, places_[std::size_t(c)]); };
    CutOff off;
    if (from < 0 || !(height(from) > 0)) return std::nullopt;
    off.gone.push_back(from);
    std::vector<std::pair<int, std::size_t>> taken;  // facets, and how many of their corners
    const auto takes_whole = [&](int facet) {
        for (auto& [known, corners] : taken) {
            if (known == facet) return ++corners == loop(facet).size();
        }
        taken.emplace_back(facet, 1);
        return loop(facet).size() == 1;
    };
    for (std::size_t i = 0; i < off.gone.size(); ++i) {
        const int corner = off.gone[i];
        const double above = height(corner);
        for (const int f : facets_of_[std::size_t(corner)]) {
            if (takes_whole(f)) return std::nullopt;
        }
        for (const Neighbour& next : neighbours_[std::size_t(corner)]) {
            const double there = height(next.corner);
            if (there > 0) {
                if (!off.takes(next.corner)) off.gone.push_back(next.corner);
                continue;
            }
            const double part = above / (above - there);
            const Vec3 &a = places_[std::size_t(corner)], &b = places_[std::size_t(next.corner)];
            off.made.push_back({a + part * (b - a), corner, next.corner, next.facets});
        }
        if (off.gone.size() > most) return std::nullopt;
    }
    return off;
}

double CornerNet::edge_length(int from, int to, const CutOff& off) const {
    const bool from_gone = off.takes(from), to_gone = off.takes(to);
    if (from_gone && to_gone) return 0;
    const Vec3 &a = places_[std::size_t(from)], &b = places_[std::size_t(to)];
    if (!from_gone && !to_gone) return glm::length(b - a);
    const int gone = from_gone ? from : to, kept = from_gone ? to : from;
    for (const CutOff::NewCorner& corner : off.made) {
        if (corner.gone == gone && corner.kept == kept) {
            return glm::length(corner.place - places_[std::size_t(kept)]);
        }
    }
    return glm::length(b - a);
}

double CornerNet::reach(const Vec3& direction, const CutOff& off, int facet) const {
    double most = -1e300;
    const auto take = [&](const Vec3& p) { most = std::max(most, glm::dot(direction, p)); };
    const auto take_corner = [&](int c) {
        if (!off.takes(c)) take(places_[std::size_t(c)]);
    };
    if (facet < 0) {
        for (std::size_t c = 0; c < places_.size(); ++c) take_corner(int(c));
    } else {
        for (const int c : loop(facet)) take_corner(c);
    }
    for (const CutOff::NewCorner& corner : off.made) {
        if (facet < 0 || corner.facets.first == facet || corner.facets.second == facet) {
            take(corner.place);
        }
    }
    return most;
}

double CornerNet::volume(const Plane& plane, const CutOff& off) const {
    // Pyramids over the parts of the facets above the plane, with their tips at a point on it.
    if (off.made.empty()) return 0;
    const Vec3 tip = off.made.front().place;
    double six = 0;
    std::vector<int> facets;
    for (const int c : off.gone) {
        for (const int f : facets_of_[std::size_t(c)]) {
            if (std::find(facets.begin(), facets.end(), f) == facets.end()) facets.push_back(f);
        }
    }
    for (const int f : facets) {
        std::vector<Vec3> part;
        const std::vector<int>& corners = loop(f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec3 &a = places_[std::size_t(corners[i])],
                       &b = places_[std::size_t(corners[(i + 1) % corners.size()])];
            const double ha = height_above(plane, a), hb = height_above(plane, b);
            if (ha > 0) part.push_back(a);
            if ((ha > 0) != (hb > 0)) part.push_back(a + ha / (ha - hb) * (b - a));
        }
        for (std::size_t i = 1; i + 1 < part.size(); ++i) {
            six += glm::dot(part[0] - tip, glm::cross(part[i] - tip, part[i + 1] - tip));
        }
    }
    return six / 6;
}

}  // namespace culet
