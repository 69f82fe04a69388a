#pragma once
// Cutting sheets as files: a page or text.

#include <filesystem>
#include <string>

#include "app/describe/describe.h"

namespace culet {

struct SheetOptions {
    std::filesystem::path out;     ///< .html: a page; .txt: text; -: text on stdout
    std::filesystem::path report;  ///< of the stone's fit: angles with sigmas; empty: none
};

/// Of a mesh or cut design as `describe` has it (gear, width). Throws InputError.
void write_cutting_sheet(const SheetOptions& options, const DescribeOptions& describe);

}  // namespace culet
