#pragma once
// Designs as the bytes of a file. The solid stands where the format wants it (cut_write.cpp).

#include <string>
#include <vector>

#include "stone/gemcad/cut_lines.h"

namespace culet {

std::string asc_text(const Design& design, const std::vector<CutLine>& lines);
std::string gem_bytes(const Solid& solid, const Design& design, const std::vector<CutLine>& lines);
std::string gcs_text(const Solid& solid, const Design& design, const std::vector<CutLine>& lines);

}  // namespace culet
