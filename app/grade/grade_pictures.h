#pragma once
// What the trade's scopes show of a stone, as pictures.

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

/// Draws each scope's picture by beams, clear and without double refraction, as the figures have
/// the stone, and writes it to `folder` as PREFIX-aset.png, ...
std::vector<GradePicture> draw_scopes(const Stone& stone, const std::filesystem::path& folder,
                                      const std::string& prefix,
                                      const GradePictureOptions& options);

}  // namespace culet
