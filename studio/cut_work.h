#pragma once
// Other angles for a stone, its meets kept: what the cut screen tries.

#include <memory>
#include <string>

#include "stone/progress/progress.h"
#include "studio/export_work.h"

namespace culet {

/// A cut that was tried.
struct TriedCut {
    std::string solid;           ///< OBJ with its design, mm, the table up
    std::string done = {};       ///< what made it of the one before: "C1 at 34.20 degrees"
    std::string optimized = {};  ///< JSON of `culet optimize`; empty: made by hand
    /// JSON: `tiers` (what can be moved: name, part, unit, facets, value; tiers that keep one angle
    /// together are one, and so are all of crown or pavilion), `figures` (name, words, value; per
    /// cent), `volume`, `drawings`, `note`.
    std::string shown = {};
};

std::string text_of(const TriedCut& cut);
TriedCut tried_cut_in(const std::string& text);

/// The stone that the cuts are tried on, as it is shown.
struct CutGround {
    std::shared_ptr<const LoadedStone> loaded;
    FittedStone fitted;
};

/// What an optimisation is asked for.
struct CutWishes {
    std::string objective = "brilliance";  ///< weights as of `merit_weights`
    bool recut = false;                    ///< the cut must lie inside the stone
    double most_loss = 0.1;                ///< of a recut, part of the stone's weight
};

/// The stone as it is. This and the next two throw InputError, for stones that are not convex too.
TriedCut first_cut(const CutGround& ground);

/// Entry `which` of the shown `tiers` at another value, or as near to it as the meets can be kept.
/// Throws InputError where they allow no change at all.
TriedCut changed_cut(const CutGround& ground, const std::string& solid, std::size_t which,
                     double value);

TriedCut optimised_cut(const CutGround& ground, const std::string& solid, const CutWishes& wishes,
                       const Progress& progress);

/// The page of `culet grade`: the stone as it is, beside `cut` where that is another.
std::string grade_of_cut(const CutGround& ground, const TriedCut& first, const TriedCut& cut,
                         const std::string& version, const Progress& progress);

}  // namespace culet
