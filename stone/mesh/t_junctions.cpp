// Closes T-junctions: corners in the middle of another face's side, which modellers leave when they
// cut a face. The surface is open there although nothing is missing.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "stone/mesh/face_orientation.h"
#include "stone/mesh/face_soup.h"

namespace culet {

namespace {

std::vector<FaceSide> open_sides(const std::vector<SoupFace>& faces) {
    std::vector<FaceSide> sides, open;
    for (std::size_t f = 0; f < faces.size(); ++f)
        add_sides(faces[f].corners, static_cast<int>(f), sides);
    const auto ends = [](const FaceSide& s) { return std::pair(s.low, s.high); };
    std::sort(sides.begin(), sides.end(), [&](const FaceSide& a, const FaceSide& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        for (end = i; end < sides.size() && ends(sides[end]) == ends(sides[i]);) ++end;
        if (end - i == 1) open.push_back(sides[i]);
    }
    return open;
}

class CornersOfOpenSides {
public:
    CornersOfOpenSides(const FaceSoup& soup, const std::vector<FaceSide>& open, double tolerance)
        : soup_(soup), tolerance_(tolerance) {
        for (const FaceSide& side : open) {
            for (const int corner : {side.low, side.high})
                corners_.emplace_back(at(corner).x, corner);
        }
        std::sort(corners_.begin(), corners_.end());
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    }

    /// Sorted along the line.
    std::vector<int> between(int from, int to) const {
        const Vec3 p = at(from), along = at(to) - p;
        const double length = glm::length(along);
        std::vector<std::pair<double, int>> found;
        if (!(length > 2 * tolerance_)) return {};
        const auto [low, high] = std::minmax(at(from).x, at(to).x);
        for (auto c = std::lower_bound(corners_.begin(), corners_.end(),
                                       std::pair(low - tolerance_, -1));
             c != corners_.end() && c->first <= high + tolerance_; ++c) {
            const Vec3 off = at(c->second) - p;
            const double way = glm::dot(off, along) / length;
            if (way > tolerance_ && way < length - tolerance_ &&
                glm::length(off - way / length * along) <= tolerance_) {
                found.emplace_back(way, c->second);
            }
        }
        std::sort(found.begin(), found.end());
        std::vector<int> corners;
        for (const auto& [way, corner] : found) corners.push_back(corner);
        return corners;
    }

private:
    const Vec3& at(int corner) const { return soup_.vertices[std::size_t(corner)]; }

    const FaceSoup& soup_;
    double tolerance_;
    std::vector<std::pair<double, int>> corners_;  // by x
};

}  // namespace

void close_t_junctions(FaceSoup& soup, double tolerance) {
    const std::vector<FaceSide> open = open_sides(soup.faces);
    if (open.empty()) return;
    const CornersOfOpenSides corners(soup, open, tolerance);
    std::vector<SoupFace> faces = soup.faces;
    std::size_t added = 0;
    for (const FaceSide& side : open) {
        std::vector<int>& loop = faces[std::size_t(side.face)].corners;
        const int from = side.forward ? side.low : side.high,
                  to = side.forward ? side.high : side.low;
        const std::vector<int> within = corners.between(from, to);
        const bool known = std::any_of(within.begin(), within.end(), [&](int corner) {
            return std::find(loop.begin(), loop.end(), corner) != loop.end();
        });
        if (within.empty() || known) continue;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (loop[i] != from || loop[(i + 1) % loop.size()] != to) continue;
            loop.insert(loop.begin() + std::ptrdiff_t(i) + 1, within.begin(), within.end());
            added += within.size();
            break;
        }
    }
    if (open_sides(faces).size() >= open.size()) return;
    soup.faces = std::move(faces);
    soup.notes.push_back(
        fmt::format("{} of a face lay in the middle of a neighbour's edge: {} put into that edge",
                    added == 1 ? "a corner" : fmt::format("{} corners", added),
                    added == 1 ? "it was" : "they were"));
}

}  // namespace culet
