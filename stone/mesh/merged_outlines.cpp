// The outlines of facets: faces of one plane merged, without corners in straight edges.

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "stone/mesh/face_soup.h"

namespace culet {

namespace {

/// Removes repeated corners, and faces without area because of that.
void drop_collapsed_faces(FaceSoup& soup) {
    const std::size_t before = soup.faces.size();
    for (SoupFace& face : soup.faces) {
        auto& corners = face.corners;
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    }
    std::erase_if(soup.faces, [](const SoupFace& face) { return face.corners.size() < 3; });
    if (soup.faces.size() < before) {
        soup.notes.push_back(fmt::format("left out {} faces with fewer than three distinct corners",
                                         before - soup.faces.size()));
    }
}

/// Empty when it is not a single loop.
std::vector<int> outline_of(const FaceSoup& soup, const std::vector<int>& members) {
    std::vector<std::pair<int, int>> sides;
    for (const int f : members) {
        const std::vector<int>& corners = soup.faces[f].corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            sides.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
        }
    }
    std::vector<std::pair<int, int>> sorted = sides;
    std::sort(sorted.begin(), sorted.end());
    std::unordered_map<int, int> next;
    int start = -1;
    for (const auto& [from, to] : sides) {
        if (std::binary_search(sorted.begin(), sorted.end(), std::pair(to, from))) continue;
        if (start < 0) start = from;
        if (!next.emplace(from, to).second) return {};
    }
    std::vector<int> outline;
    for (int at = start; start >= 0 && outline.size() <= next.size();) {
        outline.push_back(at);
        const auto step = next.find(at);
        if (step == next.end()) return {};
        at = step->second;
        if (at == start) break;
    }
    return outline.size() == next.size() && outline.size() >= 3 ? outline : std::vector<int>{};
}

std::vector<SoupFace> merge_faces(FaceSoup& soup, double tolerance) {
    const std::vector<int> facet = facet_of_face(soup, tolerance);
    int count = 0;
    for (const int f : facet) count = std::max(count, f + 1);
    std::vector<std::vector<int>> members(count);
    for (std::size_t i = 0; i < facet.size(); ++i) {
        members[facet[i]].push_back(static_cast<int>(i));
    }
    std::vector<SoupFace> outlines;
    int holed = 0;
    for (const std::vector<int>& faces : members) {
        const SoupFace& first = soup.faces[faces.front()];
        std::vector<int> outline = faces.size() > 1 ? outline_of(soup, faces) : first.corners;
        if (!outline.empty()) {
            const bool turned = std::any_of(faces.begin(), faces.end(),
                                            [&](int f) { return soup.faces[f].turned; });
            outlines.push_back({std::move(outline), first.name, first.given_normal, turned});
            continue;
        }
        // It has a hole, or touches itself in a corner, so it cannot be one facet.
        ++holed;
        for (const int f : faces) {
            outlines.push_back(
                {soup.faces[f].corners, soup.faces[f].name, {}, soup.faces[f].turned});
        }
    }
    if (outlines.size() < soup.faces.size()) {
        soup.notes.push_back(
            fmt::format("merged {} faces into {} facets", soup.faces.size(), outlines.size()));
    }
    if (holed > 0) {
        soup.notes.push_back(fmt::format(
            "{} facets have a hole or touch themselves: their faces are left unmerged", holed));
    }
    return outlines;
}

void drop_straight_corners(const FaceSoup& soup, std::vector<SoupFace>& outlines,
                           double tolerance) {
    std::vector<std::vector<int>> facets_at(soup.vertices.size());
    for (std::size_t f = 0; f < outlines.size(); ++f) {
        for (const int corner : outlines[f].corners) {
            facets_at[corner].push_back(static_cast<int>(f));
        }
    }
    for (int v = 0; v < static_cast<int>(soup.vertices.size()); ++v) {
        if (facets_at[v].size() != 2 || facets_at[v][0] == facets_at[v][1]) continue;
        auto& a = outlines[facets_at[v][0]].corners;
        auto& b = outlines[facets_at[v][1]].corners;
        if (a.size() <= 3 || b.size() <= 3) continue;
        const auto in_a = std::find(a.begin(), a.end(), v);
        const auto in_b = std::find(b.begin(), b.end(), v);
        const int before_a = in_a == a.begin() ? a.back() : *(in_a - 1);
        const int after_a = in_a + 1 == a.end() ? a.front() : *(in_a + 1);
        const int before_b = in_b == b.begin() ? b.back() : *(in_b - 1);
        const int after_b = in_b + 1 == b.end() ? b.front() : *(in_b + 1);
        if (before_a != after_b || after_a != before_b) continue;
        const Vec3 &p = soup.vertices[before_a], &q = soup.vertices[after_a];
        const Vec3& x = soup.vertices[v];
        const double length = glm::length(q - p);
        if (!(glm::dot(x - p, x - q) < 0) ||
            !(glm::length(glm::cross(x - p, q - p)) <= tolerance * length)) {
            continue;
        }
        a.erase(in_a);
        b.erase(in_b);
    }
}

}  // namespace

std::vector<SoupFace> merged_outlines(FaceSoup& soup, double tolerance) {
    weld_vertices(soup);
    drop_collapsed_faces(soup);
    drop_repeated_faces(soup);
    close_t_junctions(soup, tolerance);
    orient_faces(soup);
    std::vector<SoupFace> outlines = merge_faces(soup, tolerance);
    drop_straight_corners(soup, outlines, tolerance);
    return outlines;
}

}  // namespace culet
