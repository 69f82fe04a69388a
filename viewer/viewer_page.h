#pragma once
// Makes one page to look at stones.

#include <string>

#include "viewer/engine/viewer_document.h"

namespace culet {

/// The page is self-contained and opens with a double click. It shows the first item's picture at
/// once; with the engine (viewer/engine_file.h) the stone turns. Without it the page says how to
/// get the engine.
std::string viewer_page(ViewDocument document);

}  // namespace culet
