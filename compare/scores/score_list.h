#pragma once
// All scores of two pictures that lie on one another, in the order in which they are reported.

#include <optional>
#include <vector>

#include "compare/scores/compare.h"
#include "compare/scores/metrics.h"
#include "compare/scores/reflexes.h"
#include "compare/scores/wavelet_similarity.h"

namespace culet {

struct ScoreKind {
    const char* key;
    bool higher_is_better;
    bool
        geometry;  ///< a tone curve, even one that differs from place to place, does it little harm
};
/// All there are, in order.
const std::vector<ScoreKind>& score_kinds();

struct Measured {
    std::vector<Score> scores;  ///< without their nulls
    std::optional<ReflexMatch> reflexes;
    cv::Mat ssim_map, colour_map, flip_map;
};

/// Takes away the scores that need light to be light, where the photograph cannot serve for
/// photometry; `why` says why it cannot.
void keep_geometry_only(std::vector<Score>& scores, const std::string& why);

/// `wavelets` must have been made for pictures of this size.
Measured measure(const MatchedPictures& pictures, const WaveletBank& wavelets);

/// Mean, spread, z and p of a score from the values of its null. z of a correlation is taken of
/// atanh (Fisher 1915): its spread does not depend on its value, so that a perfect match is not
/// held back by the end of the scale.
void fill_null(Score& score);

}  // namespace culet
