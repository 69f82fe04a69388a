#pragma once
// The expected value of each reading at a given shape, with its derivatives. All are closed forms,
// tested against finite differences.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "fit/model/shape.h"

namespace culet {

/// A corner of the stone: one of the unknown points (exact meets), or the crossing of three planes
/// (split meets).
struct Corner {
    int point = -1;
    std::array<int, 3> planes{-1, -1, -1};
};

/// The corners that bound each facet, counter-clockwise from outside; empty for a missing facet.
struct Outline {
    std::vector<Corner> corners;
    std::vector<std::vector<int>> loops;
};

/// A number and its derivatives by the unknowns.
struct Quantity {
    enum class By { normal, offset, point, extra };
    struct Slope {
        By by;
        int index;
        Vec3 slope;  ///< offset and extra use x only
    };
    double value = 0;
    std::vector<Slope> slopes;

    void add(By by, int index, const Vec3& slope) {
        // Most have at most four, and each step of a fit makes hundreds.
        if (slopes.empty()) slopes.reserve(4);
        slopes.push_back({by, index, slope});
    }
    void add(By by, int index, double slope) { add(by, index, {slope, 0, 0}); }
    /// this += factor * other
    void add(const Quantity& other, double factor);
};

/// A quantity as a function of the shape, for a fixed set of corners.
using Formula = std::function<Quantity(const Shape&)>;

Vec3 place_of(const Shape& shape, const Corner& corner);
/// Adds slope . d(corner) to the quantity. For a crossing of planes N p = d: d(p) = N^-1
/// (d(offset_i) - d(normal_i) . p).
void add_corner(Quantity& quantity, const Shape& shape, const Corner& corner, const Vec3& slope);

/// Angle from the horizontal, 0..pi/2; `up` is +z.
Formula tilt_from_up(int facet);
/// The same counted from up (side 1) or down (side -1), 0..pi: smooth where a girdle facet passes
/// the vertical, unlike the acute angle.
Formula tilt_from_side(int facet, int side);
/// The x or y component (0, 1) of a normal. Both zero make a facet level, where the angle itself
/// has no derivative.
Formula horizontal_component(int facet, int component);
/// Acute angle between two facets' normals, 0..pi/2.
Formula tilt_between(int facet, int datum);
/// Acute angle between a normal and the girdle's axis: the direction most nearly parallel to these
/// facets (the least eigenvector of the sum of n n').
Formula tilt_from_axis(int facet, std::vector<int> girdle_facets);
/// Angle between a normal and that of the least-squares plane of these corners.
Formula tilt_from_plane(int facet, std::vector<Corner> corners);
/// Azimuth of a normal (minus that of `datum` unless -1) minus `value`, in (-pi, pi].
Formula azimuth_error(int facet, int datum, double value);
/// Interior angle at the edge of two facets.
Formula interior_angle(int facet, int other);
/// direction . (a - b)
Formula extent(const Corner& a, const Corner& b, const Vec3& direction);
/// |a - b|
Formula corner_distance(const Corner& a, const Corner& b);
/// Signed length of an edge: from one corner to the other along the line in which two planes cross,
/// where left's corners run counter-clockwise. It passes smoothly through zero and is negative
/// where the edge is inside out; |from - to| has a kink there that holds the edge inside out.
Formula edge_length(int left, int right, const Corner& from, const Corner& to);
/// normal . x - offset
Formula height(int facet, const Corner& corner);
/// |height|
Formula corner_to_facet(int facet, const Corner& corner);
/// Distance of a corner from the line through two others.
Formula corner_to_line(const Corner& corner, const Corner& from, const Corner& to);
/// Distance between the lines a-b and c-d; if they are nearly parallel, that of the middle of c-d.
Formula line_to_line(const Corner& a, const Corner& b, const Corner& c, const Corner& d);
/// Mean distance of each facet's mean corner from the other's plane: their spacing when parallel.
Formula spacing(int facet, int other, std::vector<Corner> corners,
                std::vector<Corner> other_corners);
/// Volume by the divergence theorem over the fans of all loops.
Formula enclosed_volume(std::shared_ptr<const Outline> outline);
/// Area of a planar loop of corners.
Formula enclosed_area(std::vector<Corner> loop);
Formula mean_of(std::vector<Formula> terms);
Formula weighted_sum(std::vector<std::pair<double, Formula>> terms);
/// Constant unit direction . (normal f rotated by `angle` about +z - normal g)
Formula turned_normal(int f, int g, double angle, const Vec3& direction);
/// Height above plane g of the mean of corners, rotated by `angle` about the axis at extras
/// (centre, centre + 1).
Formula turned_height(std::vector<Corner> corners, int g, double angle, int centre);
/// direction . (normal f turned by `angle` about +z)
Formula turned_component(int f, double angle, const Vec3& direction);
/// The mirror plane m . x = e: the azimuth of m is in extra `azimuth` (-1: fixed), e in extra
/// `offset`.
struct MirrorPlane {
    int azimuth = -1, offset = -1;
    double fixed_azimuth = 0;
};
/// Constant direction . (mirrored normal f - normal g)
Formula mirrored_normal(int f, int g, const MirrorPlane& plane, const Vec3& direction);
/// Height above plane g of the mirrored mean of corners.
Formula mirrored_height(std::vector<Corner> corners, int g, const MirrorPlane& plane);
/// m . normal: zero for a facet that is its own mirror image.
Formula across_mirror(int f, const MirrorPlane& plane);
Formula extra_unknown(int extra);
/// direction . (normal f - sign * normal g)
Formula normal_difference(int f, int g, double sign, const Vec3& direction);
/// offset f - sign * offset g
Formula offset_difference(int f, int g, double sign);
/// direction . point - value
Formula point_component(int point, const Vec3& direction, double value);

}  // namespace culet
