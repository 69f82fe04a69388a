#pragma once
// The catalogue of materials as a page, from the JSON of `culet info --materials`.

#include <string>

namespace culet {

/// Shows colour field, indices, birefringence, density and sources of every material. Throws
/// InputError when `json` is not an object.
std::string material_page(const std::string& json, const std::string& version);

}  // namespace culet
