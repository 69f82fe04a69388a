#pragma once
// Beams in a crystal, where every face splits them: each follows one wave, as exactly as the
// reference's rays (crystal.h). Powers are added; coherence is lost.
//
// Each small cell of the picture has a reference ray and two neighbouring rays, which give all
// derivatives over the cell. They are traced exactly along facets and waves. A neighbour that
// misses the reference ray's facet is intersected with that facet's plane.

#include <array>
#include <functional>
#include <vector>

#include "render/beams/region_splitter.h"
#include "render/optics/band.h"
#include "render/optics/crystal.h"
#include "render/optics/stokes.h"

namespace culet {

/// Light of a beam where it leaves the stone: value, x derivative and y derivative at the reference
/// point.
struct LeavingBeam {
    ScreenPoint reference;
    std::array<Vec3, 3> point, direction, s;
    /// Share of the eye's unit of light before absorption; Stokes parameters Q and U in the frame
    /// of s and direction x s.
    std::array<double, 3> weight{}, Q{}, U{};
    std::array<NodeWeights, 3> transmitted{};  ///< fraction not absorbed
    int facets = 1;                            ///< met so far
};

struct SplitLimits {
    int depth = 8;  ///< at most 200
    double cut_weight = 1e-3;
    /// Asked now and then with the number of beams so far; false stops it.
    std::function<bool(long long)> goes_on = {};
};

class SplitBeams {
public:
    using Sink =
        std::function<void(const LeavingBeam&, const ScreenPoint* corners, std::size_t count)>;

    /// `response`: of the eye (stokes.h).
    SplitBeams(const FacetNet& net, const Band& band, const SplitLimits& limits,
               const Stokes& response);

    /// Calls `sink` for each beam that leaves the stone, within a region of a front facet's
    /// outline.
    void grow(const ScreenView& view, int facet, const ScreenPoint* region, std::size_t count,
              const Sink& sink);

    long long beams() const { return beams_; }
    double remainder() const { return remainder_; }  ///< weight x square pixels, mean over nodes
    double absorbed() const { return absorbed_; }
    void forget_sums() { beams_ = 0, remainder_ = absorbed_ = 0; }

private:
    struct Ray {
        Vec3 point{0};
        CrystalMode mode;
        double weight = 0;
        NodeWeights transmitted;
    };
    using Rays = std::array<Ray, 3>;

    void absorb(Ray& ray, double way) const;
    void follow(const Rays& rays, int facet, const FacetRegion& part, int event);
    void leave(const std::array<CrystalHit, 3>& hits, const Rays& at, const FacetRegion& part,
               int event);
    InsideView view_of(const Rays& rays, double length) const;
    double mean_transmitted(const Ray& ray) const;

    const FacetNet& net_;
    const Band& band_;
    SplitLimits limits_;
    Stokes response_;
    RegionSplitter splitter_;
    std::vector<ScreenPoint> pool_;
    ScreenPoint reference_;
    const Sink* sink_ = nullptr;
    long long beams_ = 0;
    bool stopped_ = false;
    double remainder_ = 0, absorbed_ = 0;
};

}  // namespace culet
