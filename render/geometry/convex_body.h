#pragma once
// Intersection of rays with a convex stone. Hits are decided by sign, without an epsilon.
//
// A guessed facet is confirmed with the planes that bound it: the ray's point on its plane must lie
// inside all of them by much more than rounding. Then no other plane is hit before, and the search
// over all planes would find the same facet and distance, to the bit.

#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct BodyHit {
    int facet = -1;
    double distance = 0;
};

/// What answered the last ray from outside: the facet that it hit, or two planes that show a miss
/// (it left through `left` before it entered through `entered`).
struct EntryGuess {
    int facet = -1, left = -1, entered = -1;
};

/// The facet planes of a convex solid, arranged for searching.
class ConvexBody {
public:
    explicit ConvexBody(const Solid& solid);

    /// Facet through which a ray from outside enters; nothing if it misses or starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;
    /// The same, but tries `last` first and updates it; changes only the time.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction, EntryGuess& last) const;
    /// Facet through which a ray from inside exits: the nearest plane that it runs towards, the
    /// first of equally near ones. A start that rounding put outside counts as on the plane, so a
    /// corner becomes two hits. The ray runs away from the facet just left, so this is ignored.
    /// `guess` is tried first (-1: none), e.g. a neighbouring ray's facet.
    BodyHit exit(const Vec3& origin, const Vec3& direction, int guess = -1) const;

    bool contains(const Vec3& point) const;
    /// Whether any facet, or this one, is ground instead of polished.
    bool has_ground() const { return !ground_.empty(); }
    bool ground(int facet) const {
        return has_ground() && ground_[static_cast<std::size_t>(facet)];
    }
    const Vec3& normal(int facet) const { return normals_[static_cast<std::size_t>(facet)]; }
    /// Projects the point onto the facet's plane.
    Vec3 on_facet(int facet, const Vec3& point) const {
        const Vec3& n = normal(facet);
        return point - (glm::dot(n, point) - offset_[static_cast<std::size_t>(facet)]) * n;
    }

private:
    // Four of the planes near a facet; the last block is padded with planes that contain
    // everything.
    using Two = double __attribute__((vector_size(16)));  // vector extension of g++ and clang, for
                                                          // any processor
    struct NearPlanes {
        std::array<Two, 2> nx{}, ny{}, nz{}, offset{};
        std::array<int, 4> facet{};

        Two towards(std::size_t pair, const Vec3& d) const {
            return nx[pair] * d.x + ny[pair] * d.y + nz[pair] * d.z;
        }
        Two below(std::size_t pair, const Vec3& p) const { return offset[pair] - towards(pair, p); }
    };
    void measure(std::size_t start, std::size_t size, const Vec3& origin, const Vec3& direction,
                 double* towards, double* below) const;
    void find_near_planes(const Solid& solid);
    std::vector<Vec3> outline(int facet, const Vec3& middle, double reach) const;
    bool surely_on_facet(int facet, const Vec3& point) const;
    int nearest_about(int facet, const Vec3& origin, const Vec3& direction) const;
    BodyHit exit_of_all(const Vec3& origin, const Vec3& direction) const;

    std::vector<bool> ground_;
    std::vector<Vec3> normals_;
    std::vector<double> nx_, ny_, nz_, offset_;
    std::vector<NearPlanes> near_;
    std::vector<std::size_t> near_begin_;  // start of each facet's blocks in near_, and the end
    double margin_ = 0, far_ = 0;
};

}  // namespace culet
