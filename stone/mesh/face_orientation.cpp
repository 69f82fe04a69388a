#include "stone/mesh/face_orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "stone/mesh/face_soup.h"

namespace culet {

namespace {

std::vector<FaceSide> sides_of(const std::vector<SoupFace>& faces) {
    std::vector<FaceSide> sides;
    for (std::size_t f = 0; f < faces.size(); ++f)
        add_sides(faces[f].corners, static_cast<int>(f), sides);
    return sides;
}

/// Sorts `sides`.
bool are_paired(std::vector<FaceSide>& sides) {
    std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    if (sides.size() % 2 != 0) return false;
    const auto same = [](const FaceSide& a, const FaceSide& b) {
        return a.low == b.low && a.high == b.high;
    };
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        if (!same(sides[i], sides[i + 1])) return false;
        if (i > 0 && same(sides[i - 1], sides[i])) return false;
    }
    return true;
}

double volume_of(const FaceSoup& soup) {
    const Vec3 from = soup.vertices[std::size_t(soup.faces.front().corners.front())];
    double sum = 0;
    for (const SoupFace& face : soup.faces) {
        const auto at = [&](std::size_t i) {
            return soup.vertices[std::size_t(face.corners[i])] - from;
        };
        for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
            sum += glm::dot(at(0), glm::cross(at(i), at(i + 1)));
    }
    return sum / 6;
}

void turn_round(SoupFace& face) {
    std::reverse(face.corners.begin(), face.corners.end());
    face.turned = !face.turned;
}

}  // namespace

void add_sides(const std::vector<int>& corners, int face, std::vector<FaceSide>& sides) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const int a = corners[i], b = corners[(i + 1) % corners.size()];
        sides.push_back({std::min(a, b), std::max(a, b), face, a < b});
    }
}

std::optional<FacesToTurn> faces_to_turn(std::size_t count, std::vector<FaceSide> sides) {
    if (!are_paired(sides)) return {};
    std::vector<std::vector<std::pair<int, bool>>> neighbours(count);
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        const bool alike = sides[i].forward != sides[i + 1].forward;
        neighbours[std::size_t(sides[i].face)].emplace_back(sides[i + 1].face, alike);
        neighbours[std::size_t(sides[i + 1].face)].emplace_back(sides[i].face, alike);
    }
    FacesToTurn found{std::vector<bool>(count, false), 0};
    std::vector<bool>& turn = found.turn;
    std::vector<bool> seen(count, false);
    for (std::size_t first = 0; first < count; ++first) {
        if (seen[first]) continue;
        ++found.parts;
        std::vector<std::size_t> part{first};
        seen[first] = true;
        std::size_t turned = 0;
        for (std::size_t at = 0; at < part.size(); ++at) {
            turned += turn[part[at]] ? 1 : 0;
            for (const auto& [face, alike] : neighbours[part[at]]) {
                const auto next = static_cast<std::size_t>(face);
                const bool wanted = turn[part[at]] == alike;
                if (seen[next] && turn[next] != wanted) return {};
                if (seen[next]) continue;
                seen[next] = true;
                turn[next] = wanted;
                part.push_back(next);
            }
        }
        if (2 * turned <= part.size()) continue;
        for (const std::size_t face : part) turn[face] = !turn[face];
    }
    return found;
}

void drop_repeated_faces(FaceSoup& soup) {
    std::vector<std::pair<std::vector<int>, std::size_t>> keys;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        keys.emplace_back(soup.faces[f].corners, f);
        std::sort(keys.back().first.begin(), keys.back().first.end());
    }
    std::sort(keys.begin(), keys.end());
    std::vector<bool> repeats(soup.faces.size(), false);
    for (std::size_t i = 1; i < keys.size(); ++i)
        repeats[keys[i].second] = keys[i].first == keys[i - 1].first;
    std::vector<SoupFace> kept;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        if (!repeats[f]) kept.push_back(soup.faces[f]);
    }
    const std::size_t dropped = soup.faces.size() - kept.size();
    if (dropped == 0) return;
    std::vector<FaceSide> sides = sides_of(kept);
    if (!are_paired(sides)) return;
    soup.notes.push_back(fmt::format("left out {} {} the same corners as another", dropped,
                                     dropped == 1 ? "face that has" : "faces of which each has"));
    soup.faces = std::move(kept);
}

void orient_faces(FaceSoup& soup) {
    if (soup.faces.empty()) return;
    const auto found = faces_to_turn(soup.faces.size(), sides_of(soup.faces));
    if (!found) return;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        if (found->turn[f]) turn_round(soup.faces[f]);
    }
    if (volume_of(soup) < 0) {
        for (SoupFace& face : soup.faces) turn_round(face);
    }
}

}  // namespace culet
