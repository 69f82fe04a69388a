#pragma once
// The viewer inside the pages of reports.

#include <string>

#include "viewer/view_item.h"

namespace culet {

/// Returns an empty page if the stone could not be turned: no viewer's engine was built, the engine
/// beams refuses the scene, or the stone has no material.
std::string viewer_for_report(const ViewSource& source, const std::string& title);

}  // namespace culet
