#pragma once
// The table of readings as the page draws it.

#include <string>

#include "studio/project.h"

namespace culet {

/// What is said beside the table.
struct TableNews {
    int opened = 0;        ///< counts the projects of this run
    bool outside = false;  ///< another program changed the readings
    std::string trouble;   ///< in the stone file, since it was opened; empty: none
};

/// Rows with their cells, facets and flags (what is wrong, and the value that a slip suggests).
std::string table_json(const Project& project, const TableNews& news);

}  // namespace culet
