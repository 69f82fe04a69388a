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

std::vector<ScreenView> views_of(const Scene& scene, const OpticalSetup& setup) {
    if (setup.on(Effects::aperture))
        return pupil_views(scene.camera,
                           scene.settings.samples > 0 ? scene.settings.samples : k_pupil_points);
    Camera pinhole = scene.camera;
    pinhole.aperture_radius = 0;
    return {screen_view(pinhole)};
}

std::size_t strips_of(int rows) {
    return static_cast<std::size_t>((rows + k_strip - 1) / k_strip);
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
    std::size_t first_pixel(int strip) const {
        return static_cast<std::size_t>(std::min(strip * k_strip, canvas.height)) *
               static_cast<std::size_t>(canvas.width);
    }
    void clear(int strip);
    void develop(int strip, Picture& picture) const;
    void prepare(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                 std::size_t planes, Picture& picture, Listener& listener);
    void keep_spectra(const Scene& scene, const OpticalSetup& setup, Picture& picture) const;

    struct Drawing;
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
    const std::size_t begin = first_pixel(strip), count = first_pixel(strip + 1) - begin;
    for (std::size_t p = 0; p < rgb_of_plane.size(); ++p)
        std::fill_n(canvas.planes.data() + p * canvas.pixels() + begin, count, 0.0f);
    std::fill_n(canvas.coverage.data() + begin, count, 0.0f);
}

void BeamRenderer::Work::develop(int strip, Picture& picture) const {
    const std::size_t begin = first_pixel(strip), end = first_pixel(strip + 1);
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

// What the steps of one drawing share.
struct BeamRenderer::Work::Drawing {
    Work& work;
    const Scene& scene;
    const OpticalSetup& setup;
    const BeamSettings& settings;
    Picture& picture;
    Listener& listener;
    const std::vector<ScreenView>& views;
    std::vector<ShadingPass> passes;
    std::vector<std::size_t> leader;  // of each band (shading_passes.h)
    WorkMeter* meter = scene.settings.meter.get();
    BeamReport& report = work.report;
    StripSums whole = {};
    double lost = 0;
    int trees = 0;

    SortedBeams* beams_of(std::size_t view) { return &work.beams[view * setup.bands.size()]; }
    bool may_spend(double ns) const {
        return listener.still_goes_on() && (meter == nullptr || !(ns > meter->left()));
    }

    void draw(std::size_t view) {
        std::vector<StripSums> sums(strips_of(scene.camera.height));
        const std::vector<FrontFacet> fronts = front_facets(work.stone.net, views[view]);
        on_threads(settings.threads, [&] {
            const auto building = Clock::now();
            tbb::parallel_for(
                std::size_t{0}, setup.bands.size(), [&](std::size_t band) { grow(view, band); },
                tbb::simple_partitioner());
            report.seconds_build += seconds_from(building);
            const auto shading = Clock::now();
            tbb::parallel_for(
                std::size_t{0}, sums.size(),
                [&](std::size_t strip) {
                    if (!listener.goes_on() || (meter != nullptr && meter->over())) return;
                    sums[strip] = paint(view, static_cast<int>(strip), fronts);
                },
                tbb::simple_partitioner());
            report.seconds_shade += seconds_from(shading);
        });
        if (listener.stopped()) throw Interrupted();
        if (meter != nullptr) meter->require_not_over();
        for (const StripSums& sum : sums) whole += sum;
        if (settings.crystal == CrystalBeams::merged || !setup.splits) count_trees(view);
    }

    void grow(std::size_t view, std::size_t number) {
        const Band& band = setup.bands[number];
        if (band.two_waves && settings.crystal == CrystalBeams::split) return;
        if (leader[number] != number) return;
        SortedBeams& beams = beams_of(view)[number];
        beams.grow(
            work.stone.net, views[view], band.n / band.n_outside, settings.limits,
            [&](long long grown) { return may_spend(price_ns(DrawnBeams{.grown = grown})); });
        if (meter != nullptr)
            meter->spend(price_ns(DrawnBeams{.grown = beams.tree.discarded + beams.tree.grown(),
                                             .walked = beams.tree.faces()}));
    }

    StripSums paint(std::size_t view, int strip, const std::vector<FrontFacet>& fronts) {
        if (view == 0) work.clear(strip);
        PaintOptions options;
        options.shading = settings.shading;
        options.depth = settings.limits.depth;
        options.cut_weight = settings.limits.cut_weight;
        options.share = 1.0 / static_cast<double>(views.size());
        // Count work while painting, as a strip may take seconds.
        double spent = 0;
        options.goes_on = [&](const StripSums& sum) {
            const double before = spent;
            spent = std::floor(price_ns(DrawnBeams{.split = sum.beams,
                                                   .fragments = sum.fragments,
                                                   .faces = sum.faces,
                                                   .nodes = passes[0].lights.nodes}));
            if (meter != nullptr) meter->spend(spent - before);
            return may_spend(0);
        };
        const StripSums sum = work.painters.local().paint(strip, views[view], beams_of(view),
                                                          fronts, passes, options);
        options.goes_on(sum);
        if (view + 1 == views.size()) work.develop(strip, picture);
        return sum;
    }

    void count_trees(std::size_t view) {
        for (std::size_t band = 0; band < setup.bands.size(); ++band) {
            if (leader[band] != band) continue;
            const BeamTree& tree = beams_of(view)[band].tree;
            report.beams += tree.grown();
            report.deepest = std::max(report.deepest, tree.deepest());
            if (!(tree.front_area > 0)) continue;
            lost += (tree.front_area - tree.exit_area()) / tree.front_area;
            ++trees;
        }
    }

    void fill_report() {
        report.fragments = whole.fragments;
        report.beams += whole.beams;
        report.deepest = std::max(report.deepest, whole.deepest);
        report.retraced = whole.retraced;
        report.filled = whole.filled;
        report.lost_area = trees > 0 ? lost / trees : 0;
        if (!(whole.filled > 0)) return;
        report.remainder = whole.remainder / whole.filled;
        report.absorbed = whole.absorbed / whole.filled;
        report.luminance = whole.luminance / whole.filled;
    }
};

void BeamRenderer::draw(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                        const BeamSettings& settings, Picture& picture, const Progress& progress) {
    Work& work = *work_;
    const int stokes = setup.stokes && scene.settings.spectral ? 4 : 1;
    const std::vector<ScreenView> views = views_of(scene, setup);
    Listener listener(progress, static_cast<double>(views.size() * strips_of(scene.camera.height)));
    work.prepare(scene, setup, colours,
                 static_cast<std::size_t>(stokes) * setup.wavelengths_nm.size(), picture, listener);
    const Vec3& middle = work.stone.shaded.middle;
    Work::Drawing drawing{
        work,
        scene,
        setup,
        settings,
        picture,
        listener,
        views,
        shading_passes(scene, setup, colours, middle, work.pyramid, stokes,
                       settings.crystal == CrystalBeams::split),
        shared_beams(setup, views[0], middle, work.stone.net.size(), settings.limits)};
    for (ShadingPass& pass : drawing.passes) pass.beams = drawing.leader[pass.beams];
    work.report = {};
    work.beams.resize(views.size() * setup.bands.size());
    for (std::size_t view = 0; view < views.size(); ++view) drawing.draw(view);
    drawing.fill_report();
    std::swap(picture.coverage, work.canvas.coverage);
    if (scene.settings.spectral) work.keep_spectra(scene, setup, picture);
}

}  // namespace culet
