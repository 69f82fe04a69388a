#pragma once
// Front door of the room: stones to look at in, one page out.

#include <string>

#include "viewer/engine/viewer_document.h"

namespace culet {

/// A page in itself: loads nothing from anywhere, opens by a double click. The first item's picture
/// stands in it at once; with the engine the stone turns.
std::string viewer_page(const ViewDocument& document);

/// False: this program was built without Emscripten and without an engine of a release: pages show
/// their pictures and say so.
bool has_viewer_engine();

}  // namespace culet
