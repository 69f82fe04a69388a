#pragma once
// The viewer that reports open: a page inside theirs.

#include <string>

#include "viewer/view_item.h"

namespace culet {

/// A page of the viewer; empty where it would not turn: built without the viewer's engine, what
/// beams refuse, a stone without a material.
std::string viewer_for_report(const ViewSource& source, const std::string& title);

}  // namespace culet
