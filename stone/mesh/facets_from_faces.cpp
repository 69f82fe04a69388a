// Turns the faces of a mesh file into named planar facets.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <unordered_map>
#include <utility>

#include "stone/design/design.h"
#include "stone/mesh/face_soup.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

/// Planes from comments without a hash are used if corners are off by at most this share of the
/// diameter, a little more than the meets of real designs miss.
constexpr double k_plane_agrees = 1e-3;

struct Outline {
    std::vector<int> corners;
    int name = -1;
    Vec3 given_normal{0, 0, 0};
    bool turned = false;
};

std::vector<Vec3> loop_of(const FaceSoup& soup, const std::vector<int>& corners) {
    std::vector<Vec3> loop;
    for (const int corner : corners) loop.push_back(soup.vertices[corner]);
    return loop;
}

double largest_miss(const FaceSoup& soup, const std::vector<int>& corners, const Plane& plane) {
    double miss = 0;
    for (const int corner : corners) {
        miss = std::max(miss, std::abs(height_above(plane, soup.vertices[corner])));
    }
    return miss;
}

enum class StatedPlanes { none, names_only, all };

StatedPlanes judge_stated_planes(FaceSoup& soup) {
    if (soup.planes.empty()) return StatedPlanes::none;
    if (soup.planes.size() != soup.faces.size()) {
        soup.notes.push_back(fmt::format(
            "the file states {} facet planes in comments but has {} faces: planes are taken from "
            "the corners",
            soup.planes.size(), soup.faces.size()));
        return StatedPlanes::none;
    }
    std::vector<const std::vector<int>*> outlines;
    for (const SoupFace& face : soup.faces) outlines.push_back(&face.corners);
    if (soup.corner_hash) {
        if (*soup.corner_hash == corner_hash(soup.vertices, outlines)) return StatedPlanes::all;
        soup.notes.push_back(
            "the mesh was edited since its facet planes were noted in comments: planes are taken "
            "from the corners");
        return StatedPlanes::names_only;
    }
    const double limit = k_plane_agrees * size_of(soup);
    for (std::size_t i = 0; i < soup.faces.size(); ++i) {
        const std::vector<int>& corners = soup.faces[i].corners;
        const Plane own = plane_through(loop_of(soup, corners));
        if (glm::dot(own.normal, soup.planes[i].plane.normal) > 0 &&
            largest_miss(soup, corners, soup.planes[i].plane) <= limit) {
            continue;
        }
        soup.notes.push_back(
            fmt::format("the plane that a comment states for facet {} is not that of its corners: "
                        "planes are taken from the corners",
                        shown(soup.planes[i].name)));
        return StatedPlanes::names_only;
    }
    return StatedPlanes::all;
}

void name_faces_by_planes(FaceSoup& soup) {
    for (std::size_t i = 0; i < soup.faces.size(); ++i) {
        if (soup.faces[i].name >= 0 || soup.planes[i].name.empty()) continue;
        soup.faces[i].name = static_cast<int>(soup.names.size());
        soup.names.push_back(soup.planes[i].name);
    }
}

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

std::vector<Outline> merge_faces(FaceSoup& soup, double tolerance) {
    const std::vector<int> facet = facet_of_face(soup, tolerance);
    int count = 0;
    for (const int f : facet) count = std::max(count, f + 1);
    std::vector<std::vector<int>> members(count);
    for (std::size_t i = 0; i < facet.size(); ++i) {
        members[facet[i]].push_back(static_cast<int>(i));
    }
    std::vector<Outline> outlines;
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

void drop_straight_corners(const FaceSoup& soup, std::vector<Outline>& outlines, double tolerance) {
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

/// The plane passes through the corners, unless the file gives the direction to more digits than
/// they do (culet's ASCII STL).
Plane facet_plane(const FaceSoup& soup, const Outline& outline, bool precise_normals, double size) {
    const Plane own = plane_through(loop_of(soup, outline.corners));
    const double length = glm::length(outline.given_normal);
    if (!precise_normals || !(length > 0)) return own;
    Plane given{outline.given_normal / length, 0};
    // Corners at near-miss meets scatter about the plane: take the middle of their heights.
    double low = INFINITY, high = -INFINITY;
    for (const int corner : outline.corners) {
        const double height = glm::dot(given.normal, soup.vertices[corner]);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    given.offset = 0.5 * (low + high);
    const bool agrees =
        glm::dot(given.normal, own.normal) > 0 && high - low <= 2 * k_plane_agrees * size;
    return agrees ? given : own;
}

void tell_unused_vertices(FaceSoup& soup) {
    std::vector<bool> used(soup.vertices.size(), false);
    for (const SoupFace& face : soup.faces) {
        for (const int corner : face.corners) used[corner] = true;
    }
    const auto unused = std::count(used.begin(), used.end(), false);
    if (unused > 0) {
        soup.notes.push_back(fmt::format("left out {} vertices that belong to no face", unused));
    }
}

void tell_turned_facets(const std::vector<Outline>& outlines, const Solid& solid, FaceSoup& soup) {
    constexpr int k_most_named = 5;
    std::string names;
    int count = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (!outlines[i].turned) continue;
        if (++count <= k_most_named)
            names += (count == 1 ? "" : ", ") + shown(solid.facets[i].name);
    }
    if (count == 0) return;
    std::string why;
    if (std::all_of(soup.faces.begin(), soup.faces.end(),
                    [](const SoupFace& face) { return face.turned; })) {
        why =
            "the mesh was inside out (its faces ran clockwise as seen from outside): all faces "
            "were turned round";
    } else if (count == 1) {
        why = fmt::format(
            "facet {} was inside out (it ran the other way round than its neighbours): it was "
            "turned round",
            names);
    } else {
        why = fmt::format(
            "{} facets were inside out (they ran the other way round than their neighbours): {}{} "
            "were turned round",
            count, names, count > k_most_named ? ", ..." : "");
    }
    soup.notes.push_back(why);
    soup.changed.push_back(facets_turned_round(why, count));
}

}  // namespace

ReadSolid solid_from_faces(FaceSoup soup) {
    tell_unused_vertices(soup);
    const StatedPlanes stated = judge_stated_planes(soup);
    if (stated != StatedPlanes::none) name_faces_by_planes(soup);
    const double size = size_of(soup);
    const double tolerance = merging_tolerance(soup, size);
    std::vector<Outline> outlines;
    if (stated == StatedPlanes::all) {
        orient_faces(soup);
        for (std::size_t i = 0; i < soup.faces.size(); ++i) {
            SoupFace& face = soup.faces[i];
            Plane& plane = soup.planes[i].plane;
            if (face.turned) plane = {-plane.normal, -plane.offset};
            outlines.push_back({std::move(face.corners), face.name, {}, face.turned});
        }
    } else {
        weld_vertices(soup);
        drop_collapsed_faces(soup);
        drop_repeated_faces(soup);
        close_t_junctions(soup, tolerance);
        orient_faces(soup);
        outlines = merge_faces(soup, tolerance);
        drop_straight_corners(soup, outlines, tolerance);
    }

    ReadSolid result;
    const bool precise_normals = soup.normal_precision.rounding() < 1e-14;
    std::vector<bool> used(soup.vertices.size(), false);
    for (const Outline& outline : outlines) {
        for (const int corner : outline.corners) used[corner] = true;
    }
    std::vector<int> index(soup.vertices.size(), -1);
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        index[v] = static_cast<int>(result.solid.vertices.size());
        result.solid.vertices.push_back(soup.vertices[v]);
    }
    std::vector<std::string> names;
    for (const Outline& outline : outlines) {
        names.push_back(outline.name >= 0 ? soup.names[outline.name] : std::string());
    }
    names = unique_names(std::move(names));
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        Facet facet;
        facet.name = std::move(names[i]);
        facet.plane = stated == StatedPlanes::all
                          ? soup.planes[i].plane
                          : facet_plane(soup, outlines[i], precise_normals, size);
        for (const int corner : outlines[i].corners) facet.corners.push_back(index[corner]);
        result.solid.facets.push_back(std::move(facet));
    }
    tell_turned_facets(outlines, result.solid, soup);
    if (!soup.design.empty()) {
        try {
            result.solid.design = std::make_shared<const Design>(design_in(soup.design));
        } catch (const InputError& error) {
            soup.notes.push_back(
                fmt::format("the design in its comments is left out: {}", error.what()));
        }
    }
    result.notes = std::move(soup.notes);
    result.changed = std::move(soup.changed);
    result.planes_stated = stated == StatedPlanes::all;
    return result;
}

}  // namespace culet
