#pragma once
// Words about a photograph, for a page without options.

#include <string>

#include "compare/pose/find_pose.h"

namespace culet {

/// Where other commands name an option or a scene file, what the page has instead.
std::string reworded(std::string text);
/// The same, without clauses about other options; as sentences.
std::string sentences(const std::string& text);
/// A verdict on a pose, as HTML.
std::string pose_card(const FoundPose& pose);

}  // namespace culet
