#pragma once
// One reader and one writer per format; all read from memory. `file` is for messages only.

#include <filesystem>
#include <string>
#include <string_view>

#include "stone/mesh/face_soup.h"
#include "stone/solid/solid.h"

namespace culet {

FaceSoup parse_obj(std::string_view bytes, const std::filesystem::path& file);
FaceSoup parse_off(std::string_view bytes, const std::filesystem::path& file);
FaceSoup parse_ply(std::string_view bytes, const std::filesystem::path& file);
FaceSoup parse_stl(std::string_view bytes, const std::filesystem::path& file);
/// .step, .stp: in mm, with the names of the faces. Throws InputError for curved faces, and where
/// culet is built without Open CASCADE.
bool is_step(const std::filesystem::path& file);
FaceSoup read_step(const std::filesystem::path& file);
FaceSoup soup_of(std::string_view bytes, MeshFormat format, const std::filesystem::path& file);

/// `with_planes`: write the facets' planes in comments.
std::string obj_text(const Solid& solid, bool with_planes = true);
std::string off_text(const Solid& solid, bool with_planes = true);
std::string ply_text(const Solid& solid, bool with_planes = true);
std::string stl_text(const Solid& solid);

}  // namespace culet
