#include "fit/hypotheses/unread_size.h"
#include "fit/hypotheses/constants.h"

#include <algorithm>

#include "stone/solid/checks.h"

namespace culet {

bool says_size(const std::vector<Reading>& readings) {
    return std::any_of(readings.begin(), readings.end(), [](const Reading& r) {
        return r.outline_observations || (!is_angle(r.kind) && !is_relation(r.kind));
    });
}

Reading size_of_mesh(const Stone& stone) {
    const int facet = find_facet(stone.solid, stone.up_facet);
    const Vec3 up = facet < 0 ? stone.up : stone.solid.facets[std::size_t(facet)].plane.normal;
    Reading size;
    size.id = "size of the mesh";
    size.kind = ReadingKind::depth;
    size.value = width_along(stone.solid, up);
    size.sigma = k_trials.as_good_as_exact * size.value;
    return size;
}

void take_back_size(const Reading& size, FitResult& result) {
    const auto is_size = [&](const std::string& id) { return id == size.id; };
    std::erase_if(result.readings, [&](const FittedReading& r) { return is_size(r.id); });
    std::erase_if(result.findings.disagreeing, is_size);
    ++result.statistics.rank_defect;
    result.findings.undetermined_words.insert(result.findings.undetermined_words.begin(),
                                              "nothing measured fixes the size of the stone");
    const std::string why =
        "no length was read, and the size of the stone is the mesh's; read a width or the depth";
    const bool was_good =
        result.status == FitStatus::converged || result.status == FitStatus::undetermined;
    result.message = result.status == FitStatus::converged ? why
                     : was_good                            ? why + "; " + result.message
                                                           : result.message + "; " + why;
    if (was_good) result.status = FitStatus::undetermined;
}

}  // namespace culet
