#pragma once
// Front door of the room: stones to look at in, one page out.

#include <string>

#include "viewer/engine/viewer_document.h"

namespace culet {

/// A page in itself: loads nothing from anywhere, opens by a double click. The first item's picture
/// stands in it at once; with the engine (viewer/engine_file.h) the stone turns. Without it the
/// page says how to get the engine.
std::string viewer_page(const ViewDocument& document);

}  // namespace culet
