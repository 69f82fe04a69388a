#pragma once
// The report of `culet spin`.

#include <filesystem>
#include <vector>

#include "refine/spin/series_light.h"

namespace culet {

/// Writes report.html into the folder, which is made if it is not there. `width_mm`: 0: lengths are
/// in pixels.
void write_spin_report(const std::filesystem::path& folder, const std::vector<SpinFrame>& frames,
                       const SpinResult& found, const SeriesLight& light, double width_mm);

}  // namespace culet
