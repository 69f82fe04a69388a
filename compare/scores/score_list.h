#pragma once
// All scores of two registered pictures: one table with a row for each score.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/scores/colour_distribution.h"
#include "compare/scores/metrics.h"
#include "compare/scores/reflexes.h"
#include "compare/scores/score.h"
#include "compare/scores/wavelet_similarity.h"

namespace culet {

/// The pictures, and what several scores share or the report draws.
struct Measures {
    MatchedPictures pictures;
    ShownPictures shown;
    const WaveletBank* wavelets = nullptr;    ///< for pictures of this size; not owned
    std::vector<std::optional<double>> zncc;  ///< blurred by 2, 1 and 4 % of the diameter
    std::optional<ReflexMatch> reflexes;
    ScoreMap structure, visible;  ///< SSIM, FLIP
    ColourScore colour;
    ColourDistributions colours;
    /// From the facets' tilts (calibration/facet_tilts.h); nothing: unknown.
    std::optional<double> facet_error_deg;
    bool calibrating = false;  ///< also compute scores that need a model of the stone
};
Measures measures_of(const MatchedPictures& pictures, const WaveletBank& wavelets);

/// The range of a score: which way is better, and which variance-stabilising transform makes it
/// nearly linear in the logarithm of the facet error.
enum class ScoreScale {
    correlation,  ///< up to 1; z is computed from atanh (Fisher 1915)
    up_to_one,    ///< 1 is perfect
    down_to_zero,
    down_to_one,  ///< 1 is chance
    decibel
};

/// Whether a score needs linear light, or only shapes and places, which tone curves hardly harm.
enum class Needs { photometry, geometry };

/// Whether the equivalent facet error uses a score: never, for photometric photographs only, when
/// just geometry is used, or always. Colour scores see no geometry, and counts of reflexes are
/// coarser than areas.
enum class InCalibration { no, photometric, geometry_only, always };

struct ScoreKind {
    const char* key;           ///< in the JSON
    const char *name, *about;  ///< for people
    int decimals;
    ScoreScale scale;
    Needs needs;
    InCalibration in_calibration;
    std::optional<double> (*read)(const Measures& measures);
    const char* why_none = "";     ///< why it can be undefined
    bool calibrated_only = false;  ///< needs a model of the stone

    bool higher_is_better() const { return scale != ScoreScale::down_to_zero; }
};
/// Score of calibrated comparisons only (calibration/facet_tilts.h).
inline constexpr const char* k_facet_tilts = "facet_tilts_deg";

/// In the order in which they are reported.
std::span<const ScoreKind> score_kinds();
/// Null for a key that is not in the table.
const ScoreKind* score_kind(const std::string& key);

/// The scores without their nulls.
std::vector<Score> scores_of(const Measures& measures);

/// Removes the scores that need linear light; `why` says why the photograph has none.
void keep_geometry_only(std::vector<Score>& scores, const std::string& why);

/// Nearly linear in the logarithm of the facet error.
double stabilised(double score, ScoreScale scale);

/// Sets mean, spread, z and p from the null's values. A correlation's z uses atanh (Fisher 1915),
/// whose spread is constant, so that the end of the scale does not limit a perfect match.
void fill_null(Score& score);

}  // namespace culet
