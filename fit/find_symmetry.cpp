#include "fit/find_symmetry.h"

namespace culet {

bool declares_whole_symmetry(const Reading& reading) {
    if (reading.kind != ReadingKind::rotation && reading.kind != ReadingKind::mirror) return false;
    return reading.exact || reading.facets.empty();
}

SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options, const Progress& progress) {
    std::vector<Reading> free;
    for (const Reading& r : readings) {
        if (!declares_whole_symmetry(r)) free.push_back(r);
    }
    FitOptions asking = options;
    asking.find_symmetry = true;
    asking.findings = true;
    return fit_stone(stone, free, asking, progress).symmetry.value_or(SymmetryReport());
}

}  // namespace culet
