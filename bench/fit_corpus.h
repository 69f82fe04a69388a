#pragma once
// The corpus of fits that every change of the fit is held against: stones that are known, their
// readings with noise, and meshes as bad hands would make them. All from seeds.

#include <functional>
#include <string>
#include <vector>

#include "tests/fit/fit_trials.h"

namespace culet::bench {

/// One fit of the corpus.
struct CorpusFit {
    std::string group;  ///< those that one figure counts together
    std::string name;   ///< unique in the corpus
    std::function<Trial()> fit;
    /// From the stone's own corners: what `succeeds` holds the fit against. Shared by all fits of
    /// one stone, and made once.
    std::function<const Trial&()> reference;
    Stone declared;
};

/// 840 fits: round and step cut with and without symmetry, pear and trillion without; `seeds`
/// stones each; corners off by 1, 5, 10, 20 and 40 % of the diameter, drawn wrong by 10 and 20 %.
/// Then four stones of 291 facets or so, corners off by 0.3 %.
std::vector<CorpusFit> synthetic_corpus(unsigned seeds);

/// Fits of a scanned stone: a text file of vertices and facets as the scanner writes them
/// (`nv nf ne`, `i x y z`, `i n a b c d` and the facet's vertices). Inclination and azimuth of
/// every facet to 0.1 degrees, twelve widths, the depth and all edges to 0.01, `draws` sets of such
/// readings, each from the stone's own corners and from corners off by 0.3 %.
/// Throws InputError when it is no such file.
std::vector<CorpusFit> scanned_corpus(const std::string& file, unsigned draws);

}  // namespace culet::bench
