#pragma once
// From the photographs named on a command line to the views of a ball: which shots belong together,
// and what their exposures are.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/light_probe.h"
#include "compare/photo/bracket.h"
#include "compare/photo/lens.h"

namespace culet {

struct BallSeries {
    std::vector<std::filesystem::path> files;
    /// Files of each view in order, when the user said so; else found.
    std::vector<std::vector<std::filesystem::path>> views;
    std::vector<double> exposures;  ///< of the files in the order named; empty: from EXIF
    /// Taken out of the pictures; its focal length and middle stand in for those of EXIF.
    std::optional<Lens> lens;
};

struct SortedShot {
    std::filesystem::path file;
    std::optional<double> exposure;
};

/// Which shots make up one view. In the order given: shots of rising or falling exposure belong
/// together; a new view starts where an exposure comes again. Files without a known exposure (HDR
/// pictures, or one shot a view) are views of their own. Throws InputError when neither can be: the
/// line says how to name the views.
std::vector<std::vector<std::size_t>> views_of(const std::vector<SortedShot>& shots);

struct ReadSeries {
    std::vector<ProbeView> views;
    std::vector<std::string> notes;
};

/// Reads, groups and merges. Throws InputError: unreadable, exposures missing or of the wrong
/// number, the same exposure twice in a view, NaN, pictures of another shape than the lens's.
ReadSeries read_ball_series(const BallSeries& series, const Progress& progress = {});

}  // namespace culet
