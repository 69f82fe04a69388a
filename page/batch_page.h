#pragma once
// The page of `culet batch`. Stones that need a look come first.

#include <cstddef>
#include <string>
#include <vector>

namespace culet {

/// One row; NaN: unknown.
struct BatchPageJob {
    std::string name;     ///< also of its folder in `jobs`
    std::string status;   ///< as in the table
    std::string message;  ///< why
    bool good = false;
    double outlier = 0;  ///< how unusual it is: a multiple of the usual deviation
    double worst_reading = 0, chi2 = 0, dof = 0;  ///< of its fit; worst_reading is |normalized|
    double light_return = 0, fire = 0, leak = 0;  ///< of its grade: per cent, fraction, fraction
    std::vector<std::string> files;               ///< in its folder, to open
    std::string png;                              ///< bytes of a small picture; empty: none
};

struct BatchPage {
    std::string version;
    std::size_t good = 0, untrusted = 0, failed = 0, missing = 0;
    std::vector<BatchPageJob> jobs;  ///< in display order
};

/// The page links to the folder `jobs` beside it.
std::string batch_page(const BatchPage& page);

}  // namespace culet
