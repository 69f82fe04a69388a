#pragma once
// Writing slips of a simulated cutter.

#include <random>
#include <string>
#include <vector>

#include "tests/fit/cutters.h"

namespace culet::bench {

using Random = std::mt19937_64;
std::size_t one_of(Random& random, std::size_t count);

struct CutterRow {
    std::string kind;
    std::vector<std::string> of;
    std::string value;
    double sigma = 0;
};

/// Makes one slip of at least two degrees or a tenth. Returns the rows that it affects.
std::vector<std::size_t> make_slip(std::vector<CutterRow>& rows, Slipped slip, Random& random);

}  // namespace culet::bench
