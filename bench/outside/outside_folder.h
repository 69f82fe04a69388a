#pragma once
// Files of other hands that the repository does not hold; the folder is the bench's argument.

#include <filesystem>

namespace culet::outside {

/// With designs/ (and metrics.json), meshes/, scans/.
const std::filesystem::path& folder();

}  // namespace culet::outside
