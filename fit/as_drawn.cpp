#include "fit/as_drawn.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/mesh_roughness.h"
#include "fit/refit.h"

namespace culet {

namespace {

// What the mesh counts beside readings, while it is asked.
constexpr double k_mesh_sigma = 0.1;
// A mesh of which nobody knows to that how its facets face is as well followed by its corners.
constexpr double k_known_to = 0.02;
// It only has to say where the search ends.
constexpr int k_starts = 2;

double open_turns(const System& system, const Shape& shape, const std::vector<Reading>& drawn) {
    double sum = 0;
    for (const Reading& r : drawn) {
        const auto f = std::size_t(r.facets.front());
        const Vec3 off = shape.normals[f] - system.mesh_shape().normals[f];
        sum += glm::dot(off, off);
    }
    return sum;
}

std::vector<Reading> as_drawn(const System& system, const std::vector<Undetermined>& open) {
    std::vector<Reading> readings;
    const std::optional<MeshRoughness> rough = MeshRoughness::of(system);
    for (const Undetermined& u : open) {
        const int f = find_facet(system.stone().solid, u.facet);
        if (f < 0) continue;
        if (rough && rough->turn(f) > k_known_to) return {};
        const Vec3& n = system.mesh_shape().normals[std::size_t(f)];
        Reading r;
        r.of = {u.facet};
        r.facets = {f};
        r.sigma = k_mesh_sigma;
        if (u.freedom == "inclination") {
            r.kind = ReadingKind::inclination;
            r.value = std::atan2(std::hypot(n.x, n.y), std::abs(n.z));
        } else if (u.freedom == "azimuth") {
            r.kind = ReadingKind::azimuth;
            r.value = std::atan2(n.y, n.x);
        } else {
            continue;
        }
        readings.push_back(std::move(r));
    }
    return readings;
}

}  // namespace

std::optional<Candidate> end_as_drawn(const System& system, const Candidate& end,
                                      const std::vector<Undetermined>& open, FitOptions options,
                                      const Progress& progress) {
    const std::vector<Reading> drawn = as_drawn(system, open);
    if (!end.sound || drawn.empty()) return std::nullopt;
    std::vector<Reading> readings = system.readings();
    readings.insert(readings.end(), drawn.begin(), drawn.end());
    options.starts = std::min(options.starts, k_starts);
    const System with_mesh(system.stone(), readings, options);
    const Portfolio portfolio = fit_from_starts(with_mesh, options, progress);
    const Candidate& asked = portfolio.best;
    if (!asked.holds()) return std::nullopt;
    const double turned = open_turns(system, end.finished.shape, drawn);
    const auto is_better = [&](const Candidate& found) {
        return found.holds() && found.finished.chi2 < end.finished.chi2 + k_same_chi2 &&
               open_turns(system, found.finished.shape, drawn) < turned;
    };
    // Where the readings hold nothing of it, it is an end as it stands.
    const Shape& shape = asked.finished.shape;
    Candidate found = finish_from(system, shape, 0);
    if (!is_better(found)) found = finish_from(system, shape, options.iterations);
    if (!is_better(found)) return std::nullopt;
    // As near to the least chi-square as that end is.
    found.finished.converged = end.finished.converged;
    found.finished.iterations += end.finished.iterations;
    found.start = end.start;
    return found;
}

}  // namespace culet
