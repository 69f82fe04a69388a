#pragma once
// What the begin screen offers.

#include <filesystem>
#include <string>

namespace culet {

/// The standard cuts with their parameters, materials, stones in `folder` and the recent ones.
std::string begin_json(const std::filesystem::path& folder);

}  // namespace culet
