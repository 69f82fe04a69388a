#pragma once
// The form of readings as it is printed for the bench: what to read, what is expected, and drawings
// that tell which facet is meant.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct PrintedForm {
    struct Row {
        std::string kind, of, note;
    };
    std::string name, version;
    Solid solid;  ///< table up (+z), facets named as the rows name them
    std::vector<Row> rows;
    std::string readings;  ///< the file that the values are typed into
};

/// A whole page in itself, two sides of A4.
std::string form_page(const PrintedForm& form);

}  // namespace culet
