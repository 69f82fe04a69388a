#include "refine/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "compare/refine/photograph_evidence.h"
#include "compare/refine/photograph_scene.h"
#include "fit/planes/plane_observations.h"
#include "stone/progress/part_of_progress.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Facets off by 0.3 degrees move reflexes by 0.01 to 0.03 diameters: pictures are blurred by as
// much at first. The last rounds only settle.
struct Round {
    double blur;  // in diameters
    bool sketch_anew;
};
constexpr std::array<Round, 10> k_rounds{{{0.03, true},
                                          {0.03, false},
                                          {0.02, true},
                                          {0.02, false},
                                          {0.012, true},
                                          {0.012, false},
                                          {0.008, true},
                                          {0.008, false},
                                          {0.008, true},
                                          {0.008, false}}};
constexpr double k_poses = 0.15;  // part of the progress bar
constexpr double k_least_spread = radians(0.02), k_most_spread = radians(1);

double within_bounds(double sigma) {
    return std::isfinite(sigma) ? std::clamp(sigma, k_least_spread, k_most_spread) : k_most_spread;
}

// Adds the photograph's name to an InputError.
template <class Work>
auto of_photograph(const std::string& name, const Work& work) {
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(name, error.what());
    }
}

// How far each of a facet's three moves may still be off, according to the fit.
std::vector<double> spreads(const FitResult& fit) {
    std::vector<double> result;
    const std::vector<FacetMoves> moves = moves_of(fit.solid);
    for (std::size_t f = 0; f < fit.solid.facets.size(); ++f) {
        const auto facet = std::find_if(
            fit.facets.begin(), fit.facets.end(),
            [&](const FittedFacet& one) { return one.name == fit.solid.facets[f].name; });
        if (facet == fit.facets.end()) {
            result.insert(result.end(), k_moves_of_a_facet, k_most_spread);
            continue;
        }
        // A level facet has no azimuth; both its turns are as uncertain as its inclination.
        const double across = std::sin(facet->inclination) * facet->sigma_azimuth;
        const double turn = std::isfinite(across)
                                ? std::max(facet->sigma_inclination, std::abs(across))
                                : facet->sigma_inclination;
        result.insert(result.end(), 2, within_bounds(turn));
        result.push_back(within_bounds(facet->sigma_offset / moves[f].reach));
    }
    return result;
}

// From the fitted solid's facets to the fit's list, with sigmas larger by `inflation`.
PlaneObservations plane_observations(const PlaneEvidence& evidence, const FitResult& fit,
                                     double inflation) {
    PlaneObservations observations;
    std::vector<int> there;
    for (const FittedFacet& facet : fit.facets) {
        observations.planes.push_back(facet.plane);
        there.push_back(find_facet(fit.solid, facet.name));
    }
    for (const PlaneEvidence::Row& row : evidence.rows) {
        PlaneObservations::Row& scaled = observations.rows.emplace_back();
        scaled.value = row.value / inflation;
        for (const int f : there) {
            const PlaneSlopes slopes = f < 0 ? PlaneSlopes{} : row.facets[std::size_t(f)];
            scaled.normal.push_back(slopes.normal / inflation);
            scaled.offset.push_back(slopes.offset / inflation);
        }
    }
    return observations;
}

// Squared distances of the observations from the fitted planes, and redundancy.
struct Misfit {
    double squares = 0, redundancy = 0;
};

Misfit misfit_of(const PlaneObservations& known, const FitResult& fit) {
    Misfit misfit;
    const std::size_t size = 3 * fit.facets.size();
    const bool covariance_known = fit.facet_covariance.size() == size * size;
    const Vec3 middle = centroid(fit.solid);
    for (const PlaneObservations::Row& row : known.rows) {
        double off = -row.value;
        std::vector<double> slopes;  // by inclination, azimuth, and distance from the middle
        for (std::size_t f = 0; f < fit.facets.size(); ++f) {
            const Plane &plane = fit.facets[f].plane, &was = known.planes[f];
            off += glm::dot(row.normal[f], plane.normal - was.normal) +
                   row.offset[f] * (plane.offset - was.offset);
            const Vec3& n = plane.normal;
            const double across = std::hypot(n.x, n.y);
            const Vec3 by_normal = row.normal[f] + row.offset[f] * middle;
            const Vec3 level = across > 0 ? Vec3(n.x, n.y, 0) / across : Vec3(1, 0, 0);
            slopes.push_back(glm::dot(by_normal, n.z * level - Vec3(0, 0, across)));
            slopes.push_back(across * glm::dot(by_normal, Vec3(-level.y, level.x, 0)));
            slopes.push_back(row.offset[f]);
        }
        double followed = covariance_known ? 0 : 0.5;
        for (std::size_t i = 0; covariance_known && i < size; ++i) {
            if (slopes[i] == 0) continue;
            for (std::size_t j = 0; j < size; ++j) {
                const double term = slopes[i] * slopes[j] * fit.facet_covariance[i * size + j];
                if (std::isfinite(term)) followed += term;
            }
        }
        misfit.squares += off * off;
        misfit.redundancy += std::clamp(1 - followed, 0.0, 1.0);
    }
    return misfit;
}

double root_mean_square(const std::vector<double>& values) {
    double squares = 0;
    for (const double v : values) squares += v * v;
    return std::sqrt(squares / double(std::max<std::size_t>(1, values.size())));
}

struct PhotographCase {
    const RefinePhotograph* given = nullptr;
    PhotographEvidence evidence;
    PhotographFinding finding;
    Reading reading;
};

PhotographCase photograph_case(const RefinePhotograph& given, const Scene& scene,
                               const RefineOptions& options, const Progress& progress) {
    return of_photograph(given.name, [&] {
        Scene own = scene;
        if (given.camera) own.camera = *given.camera;
        const Scene posed = photograph_scene(given.photo, own, options.find_pose && !given.camera,
                                             options.threads, progress);
        PhotographCase photograph{
            &given, PhotographEvidence(given.photo, posed, options.threads), {}, {}};
        photograph.finding.rms_before = photograph.evidence.fit_of(scene.stone.solid).rms;
        photograph.reading.id = given.name;
        photograph.reading.kind = ReadingKind::photograph;
        return photograph;
    });
}

void take_misfit(const EvidenceFit& fit, PhotographFinding& finding) {
    finding.rms = fit.rms;
    for (const Contradiction& one : fit.contradictions) {
        finding.contradictions.push_back(
            {one.x, one.y, one.facet, one.is_brighter, one.deviations, one.area});
    }
}

void describe(const std::vector<PhotographCase>& cases, FitResult& result) {
    for (const PhotographCase& photograph : cases) {
        const std::string& name = photograph.given->name;
        for (std::string& line : photograph_words(name, photograph.finding)) {
            result.log.notes.push_back(std::move(line));
        }
        const auto reading = std::find_if(result.readings.begin(), result.readings.end(),
                                          [&](const FittedReading& r) { return r.id == name; });
        if (reading != result.readings.end()) reading->photograph = photograph.finding;
    }
}

}  // namespace

std::vector<std::string> photograph_words(const std::string& name,
                                          const PhotographFinding& finding) {
    std::vector<std::string> lines{
        fmt::format("{}: differs from the stone's picture by {:.3f} (rms, square root of light), "
                    "by {:.3f} before; it determines {:.0f} combinations of the planes",
                    name, finding.rms, finding.rms_before, finding.parameters_determined)};
    for (const PhotographFinding::Place& place : finding.contradictions) {
        lines.push_back(
            fmt::format("{}: at {:.0f}, {:.0f} (facet {}) {}, {:.0f} times the usual: dust, an "
                        "inclusion, a light missing from the scene, or a facet far from its angle",
                        name, place.x, place.y, place.facet.empty() ? "none" : place.facet,
                        place.brighter ? "it shows a flash that the stone does not give"
                                       : "the stone gives a flash that it does not show",
                        place.deviations));
    }
    return lines;
}

RefineResult refine(const FitInput& input, const std::vector<RefinePhotograph>& photographs,
                    const Scene& given, const RefineOptions& options, const Progress& progress) {
    RefineResult result;
    result.before = fit_stone(input, options.fit);
    Scene scene = given;
    scene.stone.solid = result.before.solid;
    std::vector<PhotographCase> cases;
    const double each = k_poses / double(photographs.size());
    for (std::size_t i = 0; i < photographs.size(); ++i) {
        cases.push_back(photograph_case(photographs[i], scene, options,
                                        part_of(progress, each * double(i), each * double(i + 1))));
    }

    result.after = result.before;
    const auto sketched = std::count_if(k_rounds.begin(), k_rounds.end(),
                                        [](const Round& round) { return round.sketch_anew; });
    const double share = (1 - k_poses) / double(std::size_t(sketched) * cases.size());
    double done = k_poses, inflation = 1, step = 0;
    for (const Round& round : k_rounds) {
        std::vector<double> spread = spreads(result.after);
        // As much as the last step may remain, since reflexes do not move linearly.
        for (double& s : spread) s = std::max(s, step);
        FitInput all = input;
        for (PhotographCase& photograph : cases) {
            const PlaneEvidence evidence = of_photograph(photograph.given->name, [&] {
                return photograph.evidence.measure(result.after.solid, spread, round.blur,
                                                   round.sketch_anew,
                                                   part_of(progress, done, done + share));
            });
            if (round.sketch_anew) done += share;
            photograph.finding.parameters_determined = evidence.parameters_determined;
            photograph.reading.photograph = std::make_shared<const PlaneObservations>(
                plane_observations(evidence, result.after, inflation));
            all.readings.push_back(photograph.reading);
        }
        FitOptions fit = options.fit;
        fit.start = result.after.solid;
        const Solid before = std::move(result.after.solid);
        result.after = fit_stone(all, fit);
        step = root_mean_square(moves_between(before, result.after.solid));
        Misfit misfit;
        for (PhotographCase& photograph : cases) {
            photograph.evidence.settle(result.after.solid);
            const Misfit own = misfit_of(*photograph.reading.photograph, result.after);
            misfit.squares += own.squares;
            misfit.redundancy += own.redundancy;
        }
        // For the next round: how far photographs and readings contradict each other in this one.
        if (misfit.redundancy > 0)
            inflation = std::max(1.0, inflation * std::sqrt(misfit.squares / misfit.redundancy));
    }
    for (PhotographCase& photograph : cases) {
        take_misfit(photograph.evidence.fit_of(result.after.solid), photograph.finding);
    }
    describe(cases, result.after);
    return result;
}

}  // namespace culet
