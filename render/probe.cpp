#include "render/probe.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "render/scene_checks.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_deepest = 64;

// Keeps every leaf; paths of different wavelengths through the same facets and modes become one.
class Record {
public:
    Record(const Scene& scene, const LightField& lights, int nodes, const Progress& progress,
           ProbeResult& result)
        : scene_(scene), lights_(lights), nodes_(nodes), progress_(progress), result_(result) {}

    void begin(const Band& band) { band_ = &band; }
    void leaf(const Vec3& at, const Vec3& direction, const NodeWeights& weight,
              const PathTrace& trace) {
        // How many leaves there will be is not known: the fraction stays at 0, but a stop is heard.
        if (progress_ && ++leaves_ % 4096 == 0 && !progress_(0)) throw Interrupted();
        std::vector<short> facets(trace.facets.begin(), trace.facets.begin() + trace.length);
        const std::string modes(trace.modes.begin(), trace.modes.begin() + trace.length - 1);
        const auto [found, is_new] = index_.try_emplace({facets, modes}, result_.paths.size());
        if (is_new) {
            ProbedPath path;
            for (short facet : facets) path.facets.push_back(scene_.stone.solid.facets[facet].name);
            path.modes = modes;
            path.weight.assign(nodes_, 0.0);
            path.exit_direction = direction;
            path.light = lights_.name_at(at, direction);
            result_.paths.push_back(std::move(path));
        }
        NodeWeights seen{};
        lights_.add_radiance(at, direction, 1.0, band_->first, band_->count, seen.data());
        for (int i = 0; i < band_->count; ++i) {
            result_.paths[found->second].weight[band_->first + i] += weight[i];
            result_.radiance[band_->first + i] += weight[i] * seen[i];
        }
    }
    void remainder(const NodeWeights& weight) { add(result_.remainder, weight); }
    void absorbed(const NodeWeights& weight) { add(result_.absorbed, weight); }
    void cut(const NodeWeights& weight) { add(result_.cut, weight); }

private:
    void add(std::vector<double>& sums, const NodeWeights& weight) const {
        for (int i = 0; i < band_->count; ++i) sums[band_->first + i] += weight[i];
    }
    const Scene& scene_;
    const LightField& lights_;
    int nodes_;
    long long leaves_ = 0;
    const Progress& progress_;
    ProbeResult& result_;
    const Band* band_ = nullptr;
    std::map<std::pair<std::vector<short>, std::string>, std::size_t> index_;
};

}  // namespace

ProbeResult probe(const Scene& scene, const EyeRay& ray, const Progress& progress) {
    require_renderable(scene);
    const Plan plan = make_plan(scene);
    const WavelengthSet colours(plan.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    const ConvexBody body(scene.stone.solid);
    if (body.contains(ray.origin)) {
        throw InputError(
            "the ray starts inside the stone: rays are followed from the eye, outside");
    }
    const int nodes = colours.size();
    ProbeResult result;
    result.wavelengths_nm = plan.wavelengths_nm;
    result.radiance.assign(nodes, 0.0);
    result.remainder = result.absorbed = result.cut = result.radiance;
    const auto entry = body.entry(ray.origin, ray.direction);
    if (!entry) {
        lights.add_radiance(ray.origin, ray.direction, 1.0, 0, nodes, result.radiance.data());
        return result;
    }
    result.hit = true;
    PathLimits limits;
    limits.depth = scene.settings.depth > 0 ? scene.settings.depth : k_deepest;
    limits.cut_weight = scene.settings.tolerance;
    limits.polarised = plan.polarised;
    limits.seed = scene.settings.seed;
    result.depth = limits.depth;
    Record record(scene, lights, nodes, progress, result);
    for (const Band& band : plan.bands) {
        record.begin(band);
        LightPaths<Record> paths(body, band, limits, record);
        paths.trace(ray, *entry);
        result.sampled = result.sampled || paths.sampled();
    }
    const auto heaviest = [](const ProbedPath& path) {
        return *std::max_element(path.weight.begin(), path.weight.end());
    };
    std::stable_sort(
        result.paths.begin(), result.paths.end(),
        [&](const ProbedPath& a, const ProbedPath& b) { return heaviest(a) > heaviest(b); });
    return result;
}

std::string probe_json(const ProbeResult& result) {
    using Json = nlohmann::ordered_json;
    // One number a path, so that weights + remainder + absorbed + cut = 1; beside it each
    // wavelength's own.
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    Json paths = Json::array();
    for (const ProbedPath& path : result.paths) {
        Json modes = Json::array();
        for (char mode : path.modes) modes.push_back(std::string(1, mode));
        paths.push_back({{"facets", path.facets},
                         {"modes", modes},
                         {"weight", mean(path.weight)},
                         {"weights", path.weight},
                         {"exit_direction",
                          {path.exit_direction.x, path.exit_direction.y, path.exit_direction.z}},
                         {"light", path.light}});
    }
    const Json json = {
        {"schema", 1},
        {"radiance", result.radiance},
        {"wavelengths", result.wavelengths_nm},
        {"paths", paths},
        {"remainder", mean(result.remainder)},
        {"absorbed", mean(result.absorbed)},
        {"cut", mean(result.cut)},
        {"per_wavelength",
         {{"remainder", result.remainder}, {"absorbed", result.absorbed}, {"cut", result.cut}}},
        {"depth", result.depth}};
    return json.dump(2) + "\n";
}

}  // namespace culet
