#pragma once
// The geometry of a cut stone: named planar facets that bound a solid.
// Frame: right-handed, z up through the table, x to azimuth 0.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

struct Design;  // design.h

/// The plane normal . x = offset; the unit normal points out of the stone.
struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

double height_above(const Plane& plane, const Vec3& point);

/// One polished face. The plane is authoritative. Corners are the meets of planes; where a design's
/// meets miss, a corner may be off the plane by as much.
struct Facet {
    std::string name;
    Plane plane;
    std::vector<int> corners;  ///< indices into Solid::vertices, counter-clockwise from outside
};

/// A closed polyhedron of named facets. Plain data: functions may be given a broken one;
/// `find_faults` (checks.h) says what is wrong with it.
struct Solid {
    std::vector<Vec3> vertices;
    std::vector<Facet> facets;
    /// The design that its facets were cut by, or are to be; null: unknown. Facets are found by
    /// name.
    std::shared_ptr<const Design> design = nullptr;
};

/// Returns -1 if there is none.
int find_facet(const Solid& solid, std::string_view name);

/// Twice the largest distance from the bounding box's middle to a vertex. 0 without vertices.
double diameter(const Solid& solid);

/// Distance between caliper jaws along a direction of any length.
double width_along(const Solid& solid, const Vec3& direction);

/// Uses the divergence theorem over the facets' corner fans; negative when inside-out.
double volume(const Solid& solid);

Vec3 centroid(const Solid& solid);

double area(const Solid& solid, const Facet& facet);
/// Area / longest diagonal: about the width of a slender facet. 0 where all corners coincide.
double narrow_width(const Solid& solid, const Facet& facet);

/// Angle between two directions of any length, radians in [0, pi]; accurate also for nearly
/// parallel ones.
double angle_between(const Vec3& a, const Vec3& b);

Vec3 corner_mean(const Solid& solid, const Facet& facet);

/// Best-fitting plane through a loop of points (Newell 1972): the loop is counter-clockwise about
/// the normal, and the offset is that of the mean point. The normal is (0,0,0) when the loop has no
/// area.
Plane plane_through(std::span<const Vec3> loop);

/// Largest distance of a corner from its facet's plane.
double planarity(const Solid& solid);

/// Number of distinct edges, open ones included.
int edge_count(const Solid& solid);

struct NamedPlane {
    std::string name;
    Plane plane;
};

struct HalfSpaceSolid {
    Solid solid;                       ///< facets in the order of the planes that have one
    std::vector<int> repeated_planes;  ///< planes equal to an earlier one
    std::vector<int> unused_planes;    ///< planes that touch nothing, or only a corner or an edge
    bool bounded = true;               ///< false: the planes leave the solid open; solid is empty
    bool empty = false;                ///< true: no point satisfies all of them; solid is empty
};

/// The convex solid of all points with normal . x <= offset. Decisions are exact for the given
/// doubles (CGAL), so meets that miss by rounding give short edges; see `contract_near_meets`.
/// Cost: about planes x vertices exact side tests.
HalfSpaceSolid intersect_half_spaces(std::span<const NamedPlane> planes);

/// Contracts edges up to `tolerance` long (0 merges coincident corners), shortest first, so that
/// near meets become one corner. It lies at the least-squares meet of its planes; facets keep their
/// planes. Facets that vanish are removed and named in `vanished`.
struct ContractedSolid {
    Solid solid;
    int contracted_edges = 0;
    std::vector<std::string> vanished;
};
ContractedSolid contract_near_meets(const Solid& solid, double tolerance);

}  // namespace culet
