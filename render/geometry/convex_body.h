#pragma once
// Where a ray meets a convex stone. Hits are decided by sign, without an epsilon.
//
// A guessed facet is confirmed by the planes that bound it alone: the ray's point on its plane lies
// inside all of them, by much more than rounding. Then it lies inside the facet, no other plane is
// met before, and the search over all planes would find the same facet and distance, to the bit.

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

/// What answered a ray from outside: the facet that it met, or two planes that it passed in the
/// order of a miss, out through the one before in through the other.
struct EntryGuess {
    int facet = -1, left = -1, entered = -1;
};

/// The facet planes of a convex solid, laid out for searching.
class ConvexBody {
public:
    explicit ConvexBody(const Solid& solid);

    /// The facet through which a ray from outside enters; nothing when it misses, or starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;
    /// The same; what answered the last ray is looked at first. That changes the time taken and
    /// nothing else.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction, EntryGuess& last) const;
    /// The facet through which a ray from inside leaves: of the planes that it runs towards, the
    /// nearest; of equally near ones the first. A start that rounding put outside a plane is taken
    /// as on it, so that a corner becomes two hits; the facet just left drops out because the ray
    /// runs away from it. `guess` is looked at first, e.g. what a neighbouring ray met (-1: none).
    BodyHit exit(const Vec3& origin, const Vec3& direction, int guess = -1) const;

    bool contains(const Vec3& point) const;
    const Vec3& normal(int facet) const { return normals_[static_cast<std::size_t>(facet)]; }
    /// The point moved onto the facet's plane.
    Vec3 on_facet(int facet, const Vec3& point) const {
        const Vec3& n = normal(facet);
        return point - (glm::dot(n, point) - offset_[static_cast<std::size_t>(facet)]) * n;
    }

private:
    // Four planes of those that come near one facet; the last block is filled up with planes that
    // hold everything.
    using Two = double __attribute__((vector_size(16)));  // of g++ and clang, for any processor
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

    std::vector<Vec3> normals_;
    std::vector<double> nx_, ny_, nz_, offset_;
    std::vector<NearPlanes> near_;
    std::vector<std::size_t> near_begin_;  // of each facet in near_, and the end
    double margin_ = 0, far_ = 0;
};

}  // namespace culet
