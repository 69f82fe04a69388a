#pragma once
// The catalogue of materials on paper: the JSON of `culet info --materials` as a page.

#include <string>

namespace culet {

/// One self-contained page with a colour field, indices, birefringence, density and sources of
/// every material. Throws InputError when `json` is no object.
std::string material_page(const std::string& json, const std::string& version);

}  // namespace culet
