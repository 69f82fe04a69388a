#pragma once
// Vectorised operations on runs of pixels.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace culet {

/// Adjacent pixels of one row.
struct PixelRun {
    int pixel = 0;  ///< index of the first: y * width + x
    int first = 0;  ///< index of its first value, in arrays for all runs
    int count = 0;
};
using PixelRuns = std::vector<PixelRun>;

/// A plane of pixels, or some of its rows.
struct PixelRows {
    float* values = nullptr;
    int first_pixel = 0;
};

/// Adds factor * values * shares to the pixels of the runs; `values` null: 1.
void add_to_runs(const PixelRuns& runs, const float* values, const float* shares, float factor,
                 const PixelRows& to);
/// Sets the share of pixels already taken to 0, and marks the others as taken.
void claim_runs(const PixelRuns& runs, const PixelRows& taken, float* shares);
/// Sum of values * shares; `values` null: of the shares.
float sum_of_shared(const float* values, const float* shares, int count);
/// True if a whole pixel (share 1) has mark 0.
bool any_unmarked_whole(const float* marks, const float* shares, int count);
/// Appends pixels of value 0 that have a nonzero neighbour within these rows.
void find_gaps(const PixelRows& rows, int width, int count, std::vector<int>& pixels);
/// Adds factor * min(value, 1).
void add_up_to_one(const float* values, int count, float factor, float* to);
/// Writes each value three times.
void spread_to_rgb(const float* values, std::size_t count, float* rgb);

}  // namespace culet
