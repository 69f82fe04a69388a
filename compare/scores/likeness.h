#pragma once
// Scores of a photograph and a render in one frame.

#include <cstdint>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/scores/score.h"

namespace culet {

/// Correlation of light seen through a blur of 2 % and of 4 % of the stone.
struct Likeness {
    Score zncc, coarse;
};

/// `stone`: by pixel, 255 where both pictures show nothing but the stone. Light of 1 is white. The
/// null: the render turned and mirrored in the picture's plane (rotation_null.h).
Likeness likeness(const Photo& photo, const Photo& render, const std::vector<std::uint8_t>& stone,
                  int draws, std::uint64_t seed);

/// The mean of scores of one kind whose draws are independent: its null's k-th draw is the mean of
/// theirs.
Score mean_score(const std::vector<Score>& scores);

}  // namespace culet
