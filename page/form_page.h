#pragma once
// The form of readings for printing: what to read, what is expected, and drawings that show the
// facets.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct PrintedForm {
    struct Row {
        std::string kind, of, note;
    };
    std::string name, version;
    Solid solid;  ///< table up (+z); facets are named as in the rows
    std::vector<Row> rows;
    std::string readings;  ///< the file into which the values are typed
};

/// A page of two sides of A4.
std::string form_page(const PrintedForm& form);

}  // namespace culet
