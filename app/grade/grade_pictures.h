#pragma once
// Pictures of a stone in the trade's scopes.

#include <filesystem>
#include <string>
#include <vector>

#include "page/grade_page.h"
#include "stone/stone.h"

namespace culet {

struct GradePictureOptions {
    int size = 320;  ///< pixels along a side
    int threads = 0;
};

/// Draws with the engine beams and writes PREFIX-aset.png, ... to `folder`. The stone is clear and
/// without double refraction, as for the grade's figures.
std::vector<GradePicture> draw_scopes(const Stone& stone, const std::filesystem::path& folder,
                                      const std::string& prefix,
                                      const GradePictureOptions& options);

}  // namespace culet
