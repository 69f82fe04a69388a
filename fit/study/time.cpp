// Error and time of one way of fitting after the other, on the same draws.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "fit/study/parts.h"

namespace culet {

namespace {

constexpr std::array k_iterations{1, 2, 4, 8, 16, 32};
constexpr std::array k_shakes{0.01, 0.05, 0.1, 0.2};
// Several starts are only needed if the mesh is bad.
constexpr std::array k_starts{1, 2, 4, 8};
constexpr double k_bad_mesh = 0.2;
// Sigma when a symmetry declared exact is studied as soft.
constexpr double k_soft_symmetry = 0.1;  // degrees

struct Way {
    StudySetting row;
    FitOptions options;
    enum class Symmetry { as_asked, exact, soft, none } symmetry = Symmetry::as_asked;
    double shake = 0;            // of the mesh's corners, in diameters
    bool is_asked_fit = false;   // from the unchanged mesh, with the stone file's options
    bool same_equations = true;  // chi-square is comparable with that of the fit as asked
    std::vector<double> seconds;
    std::vector<StudyError> errors;
    double left = 0;  // sum of squares
};

struct Outcome {
    FitResult fitted;
    double seconds = 0;
};

bool is_symmetry(ReadingKind kind) {
    return kind == ReadingKind::rotation || kind == ReadingKind::mirror;
}

std::vector<Reading> with_symmetry(const std::vector<Reading>& readings, Way::Symmetry how) {
    std::vector<Reading> result;
    for (Reading reading : readings) {
        if (is_symmetry(reading.kind) && how != Way::Symmetry::as_asked) {
            if (how == Way::Symmetry::none) continue;
            reading.exact = how == Way::Symmetry::exact;
            if (how == Way::Symmetry::soft && !(reading.sigma > 0)) {
                reading.sigma = radians(k_soft_symmetry);
            }
        }
        result.push_back(std::move(reading));
    }
    return result;
}

// A badly drawn mesh: normal errors in every corner's coordinates, so facets are no longer planar.
Stone shaken(Stone stone, double share, std::uint64_t seed, int draw) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(draw), 0x5ca1eu};
    std::mt19937_64 random(sequence);
    std::normal_distribution<double> normal(0, share * diameter(stone.solid) / std::sqrt(3.0));
    for (Vec3& v : stone.solid.vertices) {
        for (int k = 0; k < 3; ++k) v[k] += normal(random);
    }
    for (Facet& facet : stone.solid.facets) {
        std::vector<Vec3> loop;
        for (const int corner : facet.corners) {
            loop.push_back(stone.solid.vertices[static_cast<std::size_t>(corner)]);
        }
        const Plane plane = plane_through(loop);
        if (plane.normal != Vec3(0)) facet.plane = plane;
    }
    return stone;
}

std::vector<Way> ways(const std::vector<Reading>& readings, const FitOptions& asked) {
    std::vector<Way> all;
    const auto add = [&](const char* sweep, std::string setting, bool is_asked) -> Way& {
        Way way;
        way.row.sweep = sweep;
        way.row.setting = std::move(setting);
        way.row.as_asked = way.is_asked_fit = is_asked;
        way.options = asked;
        all.push_back(std::move(way));
        return all.back();
    };
    for (const int steps : k_iterations) {
        if (steps >= asked.iterations) break;
        add("iterations", fmt::format("{}", steps), false).options.iterations = steps;
    }
    add("iterations", fmt::format("{}", asked.iterations), true);
    for (const auto& [name, meets] :
         {std::pair("exact", MeetTreatment::exact), std::pair("soft", MeetTreatment::soft),
          std::pair("released", MeetTreatment::released)}) {
        Way& way = add("meets", name, meets == asked.meets);
        way.options.meets = meets;
        way.options.meets_named = asked.meets_named || meets != asked.meets;
        way.same_equations = false;
    }
    const auto symmetry = std::find_if(readings.begin(), readings.end(),
                                       [](const Reading& r) { return is_symmetry(r.kind); });
    if (symmetry != readings.end()) {
        const bool exact = symmetry->exact;
        for (const auto& [name, how] :
             {std::pair("exact", Way::Symmetry::exact), std::pair("soft", Way::Symmetry::soft),
              std::pair("none", Way::Symmetry::none)}) {
            Way& way =
                add("symmetry", name, how == (exact ? Way::Symmetry::exact : Way::Symmetry::soft));
            way.symmetry = how;
            way.same_equations = false;
        }
    }
    add("start", "mesh", true);
    for (const double share : k_shakes) {
        add("start", fmt::format("shaken {:g} %", 100 * share), false).shake = share;
    }
    const auto add_starts = [&](int starts) {
        Way& way = add("starts", fmt::format("{}", starts), false);
        way.row.as_asked = starts == asked.starts;
        way.options.starts = starts;
        way.shake = k_bad_mesh;
    };
    for (const int starts : k_starts) {
        if (starts < asked.starts) add_starts(starts);
    }
    add_starts(asked.starts);
    return all;
}

Outcome outcome_of(const Way& way, const Stone& stone, const std::vector<Reading>& drawn,
                   std::uint64_t seed, int draw) {
    const std::vector<Reading> readings = with_symmetry(drawn, way.symmetry);
    const Stone start = way.shake > 0 ? shaken(stone, way.shake, seed, draw) : stone;
    const double begin = processor_seconds();
    FitResult fitted = fit_stone(start, readings, way.options);
    return {std::move(fitted), processor_seconds() - begin};
}

// Both fits of one draw; `end` is the one as asked, taken as the truth.
void note(const Outcome& outcome, const FitResult& asked, const StudyTruth& truth,
          const StudyTruth& end, Way& way) {
    const FitResult& fitted = outcome.fitted;
    ++way.row.fits;
    way.seconds.push_back(outcome.seconds);
    if (is_sound(truth.stone, fitted)) {
        ++way.row.sound;
        way.errors.push_back(error_of(truth, fitted));
        way.left += error_of(end, fitted).angle;
    }
    if (!is_settled(truth.stone, fitted)) return;
    ++way.row.settled;
    const double best = asked.statistics.chi2;
    if (way.same_equations && fitted.statistics.chi2 <= best + std::max(4.0, 0.05 * best)) {
        ++way.row.best;
    }
}

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const auto high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

void sum_up(Way& way) {
    std::sort(way.seconds.begin(), way.seconds.end());
    way.row.seconds = quantile(way.seconds, 0.5);
    way.row.seconds_low = quantile(way.seconds, 0.25);
    way.row.seconds_high = quantile(way.seconds, 0.75);
    if (!way.same_equations) way.row.best = -1;
    if (way.errors.empty()) return;
    const StudyError mean = mean_of(way.errors);
    way.row.angle_error = std::sqrt(mean.angle);
    if (way.same_equations) way.row.angle_left = std::sqrt(way.left / double(way.errors.size()));
    way.row.offset_error = std::sqrt(mean.offset);
}

}  // namespace

void study_settings(const Stone& stone, const std::vector<Reading>& readings, const FitResult& base,
                    StudyBudget& budget, Study& study) {
    const StudyTruth truth = truth_of(stone, readings, base);
    std::vector<Way> all = ways(readings, study.options.fit);
    for (int draw = 0; draw < study.options.draws && !budget.spent(); ++draw) {
        const std::vector<Reading> drawn = drawn_readings(truth.readings, study.options.seed, draw);
        Way plain;
        plain.options = study.options.fit;
        const Outcome asked = outcome_of(plain, stone, drawn, study.options.seed, draw);
        const StudyTruth end = truth_of(stone, drawn, asked.fitted);
        for (std::size_t w = 0; w < all.size(); ++w) {
            if (all[w].is_asked_fit) {
                note(asked, asked.fitted, truth, end, all[w]);
            } else if (!budget.spent()) {
                note(outcome_of(all[w], stone, drawn, study.options.seed, draw), asked.fitted,
                     truth, end, all[w]);
            }
            budget.report(0.5 * (draw + double(w) / double(all.size())) / study.options.draws);
        }
    }
    for (Way& way : all) {
        if (way.row.fits == 0) {
            study.left_out.push_back(fmt::format("{} {}", way.row.sweep, way.row.setting));
            continue;
        }
        sum_up(way);
        study.settings.push_back(way.row);
    }
}

}  // namespace culet
