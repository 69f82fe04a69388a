#pragma once
// Pixels side by side, many at once.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace culet {

/// Some pixels of one row.
struct PixelRun {
    int pixel = 0;  ///< the first's, y * width + x
    int first = 0;  ///< the first's values, in arrays that hold those of all runs
    int count = 0;
};
using PixelRuns = std::vector<PixelRun>;

/// A plane of pixels, or some rows of it.
struct PixelRows {
    float* values = nullptr;
    int first_pixel = 0;
};

/// Adds factor * values * shares to each pixel of the runs; `values` null: 1.
void add_to_runs(const PixelRuns& runs, const float* values, const float* shares, float factor,
                 const PixelRows& to);
/// Takes the share of pixels that are taken, and marks the others.
void claim_runs(const PixelRuns& runs, const PixelRows& taken, float* shares);
/// Sum of the products; `values` null: of the shares.
float sum_of_shared(const float* values, const float* shares, int count);
/// True where a whole pixel (share 1) has a mark of 0.
bool any_unmarked_whole(const float* marks, const float* shares, int count);
/// Appends the pixels of value 0, of some rows, next to others in the same rows.
void find_gaps(const PixelRows& rows, int width, int count, std::vector<int>& pixels);
/// Adds factor * values, values above 1 counting as 1.
void add_up_to_one(const float* values, int count, float factor, float* to);
/// Each value three times.
void spread_to_rgb(const float* values, std::size_t count, float* rgb);

}  // namespace culet
