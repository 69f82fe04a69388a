#include "render/beams/beam_renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "render/beams/shading_passes.h"
#include "render/optics/eye_optics.h"
#include "render/work/listener.h"
#include "render/work/price.h"
#include "render/work/threads.h"
#include "render/work/work_meter.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_pupil_points = 64;
using Clock = std::chrono::steady_clock;
double seconds_from(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Points of the unit disc with equal areas: Vogel's sunflower (1979).
std::vector<ScreenPoint> pupil_points(int count) {
    constexpr double k_golden_angle = 2.39996322972865332;
    std::vector<ScreenPoint> points;
    for (int i = 0; i < count; ++i) {
        const double radius = std::sqrt((i + 0.5) / count);
        points.push_back(
            {radius * std::cos(k_golden_angle * i), radius * std::sin(k_golden_angle * i)});
    }
    return points;
}

std::vector<ScreenView> views_of(const Scene& scene, const OpticalSetup& setup) {
    std::vector<ScreenView> views;
    if (setup.on(Effects::aperture)) {
        const int points = scene.settings.samples > 0 ? scene.settings.samples : k_pupil_points;
        for (const ScreenPoint& p : pupil_points(points))
            views.push_back(screen_view(scene.camera, p.x, p.y));
    } else {
        Camera pinhole = scene.camera;
        pinhole.aperture_radius = 0;
        views.push_back(screen_view(pinhole));
    }
    return views;
}

// For each band the band whose beams it shares. By Snell's law the borders of two wavelengths'
// beams differ by an angle of at most |dn| / (n sqrt(n^2 - 1)), over the path through the stone.
// Bands share beams while that is below the allowed map error.
std::vector<std::size_t> shared_beams(const OpticalSetup& setup, const ScreenView& view,
                                      const Vec3& middle, double size, const BeamLimits& limits) {
    // Segments measure about 2/3 of the stone; few longer paths carry light.
    constexpr double k_segment = 2.0 / 3;
    constexpr int k_longest = 16;
    const ScreenImage here = view.of_point(middle),
                      beside = view.of_point(middle + size * view.right);
    const double pixels =
        std::hypot(beside.x / beside.z - here.x / here.z, beside.y / beside.z - here.y / here.z);
    const double way = k_segment * std::min(limits.depth, k_longest) * pixels;
    std::vector<std::size_t> leader(setup.bands.size());
    for (std::size_t first = 0; first < leader.size();) {
        const auto index = [&](std::size_t b) {
            return setup.bands[b].n / setup.bands[b].n_outside;
        };
        const auto apart = [&](std::size_t a, std::size_t b) {
            const double n = std::min(index(a), index(b));
            return way * std::abs(index(a) - index(b)) / (n * std::sqrt((n - 1) * (n + 1)));
        };
        std::size_t middle_band = first, end = first + 1;
        // Extend from both ends to the middle band.
        while (end < leader.size() && apart(first, end) <= 2 * limits.map_error) {
            ++end;
            while (middle_band + 1 < end && apart(first, middle_band + 1) <= limits.map_error)
                ++middle_band;
        }
        while (end > first + 1 && apart(middle_band, end - 1) > limits.map_error) --end;
        for (; first < end; ++first) leader[first] = std::min(middle_band, end - 1);
    }
    return leader;
}

}  // namespace

struct BeamRenderer::Work {
    explicit Work(const Solid& solid) : stone(solid) {}

    PaintedStone stone;
    std::vector<SortedBeams> beams;  // view * bands + band
    std::shared_ptr<const EnvironmentPyramid> pyramid;
    Canvas canvas;
    // One painter per thread, which keeps its memory.
    tbb::enumerable_thread_specific<StripPainter> painters{
        [this] { return StripPainter(stone, canvas); }};
    BeamReport report;

    // Colour of each plane: radiance or a Stokes parameter at a node.
    std::vector<std::array<float, 3>> rgb_of_plane;
    void clear(int strip);
    void develop(int strip, Picture& picture) const;
    void prepare(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                 std::size_t planes, Picture& picture, Listener& listener);
    void keep_spectra(const Scene& scene, const OpticalSetup& setup, Picture& picture) const;
};

void BeamRenderer::Work::prepare(const Scene& scene, const OpticalSetup& setup,
                                 const WavelengthSet& colours, std::size_t planes, Picture& picture,
                                 Listener& listener) {
    pyramid = scene.lights.environment
                  ? pyramid_of(scene.lights.environment, [&] { return listener.still_goes_on(); })
                  : nullptr;
    if (listener.stopped()) throw Interrupted();
    canvas.width = picture.width = scene.camera.width;
    canvas.height = picture.height = scene.camera.height;
    canvas.planes.resize(planes * canvas.pixels());
    canvas.coverage.resize(canvas.pixels());
    picture.rgb.resize(3 * canvas.pixels());
    picture.wavelengths_nm.clear();
    picture.spectral.clear();
    for (auto& plane : picture.polarised) plane.clear();
    rgb_of_plane.clear();
    const std::size_t nodes = setup.wavelengths_nm.size();
    std::vector<double> one(nodes, 0.0);
    for (std::size_t i = 0; i < planes; ++i) {
        const std::size_t node = i % nodes;
        one[node] = 1;
        const Rgb rgb = colours.rgb_of(one.data());
        one[node] = 0;
        // Applies the eye's optics to Stokes planes; otherwise the passes contain them.
        const double seen =
            planes > nodes ? response(scene.camera.optics, setup.wavelengths_nm[node])[i / nodes]
                           : 1.0;
        rgb_of_plane.push_back({static_cast<float>(seen * rgb[0]),
                                static_cast<float>(seen * rgb[1]),
                                static_cast<float>(seen * rgb[2])});
    }
}

void BeamRenderer::Work::clear(int strip) {
    const std::size_t width = static_cast<std::size_t>(canvas.width);
    const std::size_t begin = static_cast<std::size_t>(strip * k_strip) * width,
                      count = static_cast<std::size_t>(
                                  std::min(k_strip, canvas.height - strip * k_strip)) *
                              width;
    for (std::size_t p = 0; p < rgb_of_plane.size(); ++p)
        std::fill_n(canvas.planes.data() + p * canvas.pixels() + begin, count, 0.0f);
    std::fill_n(canvas.coverage.data() + begin, count, 0.0f);
}

void BeamRenderer::Work::develop(int strip, Picture& picture) const {
    const std::size_t width = static_cast<std::size_t>(canvas.width);
    const std::size_t begin = static_cast<std::size_t>(strip * k_strip) * width,
                      end =
                          static_cast<std::size_t>(std::min((strip + 1) * k_strip, canvas.height)) *
                          width;
    float* rgb = picture.rgb.data();
    if (rgb_of_plane.size() == 1) {
        spread_to_rgb(canvas.planes.data() + begin, end - begin, rgb + 3 * begin);
        return;
    }
    std::fill(rgb + 3 * begin, rgb + 3 * end, 0.0f);
    for (std::size_t p = 0; p < rgb_of_plane.size(); ++p) {
        const float* plane = canvas.planes.data() + p * canvas.pixels();
        const auto& weight = rgb_of_plane[p];
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] += weight[c] * plane[i];
        }
    }
}

void BeamRenderer::Work::keep_spectra(const Scene& scene, const OpticalSetup& setup,
                                      Picture& picture) const {
    const std::size_t nodes = setup.wavelengths_nm.size(), planes = rgb_of_plane.size(),
                      pixels = canvas.pixels();
    picture.wavelengths_nm = setup.wavelengths_nm;
    const auto plane = [&](std::size_t number) { return canvas.planes.data() + number * pixels; };
    for (std::size_t node = 0; node < nodes; ++node) {
        std::vector<float> seen(pixels, 0.0f);
        for (std::size_t p = node; p < planes; p += nodes) {
            const float weight =
                planes > nodes ? static_cast<float>(response(scene.camera.optics,
                                                             setup.wavelengths_nm[node])[p / nodes])
                               : 1.0f;
            for (std::size_t i = 0; i < pixels; ++i) seen[i] += weight * plane(p)[i];
        }
        picture.spectral.push_back(std::move(seen));
        for (std::size_t k = 1; k * nodes < planes; ++k)
            picture.polarised[k - 1].emplace_back(plane(k * nodes + node),
                                                  plane(k * nodes + node) + pixels);
    }
}

BeamRenderer::BeamRenderer(const Solid& convex) : work_(std::make_unique<Work>(convex)) {}
BeamRenderer::~BeamRenderer() = default;

const BeamReport& BeamRenderer::report() const {
    return work_->report;
}

void BeamRenderer::draw(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                        const BeamSettings& settings, Picture& picture, const Progress& progress) {
    Work& work = *work_;
    const std::size_t nodes = setup.wavelengths_nm.size();
    const std::size_t stokes = setup.stokes && scene.settings.spectral ? 4 : 1;
    const std::vector<ScreenView> views = views_of(scene, setup);
    const int strips = (scene.camera.height + k_strip - 1) / k_strip;
    Listener listener(progress, static_cast<double>(views.size()) * static_cast<double>(strips));
    work.prepare(scene, setup, colours, stokes * nodes, picture, listener);
    std::vector<ShadingPass> passes =
        shading_passes(scene, setup, colours, work.stone.shaded.middle, work.pyramid,
                       static_cast<int>(stokes), settings.crystal == CrystalBeams::split);
    const std::vector<std::size_t> leader = shared_beams(setup, views[0], work.stone.shaded.middle,
                                                         work.stone.net.size(), settings.limits);
    for (ShadingPass& pass : passes) pass.beams = leader[pass.beams];
    BeamReport& report = work.report;
    report = {};
    PaintOptions options;
    options.shading = settings.shading;
    options.depth = settings.limits.depth;
    options.cut_weight = settings.limits.cut_weight;
    options.share = 1.0 / static_cast<double>(views.size());

    const std::size_t bands = setup.bands.size();
    work.beams.resize(views.size() * bands);
    StripSums whole;
    double lost = 0;
    int trees = 0;
    WorkMeter* const meter = scene.settings.meter.get();
    const auto may_spend = [&](double ns) {
        return listener.still_goes_on() && (meter == nullptr || !(ns > meter->left()));
    };
    for (std::size_t v = 0; v < views.size(); ++v) {
        SortedBeams* beams = work.beams.data() + v * bands;
        std::vector<StripSums> sums(static_cast<std::size_t>(strips));
        const std::vector<FrontFacet> fronts = front_facets(work.stone.net, views[v]);
        on_threads(settings.threads, [&] {
            const auto building = Clock::now();
            tbb::parallel_for(
                std::size_t{0}, bands,
                [&](std::size_t b) {
                    const Band& band = setup.bands[b];
                    if (band.two_waves && settings.crystal == CrystalBeams::split) return;
                    if (leader[b] != b) return;
                    beams[b].grow(work.stone.net, views[v], band.n / band.n_outside,
                                  settings.limits, [&](long long grown) {
                                      return may_spend(price_ns(DrawnBeams{.grown = grown}));
                                  });
                    const BeamTree& tree = beams[b].tree;
                    if (meter != nullptr)
                        meter->spend(price_ns(DrawnBeams{.grown = tree.discarded + tree.grown(),
                                                         .walked = tree.faces()}));
                },
                tbb::simple_partitioner());
            report.seconds_build += seconds_from(building);
            const auto shading = Clock::now();
            tbb::parallel_for(
                0, strips,
                [&](int strip) {
                    if (!listener.goes_on() || (meter != nullptr && meter->over())) return;
                    if (v == 0) work.clear(strip);
                    // Count work while painting, as a strip may take seconds.
                    double spent = 0;
                    PaintOptions asking = options;
                    asking.goes_on = [&](const StripSums& sum) {
                        const double before = spent;
                        spent = std::floor(price_ns(DrawnBeams{.split = sum.beams,
                                                               .fragments = sum.fragments,
                                                               .faces = sum.faces,
                                                               .nodes = passes[0].lights.nodes}));
                        if (meter != nullptr) meter->spend(spent - before);
                        return may_spend(0);
                    };
                    const StripSums& sum = sums[static_cast<std::size_t>(strip)] =
                        work.painters.local().paint(strip, views[v], beams, fronts, passes, asking);
                    asking.goes_on(sum);
                    if (v + 1 == views.size()) work.develop(strip, picture);
                },
                tbb::simple_partitioner());
            report.seconds_shade += seconds_from(shading);
        });
        if (listener.stopped()) throw Interrupted();
        if (meter != nullptr) meter->require_not_over();
        for (const StripSums& sum : sums) whole += sum;
        const bool kept = settings.crystal == CrystalBeams::merged || !setup.splits;
        for (std::size_t b = 0; kept && b < bands; ++b) {
            if (leader[b] != b) continue;
            const BeamTree& tree = beams[b].tree;
            report.beams += tree.grown();
            report.deepest = std::max(report.deepest, tree.deepest());
            if (!(tree.front_area > 0)) continue;
            lost += (tree.front_area - tree.exit_area()) / tree.front_area;
            ++trees;
        }
    }
    report.fragments = whole.fragments;
    report.beams += whole.beams;
    report.deepest = std::max(report.deepest, whole.deepest);
    report.retraced = whole.retraced;
    report.filled = whole.filled;
    report.lost_area = trees > 0 ? lost / trees : 0;
    if (whole.filled > 0) {
        report.remainder = whole.remainder / whole.filled;
        report.absorbed = whole.absorbed / whole.filled;
        report.luminance = whole.luminance / whole.filled;
    }
    std::swap(picture.coverage, work.canvas.coverage);
    if (scene.settings.spectral) work.keep_spectra(scene, setup, picture);
}

}  // namespace culet
