#pragma once
// How a stone lies on a photograph, as the page has it, and the part of the photograph around it.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/pose/wireframe.h"

namespace culet {

nlohmann::ordered_json json_of(const StoneView& view);
/// Throws InputError.
StoneView view_of(const std::string& json, const WireSolid& wire);
/// Corners from the stone's middle, and each facet's.
nlohmann::ordered_json json_of(const WireSolid& wire);

/// A rectangle of a photograph; each pixel is the mean of `factor` x `factor`.
struct PhotoPart {
    int x = 0, y = 0, width = 0, height = 0, factor = 1;
};
PhotoPart whole_of(const Photo& photo, int largest);
/// The stone with a margin. Empty if it lies outside.
PhotoPart part_around(const Photo& photo, const WireSolid& wire, const StoneView& view,
                      int largest);
Photo cut_out(const Photo& photo, const PhotoPart& part);

StoneView in_part(StoneView view, const PhotoPart& part);
StoneView in_whole(StoneView view, const PhotoPart& part);

/// 1 within the outline of the stone, else 0, for each pixel of `photo`.
std::vector<float> mask_of(const Photo& photo, const WireSolid& wire, const StoneView& view);

}  // namespace culet
