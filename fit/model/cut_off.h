#pragma once
// What a further plane would take off a convex stone. Private to the room.

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "fit/model/residuals.h"

namespace culet {

/// The part of a stone above a plane.
struct CutOff {
    std::vector<int> gone;  ///< corners above the plane
    /// A corner where the plane crosses an edge: between a corner that is gone and one that stays.
    struct NewCorner {
        Vec3 place;
        int gone = -1, kept = -1;
        std::pair<int, int> facets;  ///< whose edge it lies on
    };
    std::vector<NewCorner> made;

    bool takes(int corner) const;
};

/// The corners of an outline as places, and who is next to whom.
class CornerNet {
public:
    CornerNet(const Shape& shape, const Outline& outline);

    const std::vector<Vec3>& places() const { return places_; }
    const std::vector<int>& loop(int facet) const { return loops_[std::size_t(facet)]; }
    /// The ends of the edge between two facets, or nothing.
    std::optional<std::pair<int, int>> edge(int facet, int other) const;
    /// The corner of these facets that lies highest along a direction; -1 without corners.
    int highest(const std::vector<int>& facets, const Vec3& direction) const;

    /// What lies above normal . x = offset, as far as it hangs together with corner `from`. Nothing
    /// when that takes a whole facet away, or more than `most` corners, or no edge's part at all.
    std::optional<CutOff> above(const Plane& plane, int from, std::size_t most = 60) const;

    /// How long the edge between two corners is once the part is off.
    double edge_length(int from, int to, const CutOff& off) const;
    /// How far the stone (or one facet of it) reaches along a direction once the part is off.
    double reach(const Vec3& direction, const CutOff& off, int facet = -1) const;
    /// Volume of the part.
    double volume(const Plane& plane, const CutOff& off) const;

private:
    struct Neighbour {
        int corner = -1;
        std::pair<int, int> facets;
    };
    std::vector<Vec3> places_;
    std::vector<std::vector<int>> loops_, facets_of_;
    std::vector<std::vector<Neighbour>> neighbours_;
    std::map<std::pair<int, int>, std::pair<int, int>> edges_;  // by facets, the lower first
};

}  // namespace culet
