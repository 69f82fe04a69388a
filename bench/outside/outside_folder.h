#pragma once
// Files by others that the repository does not hold; the folder is the bench's argument.

#include <filesystem>

namespace culet::outside {

/// Contains designs/ (with metrics.json), meshes/, scans/.
const std::filesystem::path& folder();

}  // namespace culet::outside
