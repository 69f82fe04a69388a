#pragma once
// The corpus of fits that every change of the fit is tested on: known stones, noisy readings of
// them, and distorted start meshes. Everything comes from seeds.

#include <functional>
#include <string>
#include <vector>

#include "tests/fit/fit_trials.h"

namespace culet::bench {

struct CorpusFit {
    std::string group;  ///< fits that one figure counts together
    std::string name;   ///< unique in the corpus
    std::function<Trial()> fit;
    /// Starts from the stone's own corners; `succeeds` compares with it. Computed once for all fits
    /// of a stone.
    std::function<const Trial&()> reference;
    Stone declared;
};

/// 840 fits: round and step cut with and without symmetry, pear and trillion without. Each has
/// `seeds` stones, with corners off by 1, 5, 10, 20 and 40 % of the diameter, and drawn wrong by 10
/// and 20 %. Then four stones of about 291 facets with corners off by 0.3 %.
std::vector<CorpusFit> synthetic_corpus(unsigned seeds);

/// Fits of a scanned stone: a text file of vertices and facets as the scanner writes them (`nv nf
/// ne`, `i x y z`, `i n a b c d` and the facet's vertices). The readings are inclination and
/// azimuth of every facet to 0.1 degrees, twelve widths, the depth and all edges to 0.01. There are
/// `draws` sets of readings, each fitted from the stone's own corners and from corners off by 0.3
/// %. Throws InputError for other files.
std::vector<CorpusFit> scanned_corpus(const std::string& file, unsigned draws);

}  // namespace culet::bench
