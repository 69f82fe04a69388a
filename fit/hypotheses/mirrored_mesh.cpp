#include "fit/hypotheses/mirrored_mesh.h"

#include "fit/hypotheses/constants.h"
#include "fit/mesh/repair.h"

namespace culet {

std::optional<Problem> mesh_mirrored(const Problem& given, const Attempt& first) {
    const FitStatus status = first.result.status;
    if (given.mirrored ||
        (status != FitStatus::contradictory && status != FitStatus::not_converged)) {
        return std::nullopt;
    }
    std::optional<Stone> mirrored = mirrored_to_azimuths(given.stone, given.readings);
    if (!mirrored) return std::nullopt;
    Problem changed = given;
    changed.stone = std::move(*mirrored);
    changed.mirrored = true;
    return changed;
}

Verdict judge_mirrored_mesh(const Problem& given, const Attempt& first, const Problem&,
                            FitResult again) {
    if (again.status == FitStatus::not_converged ||
        !(again.statistics.chi2 + k_trials.least_gain_of_mirror < first.result.statistics.chi2)) {
        return {};
    }
    const std::string note =
        "by the azimuths read, the mesh is the mirror image of the stone: it was mirrored";
    again.log.notes.insert(again.log.notes.begin(), note);
    again.message += "; " + note;
    // The stone file says that azimuths count as in the mesh.
    if (given.stone.azimuth_from_mesh && again.status == FitStatus::converged) {
        again.status = FitStatus::contradictory;
        again.message = note;
    }
    return {std::move(again), std::nullopt};
}

}  // namespace culet
