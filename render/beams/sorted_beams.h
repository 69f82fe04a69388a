#pragma once
// The beams of one view, sorted into strips of rows.

#include <algorithm>
#include <vector>

#include "render/beams/beam_tree.h"

namespace culet {

/// Rows of pixels per task. Fixed, so that sums do not depend on the number of threads.
constexpr int k_strip = 48;

struct BeamNumber {
    std::uint32_t branch = 0, beam = 0;
};

struct SortedBeams {
    ScreenView view;
    double n = 0;
    BeamLimits limits;
    bool grown = false;
    BeamTree tree;
    std::vector<std::vector<BeamNumber>> strips;

    /// Grows the beams unless they are up to date or `goes_on` says no (beam_tree.h).
    void grow(const FacetNet& net, const ScreenView& wanted_view, double wanted_n,
              const BeamLimits& wanted_limits, const std::function<bool(long long)>& goes_on) {
        if (grown && view == wanted_view && n == wanted_n && limits == wanted_limits) return;
        grown = false;
        view = wanted_view;
        n = wanted_n;
        limits = wanted_limits;
        if (!build_beams(net, view, n, limits, tree, goes_on)) return;
        sort((view.height + k_strip - 1) / k_strip);
        grown = true;
    }

private:
    void sort(int strip_count) {
        strips.resize(static_cast<std::size_t>(strip_count));
        for (auto& strip : strips) strip.clear();
        for (std::size_t b = 0; b < tree.branch_count; ++b) {
            const std::vector<Beam>& beams = tree.branches[b].beams;
            for (std::size_t l = 0; l < beams.size(); ++l) {
                const int first = std::max(beams[l].first_row / k_strip, 0),
                          last = std::min((beams[l].end_row - 1) / k_strip, strip_count - 1);
                for (int strip = first; strip <= last; ++strip)
                    strips[static_cast<std::size_t>(strip)].push_back(
                        {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(l)});
            }
        }
    }
};

}  // namespace culet
