#pragma once
// Writes cutting sheets to files: a page or text.

#include <filesystem>
#include <string>

#include "app/describe/describe.h"

namespace culet {

struct SheetOptions {
    std::filesystem::path out;     ///< .html: a page; .txt: text; -: text on stdout
    std::filesystem::path report;  ///< of the stone's fit, for the angles' sigmas; empty: none
};

/// Takes a mesh or cut design; gear and width are those of `describe`. Throws InputError.
void write_cutting_sheet(const SheetOptions& options, const DescribeOptions& describe);

}  // namespace culet
