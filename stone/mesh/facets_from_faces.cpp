// Turns the faces of a mesh file into named planar facets.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "stone/design/design.h"
#include "stone/mesh/face_soup.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

/// Planes from comments without a hash are used if corners are off by at most this share of the
/// diameter, a little more than the meets of real designs miss.
constexpr double k_plane_agrees = 1e-3;

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

/// The plane passes through the corners, unless the file gives the direction to more digits than
/// they do (culet's ASCII STL).
Plane facet_plane(const FaceSoup& soup, const SoupFace& outline, bool precise_normals,
                  double size) {
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

void tell_turned_facets(const std::vector<SoupFace>& outlines, const Solid& solid, FaceSoup& soup) {
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

std::vector<SoupFace> stated_outlines(FaceSoup& soup) {
    orient_faces(soup);
    for (std::size_t i = 0; i < soup.faces.size(); ++i) {
        Plane& plane = soup.planes[i].plane;
        if (soup.faces[i].turned) plane = {-plane.normal, -plane.offset};
    }
    return soup.faces;
}

/// Returns the new index of each vertex; -1: no outline has it.
std::vector<int> keep_used_vertices(const FaceSoup& soup, const std::vector<SoupFace>& outlines,
                                    Solid& solid) {
    std::vector<bool> used(soup.vertices.size(), false);
    for (const SoupFace& outline : outlines) {
        for (const int corner : outline.corners) used[corner] = true;
    }
    std::vector<int> index(soup.vertices.size(), -1);
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        index[v] = static_cast<int>(solid.vertices.size());
        solid.vertices.push_back(soup.vertices[v]);
    }
    return index;
}

void add_design(FaceSoup& soup, Solid& solid) {
    if (soup.design.empty()) return;
    try {
        solid.design = std::make_shared<const Design>(design_in(soup.design));
    } catch (const InputError& error) {
        soup.notes.push_back(
            fmt::format("the design in its comments is left out: {}", error.what()));
    }
}

}  // namespace

ReadSolid solid_from_faces(FaceSoup soup) {
    tell_unused_vertices(soup);
    const StatedPlanes stated = judge_stated_planes(soup);
    if (stated != StatedPlanes::none) name_faces_by_planes(soup);
    const double size = size_of(soup);
    const double tolerance = merging_tolerance(soup, size);
    const std::vector<SoupFace> outlines =
        stated == StatedPlanes::all ? stated_outlines(soup) : merged_outlines(soup, tolerance);

    ReadSolid result;
    const bool precise_normals = soup.normal_precision.rounding() < 1e-14;
    const std::vector<int> index = keep_used_vertices(soup, outlines, result.solid);
    std::vector<std::string> names;
    for (const SoupFace& outline : outlines) {
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
    add_design(soup, result.solid);
    result.notes = std::move(soup.notes);
    result.changed = std::move(soup.changed);
    result.planes_stated = stated == StatedPlanes::all;
    return result;
}

}  // namespace culet
