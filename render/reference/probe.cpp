#include "render/reference/probe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "render/optics/eye_optics.h"
#include "render/reference/crystal_paths.h"
#include "render/reference/light_paths.h"
#include "render/reference/prepared_scene.h"
#include "render/setup/scene_checks.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Allows the whole tree of a crystal to depth 18: too slow for a picture, not for one ray.
constexpr int k_most_splits = 1 << 18;

// Keeps every exit. Paths of different wavelengths through the same facets and modes are merged.
class Record {
public:
    Record(const Scene& scene, const Surroundings& surroundings, int nodes,
           const Progress& progress, ProbeResult& result)
        : scene_(scene),
          surroundings_(surroundings),
          nodes_(nodes),
          progress_(progress),
          result_(result),
          stokes_(static_cast<std::size_t>(4 * nodes), 0.0) {}

    void begin(const Band& band) { band_ = &band; }

    void path_exits(const Vec3& at, const Vec3& direction, const NodeWeights& weight,
                    const PathTrace& trace) {
        ProbedPath& path = path_of(at, direction, trace);
        NodeWeights seen{};
        surroundings_.add_radiance(at, direction, 1.0, band_->first, band_->count, seen.data());
        for (int i = 0; i < band_->count; ++i) {
            path.weight[band_->first + i] += weight[i];
            stokes_[band_->first + i] += weight[i] * seen[i];
            path.stokes[0] += weight[i] / nodes_;
        }
    }
    void path_exits(const PathEnd& end, const PathTrace& trace) {
        ProbedPath& path = path_of(end.at, end.direction, trace);
        const Stokes through = stokes_of_unpolarised(end.coherency);
        for (int i = 0; i < band_->count; ++i) {
            path.weight[band_->first + i] += through[0] * end.transmitted[i];
            for (int k = 0; k < 4; ++k) path.stokes[k] += through[k] * end.transmitted[i] / nodes_;
        }
        surroundings_.add_stokes(end, band_->first, band_->count, stokes_.data(), nodes_);
    }
    void remainder(const NodeWeights& weight) { add(result_.remainder, weight); }
    void absorbed(const NodeWeights& weight) { add(result_.absorbed, weight); }
    void cut(const NodeWeights& weight) { add(result_.cut, weight); }
    void roulette(const NodeWeights&) {}  // probes cut instead
    void choice_begins() { estimates_.begin(seen()); }
    void choice_ends(bool second) { estimates_.end(second, seen()); }

    // Applies the analyser, if there is one.
    void finish(const EyeOptics& optics) {
        for (int i = 0; i < nodes_; ++i) {
            const Stokes row = response(optics, result_.wavelengths_nm[i]);
            for (int k = 0; k < 4; ++k) {
                result_.radiance[i] += row[k] * stokes_[k * nodes_ + i];
                result_.stokes[k] += stokes_[k * nodes_ + i] / nodes_;
            }
        }
        result_.standard_error = std::sqrt(estimates_.variance()) / nodes_;
    }
    std::vector<double>& stokes() { return stokes_; }

private:
    ProbedPath& path_of(const Vec3& at, const Vec3& direction, const PathTrace& trace) {
        // The number of exits is unknown, so the progress stays at 0; the call only checks for a
        // stop.
        if (progress_ && ++exits_ % 4096 == 0 && !progress_(0)) throw Interrupted();
        std::vector<int> facets(trace.facets.begin(), trace.facets.begin() + trace.length);
        const std::string modes(trace.modes.begin(), trace.modes.begin() + trace.length - 1);
        const auto [found, is_new] = index_.try_emplace({facets, modes}, result_.paths.size());
        if (is_new) {
            ProbedPath path;
            for (int facet : facets) path.facets.push_back(scene_.stone.solid.facets[facet].name);
            path.modes = modes;
            path.weight.assign(nodes_, 0.0);
            path.exit_direction = direction;
            path.light = surroundings_.name_at(at, direction);
            result_.paths.push_back(std::move(path));
        }
        return result_.paths[found->second];
    }
    double seen() const {
        double sum = 0;
        for (int i = 0; i < nodes_; ++i) sum += stokes_[i];
        return sum;
    }
    void add(std::vector<double>& sums, const NodeWeights& weight) const {
        for (int i = 0; i < band_->count; ++i) sums[band_->first + i] += weight[i];
    }
    const Scene& scene_;
    const Surroundings& surroundings_;
    int nodes_;
    long long exits_ = 0;
    const Progress& progress_;
    ProbeResult& result_;
    std::vector<double> stokes_;
    const Band* band_ = nullptr;
    std::map<std::pair<std::vector<int>, std::string>, std::size_t> index_;
    PairedEstimates estimates_;
};

}  // namespace

PolarisationEllipse ellipse_of(const Stokes& s) {
    PolarisationEllipse ellipse;
    const double polarised = std::hypot(s[1], s[2], s[3]);
    if (!(s[0] > 0) || !(polarised > 0)) return ellipse;
    ellipse.degree = std::min(1.0, polarised / s[0]);
    ellipse.azimuth = 0.5 * std::atan2(s[2], s[1]);
    if (ellipse.azimuth < 0) ellipse.azimuth += std::numbers::pi;
    ellipse.ellipticity = 0.5 * std::asin(std::clamp(s[3] / polarised, -1.0, 1.0));
    return ellipse;
}

ProbeResult probe(const Scene& scene, const EyeRay& ray, const Progress& progress) {
    require_renderable(scene);
    PathLimits as_asked;
    as_asked.depth = scene.settings.depth > 0 ? scene.settings.depth : k_deepest;
    as_asked.cut_weight = scene.settings.tolerance;
    as_asked.seed = scene.settings.seed;
    as_asked.most_splits = k_most_splits;
    const PreparedScene prepared(scene, k_node_counts[1], as_asked);
    PathLimits limits = prepared.limits;
    const Surroundings& surroundings = *prepared.surroundings;
    limits.obstacles = &surroundings;
    const StoneBody body(scene.stone.solid, scene.stone.convex);
    if (scene.has_stone() && body.contains(ray.origin)) {
        throw InputError(
            "the ray starts inside the stone: rays are followed from the eye, outside");
    }
    const int nodes = prepared.colours.size();
    ProbeResult result;
    result.wavelengths_nm = prepared.setup.wavelengths_nm;
    result.radiance.assign(nodes, 0.0);
    result.remainder = result.absorbed = result.cut = result.radiance;
    Record record(scene, surroundings, nodes, progress, result);
    const EyeFrame frame = EyeRays(scene.camera).frame(ray.direction);
    const auto entry =
        scene.has_stone() ? body.entry(ray.origin, ray.direction) : std::optional<BodyHit>();
    if (!entry || surroundings.nearest_distance(ray.origin, ray.direction) < entry->distance) {
        surroundings.add_direct_stokes(ray, frame, nodes, record.stokes().data());
        record.finish(scene.camera.optics);
        return result;
    }
    result.hit = true;
    result.depth = limits.depth;
    for (const Band& band : prepared.setup.bands) {
        record.begin(band);
        if (prepared.setup.polarised && !body.has_ground()) {
            CrystalPaths<Record> paths(body, band, limits, record);
            paths.trace(ray, frame.x, frame.y, *entry);
            result.sampled = result.sampled || paths.sampled();
            result.worst_imbalance = std::max(result.worst_imbalance, paths.worst_imbalance());
        } else {
            LightPaths<Record>(body.planes(), band, limits, record).trace(ray, *entry);
        }
    }
    record.finish(scene.camera.optics);
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
    // The mean over wavelengths, so that weights + remainder + absorbed + cut = 1; each
    // wavelength's value is beside it.
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    const auto ellipse = [](const Stokes& stokes) {
        const PolarisationEllipse e = ellipse_of(stokes);
        return Json{{"degree", e.degree},
                    {"azimuth", degrees(e.azimuth)},
                    {"ellipticity", degrees(e.ellipticity)}};
    };
    Json paths = Json::array();
    for (const ProbedPath& path : result.paths) {
        Json modes = Json::array();
        for (char mode : path.modes) modes.push_back(std::string(1, mode));
        paths.push_back({{"facets", path.facets},
                         {"modes", modes},
                         {"weight", mean(path.weight)},
                         {"weights", path.weight},
                         {"stokes", path.stokes},
                         {"ellipse", ellipse(path.stokes)},
                         {"exit_direction",
                          {path.exit_direction.x, path.exit_direction.y, path.exit_direction.z}},
                         {"light", path.light}});
    }
    const Json json = {
        {"schema", 1},
        {"radiance", result.radiance},
        {"wavelengths", result.wavelengths_nm},
        {"stokes", result.stokes},
        {"ellipse", ellipse(result.stokes)},
        {"paths", paths},
        {"remainder", mean(result.remainder)},
        {"absorbed", mean(result.absorbed)},
        {"cut", mean(result.cut)},
        {"per_wavelength",
         {{"remainder", result.remainder}, {"absorbed", result.absorbed}, {"cut", result.cut}}},
        {"depth", result.depth},
        {"standard_error", result.standard_error},
        {"worst_imbalance", result.worst_imbalance}};
    return json.dump(2) + "\n";
}

}  // namespace culet
