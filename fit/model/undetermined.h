#pragma once
// A number of the stone that no reading determines.

#include <string>

namespace culet {

struct Undetermined {
    std::string facet;
    std::string freedom;  ///< `inclination`, `azimuth` or `offset`
};

}  // namespace culet
