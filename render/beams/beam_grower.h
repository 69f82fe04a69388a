#pragma once
// Grows the beams below one front facet: splits each by the facets that its rays meet next.

#include <atomic>
#include <functional>
#include <vector>

#include "render/beams/beam_tree.h"
#include "render/beams/region_splitter.h"

namespace culet {

struct BeamTrunk {
    FacetRegion part;   ///< region on the facet met last
    double weight = 1;  ///< of the light that goes on behind the facet before
    bool sure = true;   ///< no border is off by more than 1/4 pixel
};

/// Grows the beams below one beam; reuses its memory.
class BeamGrower {
public:
    void prepare(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 double front_area, std::atomic<long long>& grown,
                 const std::function<bool(long long)>& goes_on);

    /// Beams behind the front facet, with the corners of their regions in `corners()`. Empty if the
    /// front beam need not be split.
    const std::vector<BeamTrunk>& split_front(int facet, const std::vector<ScreenPoint>& outline);
    const std::vector<ScreenPoint>& corners() const { return pool_; }

    /// Adds the front facet's own beam, unsplit.
    void keep_front(int facet, const std::vector<ScreenPoint>& outline, BeamBranch& out);

    /// Grows all beams below one from `split_front`. `middle`: of the front facet's outline.
    void grow_branch(int front, const ScreenPoint& middle, const BeamTrunk& child,
                     const ScreenPoint* region, BeamBranch& out);

private:
    static constexpr int k_most_halvings = 12;

    void add_beam(const BeamTrunk& trunk);
    void grow(const BeamTrunk& trunk, const Folding& folding);
    void go_on(const BeamTrunk& trunk, const Folding& before);
    bool too_many();
    void follow_middle_ray(const BeamTrunk& trunk, Vec3 d, const Vec3& point);
    bool worth_splitting(const BeamTrunk& trunk) const;
    void split(const BeamTrunk& trunk, const Pencil& pencil, const Folding& folding,
               const ScreenPoint& middle, int halvings = k_most_halvings);
    double map_error(const PencilMap& map, const Region& region, const Folding& folding,
                     int exit) const;
    void halve(const BeamTrunk& trunk, const Folding& folding, int halvings);

    const FacetNet* net_ = nullptr;
    const ScreenView* view_ = nullptr;
    const BeamLimits* limits_ = nullptr;
    double n_ = 1, least_ = 0, small_ = 0;
    std::atomic<long long>* grown_ = nullptr;  // in all branches
    const std::function<bool(long long)>* goes_on_ = nullptr;
    bool stopped_ = false;
    long long counted_ = 0;  // this branch's share of that
    BeamBranch* out_ = nullptr;
    Pencil front_;
    std::vector<std::uint16_t> path_;
    std::vector<ScreenPoint> pool_;
    std::vector<FacetRegion> parts_;
    std::vector<BeamTrunk> children_;
    RegionSplitter splitter_;
    RegionCutter cutter_;
};

}  // namespace culet
