#include "render/optimize/merit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "render/grade/scope_shares.h"
#include "render/work/threads.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::array k_tilts_deg{0.0, -10.0, 10.0, -20.0, 20.0, -30.0, 30.0};
constexpr std::array k_part_names{"brilliance", "fire", "contrast", "tilt"};
// Directions and faces for fire, as in grade's coarse figures.
constexpr int k_fire_rings = 1, k_fire_ring = 2, k_fire_faces = 8;

double weight_of(const MeritOptions& options, MeritPart part) {
    return options.weights[static_cast<std::size_t>(part)];
}

}  // namespace

const char* name_of(MeritPart part) {
    return k_part_names[static_cast<std::size_t>(part)];
}

std::array<double, k_merit_part_count> merit_weights(const std::string& text) {
    std::array<double, k_merit_part_count> weights{};
    std::size_t at = 0;
    while (at <= text.size()) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string item = text.substr(at, end - at);
        const std::size_t equals = std::min(item.find('='), item.size());
        const auto* const found =
            std::find(k_part_names.begin(), k_part_names.end(), item.substr(0, equals));
        double weight = 1;
        char* rest = nullptr;
        if (equals < item.size()) weight = std::strtod(item.c_str() + equals + 1, &rest);
        if (found == k_part_names.end() || !(weight >= 0 && weight <= 1e6) ||
            (rest != nullptr && (*rest != '\0' || equals + 1 == item.size()))) {
            throw InputError(fmt::format(
                "--objective is brilliance, fire, contrast or tilt, or several with weights, as "
                "brilliance=2,fire=1; found \"{}\"",
                item));
        }
        weights[static_cast<std::size_t>(found - k_part_names.begin())] = weight;
        at = end + 1;
    }
    if (!(std::accumulate(weights.begin(), weights.end(), 0.0) > 0))
        throw InputError("--objective has no part with a weight above 0");
    return weights;
}

Merit merit_of(const Solid& convex, const MeritOptions& options) {
    const EyeLightTracer tracer(convex);
    const RandomSky sky(1, options.index.n);
    const int table = table_facet(convex, {0, 0, 1});
    const auto model = static_cast<std::size_t>(options.model);
    const bool tilts =
        weight_of(options, MeritPart::brilliance) > 0 || weight_of(options, MeritPart::tilt) > 0;
    const std::vector<Vec3> coloured =
        weight_of(options, MeritPart::fire) > 0
            ? cone_directions(GradeOptions{}.light_cone, k_fire_rings, k_fire_ring)
            : std::vector<Vec3>{};
    if (!coloured.empty() && !options.index.fire)
        throw InputError("fire needs a material whose dispersion is known (--material)");
    std::array<double, k_tilts_deg.size()> returned{};
    std::vector<std::pair<double, double>> fires(coloured.size());  // area, separated
    double blue = 0;
    const std::size_t views = tilts ? k_tilts_deg.size() : 1;
    const std::vector<bool> crown = crown_facets(convex);
    const auto view = [&](std::size_t i) {
        if (i < views) {
            const EyeLight light =
                tracer.trace(eye_over_tilted(radians(k_tilts_deg[i]), 0), options.index.n);
            returned[i] = light_return(light, table, options.head, sky).whole[model];
            if (i == 0) blue = aset_shares(light).blue;
            return;
        }
        EyeLightLimits limits;
        limits.regions = true;
        limits.faces = k_fire_faces;
        std::array<EyeLight, 3> colours;
        const Vec3 along = coloured[i - views];
        for (std::size_t c = 0; c < 3; ++c)
            colours[c] = tracer.trace(along, (*options.index.fire)[c], limits);
        fires[i - views] = {colours[0].area / along.z,
                            fire_of(colours, crown, {0, 0, 1}, GradeOptions{}.view_cone).separated};
    };
    on_threads(options.threads,
               [&] { tbb::parallel_for(std::size_t{0}, views + coloured.size(), view); });
    Merit merit;
    double area = 0, separated = 0;
    for (const auto& [of, share] : fires) {
        area += of;
        separated += of * share;
    }
    const double mean = std::accumulate(returned.begin(), returned.end(), 0.0) / double(views);
    const double at_20 = 0.5 * (returned[3] + returned[4]);
    merit.parts = {100 * mean, area > 0 ? 100 * separated / area : 0, 100 * blue,
                   returned[0] > 0 ? 100 * std::min(1.0, at_20 / returned[0]) : 0};
    double sum = 0;
    for (std::size_t p = 0; p < merit.parts.size(); ++p) {
        if (!(options.weights[p] > 0)) merit.parts[p] = 0;
        merit.total += options.weights[p] * merit.parts[p];
        sum += options.weights[p];
    }
    merit.total /= sum;
    return merit;
}

}  // namespace culet
