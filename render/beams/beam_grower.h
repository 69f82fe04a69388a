#pragma once
// The beams below one front facet: each is split by the facets that its rays meet next.

#include <atomic>
#include <functional>
#include <vector>

#include "render/beams/beam_tree.h"
#include "render/beams/region_splitter.h"

namespace culet {

/// A beam that is to be split: what its rays have in common.
struct BeamTrunk {
    FacetRegion part;   ///< the facet met last
    double weight = 1;  ///< of what goes on behind the facet before that
    bool sure = true;   ///< no border is off by more than 1/4 pixel
};

/// Grows the beams below one beam, and keeps the room for it.
class BeamGrower {
public:
    void prepare(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 double front_area, std::atomic<long long>& grown,
                 const std::function<bool(long long)>& goes_on);

    /// Beams behind the front facet's, with the corners of their regions in `corners()`. None when
    /// the front beam is not to be split.
    const std::vector<BeamTrunk>& split_front(int facet, const std::vector<ScreenPoint>& outline);
    const std::vector<ScreenPoint>& corners() const { return pool_; }

    /// A beam that nothing is split from: the front facet's.
    void keep_front(int facet, const std::vector<ScreenPoint>& outline, BeamBranch& out);

    /// All beams below one that `split_front` found; `middle`: of the front facet's outline.
    void grow_branch(int front, const ScreenPoint& middle, const BeamTrunk& child,
                     const ScreenPoint* region, BeamBranch& out);

private:
    static constexpr int k_most_halvings = 12;

    void leaf(const BeamTrunk& trunk);
    void grow(const BeamTrunk& trunk, const Folding& folding);
    void go_on(const BeamTrunk& trunk, const Folding& before);
    bool too_many();
    void follow_alone(const BeamTrunk& trunk, Vec3 d, const Vec3& point);
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
    long long counted_ = 0;  // of this branch, in that
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
