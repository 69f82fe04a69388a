#pragma once
// All scores of two pictures that lie on one another: one table, a row a score.

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

/// What scores are read from: the pictures, and what several scores share or the report draws.
struct Measures {
    MatchedPictures pictures;
    ShownPictures shown;
    const WaveletBank* wavelets = nullptr;    ///< for pictures of this size; not owned
    std::vector<std::optional<double>> zncc;  ///< blurred by 2, 1 and 4 % of the diameter
    std::optional<ReflexMatch> reflexes;
    ScoreMap structure, visible;  ///< SSIM, FLIP
    ColourScore colour;
    ColourDistributions colours;
    /// Read from the facets' tilts (calibration/facet_tilts.h); nothing: not known.
    std::optional<double> facet_error_deg;
    bool calibrating = false;  ///< scores that need a model of the stone are asked for, too
};
Measures measures_of(const MatchedPictures& pictures, const WaveletBank& wavelets);

/// What a score runs against, which says which way is better and how it is stretched so that it
/// falls about straight with the logarithm of the facet error.
enum class ScoreScale {
    correlation,  ///< up to 1; z is taken of atanh (Fisher 1915)
    up_to_one,    ///< 1 is perfect
    down_to_zero,
    down_to_one,  ///< 1 is chance
    decibel
};

/// Light that is light, or shapes and places: a tone curve, even one that differs from place to
/// place, does these little harm.
enum class Needs { photometry, geometry };

/// Whether the equivalent facet error is read from it, for a photograph whose brightness is light
/// or of which only geometry is used. Colours alone see no geometry; counts of reflexes are coarse
/// beside their areas.
enum class InCalibration { no, photometric, geometry_only, always };

struct ScoreKind {
    const char* key;           ///< in the JSON
    const char *name, *about;  ///< for people
    int decimals;
    ScoreScale scale;
    Needs needs;
    InCalibration in_calibration;
    std::optional<double> (*read)(const Measures& measures);
    const char* why_none = "";     ///< where it is not defined
    bool calibrated_only = false;  ///< it needs a model of the stone

    bool higher_is_better() const { return scale != ScoreScale::down_to_zero; }
};
/// Read from the picture by a calibrated comparison alone (calibration/facet_tilts.h).
inline constexpr const char* k_facet_tilts = "facet_tilts_deg";

/// All there are, in the order in which they are reported.
std::span<const ScoreKind> score_kinds();
/// Null for a key that is not in the table.
const ScoreKind* score_kind(const std::string& key);

/// The scores without their nulls.
std::vector<Score> scores_of(const Measures& measures);

/// Takes away the scores that need light to be light, where the photograph cannot serve for
/// photometry; `why` says why it cannot.
void keep_geometry_only(std::vector<Score>& scores, const std::string& why);

/// Falls about straight with the logarithm of the facet error.
double stabilised(double score, ScoreScale scale);

/// Mean, spread, z and p of a score from the values of its null. z of a correlation is taken of
/// atanh (Fisher 1915): its spread does not depend on its value, so that a perfect match is not
/// held back by the end of the scale.
void fill_null(Score& score);

}  // namespace culet
