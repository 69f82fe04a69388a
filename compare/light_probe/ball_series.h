#pragma once
// Groups a command line's photographs into views of a ball, with their exposures.

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
    /// Each view's files in order, if given; otherwise found.
    std::vector<std::vector<std::filesystem::path>> views;
    std::vector<double> exposures;  ///< of the files in the order given; empty: from EXIF
    /// Corrects distortion; its focal length and principal point replace those of EXIF.
    std::optional<Lens> lens;
};

struct SortedShot {
    std::filesystem::path file;
    std::optional<double> exposure;
};

/// Groups shots into views, in the order given: shots of rising or falling exposure belong
/// together, and a repeated exposure starts a new view. Files without a known exposure (HDR
/// pictures, or one shot a view) are views of their own. Otherwise throws InputError, which says
/// how to name the views.
std::vector<std::vector<std::size_t>> views_of(const std::vector<SortedShot>& shots);

struct ReadSeries {
    std::vector<ProbeView> views;
    std::vector<std::string> notes;
};

/// Reads, groups and merges the shots. Throws InputError for unreadable files, missing or too few
/// exposures, equal exposures in a view, NaN, or pictures of another shape than the lens's.
ReadSeries read_ball_series(const BallSeries& series, const Progress& progress = {});

}  // namespace culet
