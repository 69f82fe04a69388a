#include "fit/starts/robust.h"

#include <algorithm>
#include <cmath>

#include "fit/model/equations.h"
#include "fit/model/linear.h"
#include "fit/starts/constants.h"
#include "fit/starts/refit.h"

namespace culet {

double robust_weight(Loss loss, double z) {
    z = std::abs(z);
    switch (loss) {
        case Loss::none:
            return 1;
        case Loss::huber:
            return z <= k_robust.huber ? 1 : std::max(k_robust.least_weight, k_robust.huber / z);
        case Loss::cauchy:
            return std::max(k_robust.least_weight,
                            1 / (1 + (z / k_robust.cauchy) * (z / k_robust.cauchy)));
    }
    return 1;
}

std::vector<double> reweight(FitModel& model, Candidate& candidate, Loss loss, int iterations) {
    // Each replicate gets its own weight.
    model.keep_replicates_apart();
    const std::size_t count = model.readings().size();
    std::vector<double> weights(count, 1), sigmas;
    for (const Reading& r : model.readings()) sigmas.push_back(r.sigma);
    double work = 0;
    for (int round = 0; round < k_robust.rounds && work < k_robust.most_work; ++round) {
        const Finished& finished = candidate.finished;
        std::vector<double> worst(count, 0);
        for (const Equation& e : all_equations(model, finished.shape, finished.outline)) {
            if (e.reading < 0 || e.exact || e.role != Equation::Role::reading) continue;
            const std::size_t r = std::size_t(e.reading);
            const double unit = model.frame().unit_of(model.readings()[r]);
            const double off = e.formula(finished.shape).value - e.value;
            worst[r] = std::max(worst[r], std::abs(off) * unit / sigmas[r]);
        }
        double change = 0;
        for (std::size_t r = 0; r < count; ++r) {
            if (!(sigmas[r] > 0) || model.readings()[r].exact) continue;
            const double weight = robust_weight(loss, worst[r]);
            change = std::max(change, std::abs(std::log(weight / weights[r])));
            weights[r] = weight;
            model.set_reading_sigma(int(r), sigmas[r] / std::sqrt(weight));
        }
        if (change < 0.01) break;
        Candidate next = finish_from(model, finished.shape, iterations);
        work += next.finished.work;
        next.start = candidate.start;
        next.finished.iterations += candidate.finished.iterations;
        // Stop when a sound stone becomes unsound: the weights lead nowhere.
        if ((candidate.sound && !next.sound) || next.is_no_stone) break;
        candidate = std::move(next);
        if (!candidate.finished.converged) break;
    }
    return weights;
}

}  // namespace culet
