#include "fit/find_symmetry.h"

#include "fit/findings/symmetry_tests.h"

namespace culet {

SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options, const Progress& progress) {
    std::vector<Reading> free;
    for (const Reading& r : readings) {
        if (!declares_whole_symmetry(r)) free.push_back(r);
    }
    FitOptions asking = options;
    asking.find_symmetry = true;
    asking.findings = true;
    return fit_stone(stone, free, asking, progress).findings.symmetry.value_or(SymmetryReport());
}

}  // namespace culet
