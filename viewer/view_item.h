#pragma once
// Makes a page's items from stones and scenes in files.

#include "viewer/engine/view_source.h"

namespace culet {

/// Longer side of the small picture, pixels.
constexpr int k_still_size = 320;

/// `notes` receives the notes from reading. Throws InputError.
ViewItem view_item(const ViewSource& source, std::vector<std::string>& notes);

}  // namespace culet
