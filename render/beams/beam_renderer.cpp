#include "render/beams/beam_renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/beams/pixel_coverage.h"
#include "render/gather.h"
#include "render/light_paths.h"
#include "render/threads.h"
#include "stone/errors.h"

namespace culet {

namespace {

// Rows of pixels that one task shades. A fixed number: sums are in the same order whatever the
// number of threads.
constexpr int k_strip = 32;
constexpr int k_pupil_points = 64;
constexpr float k_filled = 1 - 1e-5f;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Points of the unit disc, each for the same area: Vogel's sunflower (1979).
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

struct LeafNumber {
    std::uint32_t branch = 0, leaf = 0;
};

// The beams of one view and one band, and which strips of rows they touch.
struct SortedTree {
    ScreenView view;
    double n = 0;
    BeamLimits limits;
    bool grown = false;
    BeamTree tree;
    std::vector<std::vector<LeafNumber>> strips;

    void sort(int strip_count) {
        strips.resize(static_cast<std::size_t>(strip_count));
        for (auto& strip : strips) strip.clear();
        for (std::size_t b = 0; b < tree.branch_count; ++b) {
            const std::vector<Beam>& leaves = tree.branches[b].leaves;
            for (std::size_t l = 0; l < leaves.size(); ++l) {
                const int first = std::max(leaves[l].first_row / k_strip, 0),
                          last = std::min((leaves[l].end_row - 1) / k_strip, strip_count - 1);
                for (int strip = first; strip <= last; ++strip)
                    strips[static_cast<std::size_t>(strip)].push_back(
                        {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(l)});
            }
        }
    }
};

// What one thread keeps.
struct Desk {
    explicit Desk(int width) : coverage(width) {}
    PixelCoverage coverage;
    std::vector<float> radiance, left, absorbed, share, x, y, cover;
    std::vector<int> pixel;
    std::vector<std::uint8_t> follows;
    std::vector<double> exact;
    PathTrace trace;

    void reserve(int count, int nodes) {
        const std::size_t size = static_cast<std::size_t>(count + k_shading_room);
        if (left.size() < size) {
            left.resize(size);
            absorbed.resize(size);
            share.resize(size);
            follows.resize(size);
        }
        if (radiance.size() < left.size() * static_cast<std::size_t>(nodes))
            radiance.resize(left.size() * static_cast<std::size_t>(nodes));
    }
};

struct StripSums {
    double filled = 0, remainder = 0, absorbed = 0, luminance = 0;
    long long fragments = 0, retraced = 0;
};

}  // namespace

struct BeamRenderer::Work {
    explicit Work(const Solid& solid) : net(solid), stone(net), body(solid) {}

    FacetNet net;
    ShadedStone stone;
    ConvexBody body;
    std::vector<SortedTree> trees;  // view * bands + band
    std::shared_ptr<const EnvironmentMap> map;
    std::shared_ptr<const EnvironmentPyramid> pyramid;
    std::vector<float> planes;  // node * pixels + pixel
    BeamReport report;

    // Of the picture being drawn.
    Picture* picture = nullptr;
    const Plan* plan = nullptr;
    const LightField* lights = nullptr;
    const WavelengthSet* colours = nullptr;
    BeamSettings settings;
    double view_share = 1;
    std::vector<ShadedOptics> optics;
    std::vector<ShadedLights> shaded_lights;
    std::vector<double> luminance_of_node;
    std::vector<std::array<float, 3>> rgb_of_node;
    int nodes = 1, width = 0, height = 0;

    std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    void prepare(const Scene& scene);
    void shade_strip(int strip, const ScreenView& view, std::size_t first_tree, bool first_view,
                     Desk& desk, StripSums& sums);
    void shade_leaf(const SortedTree& tree, LeafNumber number, std::size_t band, int row_begin,
                    int row_end, Desk& desk, StripSums& sums);
    void shade_flat(const ScreenPoint* corners, const Beam& beam, const ShadingJob& job,
                    const ShadedEye& eye, const std::uint16_t* facets, const Band& band,
                    int row_begin, int row_end, Desk& desk, StripSums& sums);
    void shade_pixels(const CoveredPixels& covered, const ScreenView& view, const Beam& beam,
                      const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                      const Band& band, int row_begin, Desk& desk, StripSums& sums);
    bool trace_exactly(const ScreenView& view, const ScreenPoint& at, const Band& band, Desk& desk,
                       double& remainder, double& absorbed) const;
    void fill_holes(const ScreenView& view, int row_begin, int row_end, Desk& desk,
                    StripSums& sums);
    void add_background(const ScreenView& view, int row_begin, int row_end, Desk& desk);
    void develop(int strip);
};

void BeamRenderer::Work::prepare(const Scene& scene) {
    width = scene.camera.width;
    height = scene.camera.height;
    nodes = colours->size();
    if (scene.lights.environment != map) {
        map = scene.lights.environment;
        pyramid = map ? std::make_shared<EnvironmentPyramid>(*map) : nullptr;
    }
    optics.clear();
    shaded_lights.clear();
    for (const Band& band : plan->bands) {
        ShadedOptics o;
        o.n = static_cast<float>(band.n / band.n_outside);
        o.polarised = plan->polarised;
        if (band.absorbs) {
            for (int i = 0; i < band.count; ++i)
                o.absorption.push_back(
                    static_cast<float>(band.absorption[0][static_cast<std::size_t>(i)]));
        }
        optics.push_back(std::move(o));
        shaded_lights.emplace_back(scene.lights, *colours, band.first, band.count, stone.middle,
                                   pyramid);
    }
    luminance_of_node.clear();
    rgb_of_node.clear();
    std::vector<double> one(static_cast<std::size_t>(nodes), 0.0);
    for (double& value : one) {
        value = 1;
        const Rgb rgb = colours->rgb_of(one.data());
        luminance_of_node.push_back(luminance(rgb));
        rgb_of_node.push_back(
            {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])});
        value = 0;
    }
    // The picture's memory is used again.
    planes.resize(static_cast<std::size_t>(nodes) * pixels());
    picture->width = width;
    picture->height = height;
    picture->rgb.resize(3 * pixels());
    picture->coverage.resize(pixels());
    picture->wavelengths_nm.clear();
    picture->spectral.clear();
    report = {};
}

// The reference's way, for a ray that did not meet its beam's facets. False: it misses the stone.
bool BeamRenderer::Work::trace_exactly(const ScreenView& view, const ScreenPoint& at,
                                       const Band& band, Desk& desk, double& remainder,
                                       double& absorbed) const {
    const EyeRay ray{view.origin(at), glm::normalize(view.towards(at))};
    const auto entry = body.entry(ray.origin, ray.direction);
    if (!entry) return false;
    desk.exact.assign(static_cast<std::size_t>(nodes), 0.0);
    if (lights->nearest_distance(ray.origin, ray.direction) < entry->distance) {
        lights->add_radiance(ray.origin, ray.direction, 1, band.first, band.count,
                             desk.exact.data() + band.first);
        remainder = absorbed = 0;
        return true;
    }
    PathLimits limits;
    limits.depth = settings.limits.depth;
    limits.cut_weight = settings.limits.cut_weight;
    limits.polarised = plan->polarised;
    Gather gather(*lights, band, desk.exact.data());
    LightPaths<Gather>(body, band, limits, gather, desk.trace).trace(ray, *entry);
    remainder = (gather.remainder_ + gather.cut_) / band.count;
    absorbed = gather.absorbed_ / band.count;
    return true;
}

// One colour for all of the beam: that of its middle.
void BeamRenderer::Work::shade_flat(const ScreenPoint* corners, const Beam& beam,
                                    const ShadingJob& job, const ShadedEye& eye,
                                    const std::uint16_t* facets, const Band& band, int row_begin,
                                    int row_end, Desk& desk, StripSums& sums) {
    const AreaGrid grid = desk.coverage.areas(corners, beam.corners, row_begin, row_end);
    if (grid.rows == 0) return;
    static const float k_here[k_shading_room] = {};
    float left[k_shading_room], absorbed[k_shading_room];
    desk.reserve(1, band.count);
    Fragments fragments;
    fragments.x = fragments.y = k_here;
    fragments.count = 1;
    fragments.radiance = desk.radiance.data();
    fragments.stride = k_shading_room;
    fragments.left = left;
    fragments.absorbed = absorbed;
    shade_beam(job, eye, facets, beam.facets, fragments);
    ++sums.fragments;
    const bool first_band = band.first == 0;
    float area = 0;
    for (int row = 0; row < grid.rows; ++row) {
        const float* share = grid.row(row);
        const int pixel = (grid.y + row) * width + grid.x;
        float* cover = desk.cover.data() + pixel - row_begin * width;
        for (int i = 0; i < grid.columns; ++i) area += share[i];
        if (first_band) {
            for (int i = 0; i < grid.columns; ++i) cover[i] += share[i];
        }
        for (int node = 0; node < band.count; ++node) {
            float* plane =
                planes.data() + static_cast<std::size_t>(band.first + node) * pixels() + pixel;
            const float value = static_cast<float>(view_share) *
                                desk.radiance[static_cast<std::size_t>(node) * k_shading_room];
            for (int i = 0; i < grid.columns; ++i) plane[i] += value * share[i];
        }
    }
    const double filled = view_share * static_cast<double>(area);
    for (int node = 0; node < band.count; ++node) {
        sums.luminance +=
            luminance_of_node[static_cast<std::size_t>(band.first + node)] * filled *
            static_cast<double>(desk.radiance[static_cast<std::size_t>(node) * k_shading_room]);
    }
    if (first_band) sums.filled += filled;
    sums.remainder += filled * band.count / nodes * static_cast<double>(left[0]);
    sums.absorbed += filled * band.count / nodes * static_cast<double>(absorbed[0]);
}

// Every pixel along the beam's facets.
void BeamRenderer::Work::shade_pixels(const CoveredPixels& covered, const ScreenView& view,
                                      const Beam& beam, const ShadingJob& job, const ShadedEye& eye,
                                      const std::uint16_t* facets, const Band& band, int row_begin,
                                      Desk& desk, StripSums& sums) {
    desk.reserve(covered.count, band.count);
    Fragments fragments;
    fragments.x = covered.x.data();
    fragments.y = covered.y.data();
    fragments.count = covered.count;
    fragments.radiance = desk.radiance.data();
    fragments.stride = static_cast<int>(desk.left.size());
    fragments.left = desk.left.data();
    fragments.absorbed = band.absorbs ? desk.absorbed.data() : nullptr;
    fragments.follows = desk.follows.data();
    fragments.soft = settings.shading == BeamShading::averaged;
    shade_beam(job, eye, facets, beam.facets, fragments);
    sums.fragments += fragments.count;

    // Pixels of which other beams have a part are means of their beams anyway.
    const bool single = settings.shading == BeamShading::single;
    const std::size_t count = static_cast<std::size_t>(covered.count);
    float* share = desk.share.data();
    std::copy_n(covered.share.data(), count, share);
    for (std::size_t i = 0; i < count; ++i) {
        if (desk.follows[i] || covered.share[i] < 1) continue;
        double left = 0, lost = 0;
        const ScreenPoint p{covered.pixel[i] % width + 0.5, covered.pixel[i] / width + 0.5};
        ++sums.retraced;
        if (!trace_exactly(view, p, band, desk, left, lost)) {
            // The pixel's middle misses the stone.
            if (single) share[i] = 0;
            continue;
        }
        for (int node = 0; node < band.count; ++node)
            desk.radiance[static_cast<std::size_t>(node) * desk.left.size() + i] =
                static_cast<float>(desk.exact[static_cast<std::size_t>(band.first + node)]);
        desk.left[i] = static_cast<float>(left);
        desk.absorbed[i] = static_cast<float>(lost);
    }
    for (int node = 0; node < band.count; ++node) {
        float* plane = planes.data() + static_cast<std::size_t>(band.first + node) * pixels();
        const float* radiance =
            desk.radiance.data() + static_cast<std::size_t>(node) * desk.left.size();
        float light = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float seen = radiance[i] * share[i];
            plane[covered.pixel[i]] += static_cast<float>(view_share) * seen;
            light += seen;
        }
        sums.luminance += view_share *
                          luminance_of_node[static_cast<std::size_t>(band.first + node)] *
                          static_cast<double>(light);
    }
    float filled = 0, remainder = 0, absorbed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        filled += share[i];
        remainder += share[i] * desk.left[i];
    }
    if (band.absorbs) {
        for (std::size_t i = 0; i < count; ++i) absorbed += share[i] * desk.absorbed[i];
    }
    if (band.first == 0) {
        float* cover = desk.cover.data();
        for (std::size_t i = 0; i < count; ++i)
            cover[covered.pixel[i] - row_begin * width] += share[i];
        sums.filled += view_share * static_cast<double>(filled);
    }
    const double of_nodes = view_share * band.count / nodes;
    sums.remainder += of_nodes * static_cast<double>(remainder);
    sums.absorbed += of_nodes * static_cast<double>(absorbed);
}

void BeamRenderer::Work::shade_leaf(const SortedTree& sorted, LeafNumber number, std::size_t b,
                                    int row_begin, int row_end, Desk& desk, StripSums& sums) {
    const BeamBranch& branch = sorted.tree.branches[number.branch];
    const Beam& beam = branch.leaves[number.leaf];
    const ScreenPoint* corners = branch.corners.data() + beam.corner;
    const std::uint16_t* facets = branch.facets.data() + beam.facet;
    ScreenPoint middle{0, 0};
    for (int i = 0; i < beam.corners; ++i) {
        middle.x += corners[i].x;
        middle.y += corners[i].y;
    }
    middle.x /= beam.corners;
    middle.y /= beam.corners;
    const Band& band = plan->bands[b];
    const ShadingJob job{&stone, &optics[b], &shaded_lights[b]};
    const ShadedEye eye = shaded_eye(sorted.view, middle, net.plane(facets[0]), stone.middle);
    if (settings.shading == BeamShading::flat) {
        shade_flat(corners, beam, job, eye, facets, band, row_begin, row_end, desk, sums);
        return;
    }
    const CoveredPixels& covered =
        settings.shading == BeamShading::single
            ? desk.coverage.middles(corners, beam.corners, middle, row_begin, row_end)
            : desk.coverage.touched(desk.coverage.areas(corners, beam.corners, row_begin, row_end),
                                    middle);
    if (covered.count > 0)
        shade_pixels(covered, sorted.view, beam, job, eye, facets, band, row_begin, desk, sums);
}

// Middles of pixels that no beam took, next to pixels that one did.
void BeamRenderer::Work::fill_holes(const ScreenView& view, int row_begin, int row_end, Desk& desk,
                                    StripSums& sums) {
    const auto taken = [&](int x, int y) {
        return x >= 0 && x < width && y >= row_begin && y < row_end &&
               desk.cover[static_cast<std::size_t>((y - row_begin) * width + x)] > 0;
    };
    desk.pixel.clear();
    for (int y = row_begin; y < row_end; ++y) {
        for (int x = 0; x < width; ++x) {
            if (taken(x, y) ||
                !(taken(x - 1, y) || taken(x + 1, y) || taken(x, y - 1) || taken(x, y + 1)))
                continue;
            const std::size_t pixel = static_cast<std::size_t>(y * width + x);
            bool meets = true;
            for (std::size_t b = 0; b < plan->bands.size() && meets; ++b) {
                const Band& band = plan->bands[b];
                double left = 0, lost = 0;
                meets = trace_exactly(view, {x + 0.5, y + 0.5}, band, desk, left, lost);
                if (!meets) break;
                for (int node = band.first; node < band.first + band.count; ++node) {
                    const double seen = desk.exact[static_cast<std::size_t>(node)];
                    planes[static_cast<std::size_t>(node) * pixels() + pixel] +=
                        static_cast<float>(view_share * seen);
                    sums.luminance +=
                        view_share * luminance_of_node[static_cast<std::size_t>(node)] * seen;
                }
                sums.remainder += view_share * band.count / nodes * left;
                sums.absorbed += view_share * band.count / nodes * lost;
            }
            if (!meets) continue;
            ++sums.retraced;
            sums.filled += view_share;
            desk.pixel.push_back(static_cast<int>(pixel));
        }
    }
    for (int pixel : desk.pixel)
        desk.cover[static_cast<std::size_t>(pixel - row_begin * width)] = 1;
}

void BeamRenderer::Work::add_background(const ScreenView& view, int row_begin, int row_end,
                                        Desk& desk) {
    const ScreenPoint reference{0.5 * width, 0.5 * (row_begin + row_end)};
    const std::size_t most =
        static_cast<std::size_t>((row_end - row_begin) * width) + k_shading_room;
    desk.x.resize(most);
    desk.y.resize(most);
    desk.pixel.resize(most);
    int count = 0;
    for (int y = row_begin; y < row_end; ++y) {
        const float* cover = desk.cover.data() + (y - row_begin) * width;
        const int row_start = count;
        int* found = desk.pixel.data();
        for (int x = 0; x < width; ++x) {
            found[count] = x;
            count += cover[x] < k_filled;
        }
        const float x0 = static_cast<float>(0.5 - reference.x),
                    y0 = static_cast<float>(y + 0.5 - reference.y);
        for (int i = row_start; i < count; ++i) {
            desk.x[static_cast<std::size_t>(i)] = static_cast<float>(found[i]) + x0;
            desk.y[static_cast<std::size_t>(i)] = y0;
            found[i] += y * width;
        }
    }
    if (count == 0) return;
    const ShadedEye eye = shaded_eye(view, reference, stone.middle);
    for (std::size_t b = 0; b < plan->bands.size(); ++b) {
        const Band& band = plan->bands[b];
        desk.reserve(count, band.count);
        Fragments fragments;
        fragments.x = desk.x.data();
        fragments.y = desk.y.data();
        fragments.count = count;
        fragments.radiance = desk.radiance.data();
        fragments.stride = static_cast<int>(desk.left.size());
        fragments.soft = settings.shading != BeamShading::single;
        shade_background(shaded_lights[b], eye, fragments);
        for (int node = 0; node < band.count; ++node) {
            float* plane = planes.data() + static_cast<std::size_t>(band.first + node) * pixels();
            const float* radiance =
                desk.radiance.data() + static_cast<std::size_t>(node) * desk.left.size();
            for (int i = 0; i < count; ++i) {
                const int pixel = desk.pixel[static_cast<std::size_t>(i)];
                const float bare =
                    1 - desk.cover[static_cast<std::size_t>(pixel - row_begin * width)];
                plane[pixel] += static_cast<float>(view_share) * std::max(bare, 0.0f) *
                                radiance[static_cast<std::size_t>(i)];
            }
        }
    }
}

void BeamRenderer::Work::shade_strip(int strip, const ScreenView& view, std::size_t first_tree,
                                     bool first_view, Desk& desk, StripSums& sums) {
    const int row_begin = strip * k_strip, row_end = std::min(row_begin + k_strip, height);
    const std::size_t begin = static_cast<std::size_t>(row_begin) * static_cast<std::size_t>(width),
                      end = static_cast<std::size_t>(row_end) * static_cast<std::size_t>(width);
    desk.cover.assign(end - begin, 0.0f);
    if (first_view) {
        for (int node = 0; node < nodes; ++node) {
            float* plane = planes.data() + static_cast<std::size_t>(node) * pixels();
            std::fill(plane + begin, plane + end, 0.0f);
        }
        std::fill(picture->coverage.begin() + static_cast<long>(begin),
                  picture->coverage.begin() + static_cast<long>(end), 0.0f);
    }
    for (std::size_t b = 0; b < plan->bands.size(); ++b) {
        const SortedTree& sorted = trees[first_tree + b];
        for (const LeafNumber& number : sorted.strips[static_cast<std::size_t>(strip)])
            shade_leaf(sorted, number, b, row_begin, row_end, desk, sums);
    }
    if (settings.shading == BeamShading::single) fill_holes(view, row_begin, row_end, desk, sums);
    add_background(view, row_begin, row_end, desk);
    for (std::size_t i = begin; i < end; ++i)
        picture->coverage[i] +=
            static_cast<float>(view_share) * std::min(desk.cover[i - begin], 1.0f);
}

// From radiance at the nodes to colour.
void BeamRenderer::Work::develop(int strip) {
    const std::size_t begin = static_cast<std::size_t>(strip * k_strip) *
                              static_cast<std::size_t>(width),
                      end = static_cast<std::size_t>(std::min((strip + 1) * k_strip, height)) *
                            static_cast<std::size_t>(width);
    if (nodes == 1) {
        const float* plane = planes.data();
        for (std::size_t i = begin; i < end; ++i) {
            float* rgb = picture->rgb.data() + 3 * i;
            rgb[0] = rgb[1] = rgb[2] = plane[i];
        }
        return;
    }
    std::fill(picture->rgb.begin() + static_cast<long>(3 * begin),
              picture->rgb.begin() + static_cast<long>(3 * end), 0.0f);
    for (int node = 0; node < nodes; ++node) {
        const float* plane = planes.data() + static_cast<std::size_t>(node) * pixels();
        const auto& weight = rgb_of_node[static_cast<std::size_t>(node)];
        for (std::size_t i = begin; i < end; ++i) {
            float* rgb = picture->rgb.data() + 3 * i;
            for (std::size_t c = 0; c < 3; ++c) rgb[c] += weight[c] * plane[i];
        }
    }
}

BeamRenderer::BeamRenderer(const Solid& convex) : work_(std::make_unique<Work>(convex)) {}
BeamRenderer::~BeamRenderer() = default;

const BeamReport& BeamRenderer::report() const {
    return work_->report;
}

void BeamRenderer::draw(const Scene& scene, const Plan& plan, const LightField& lights,
                        const WavelengthSet& colours, const BeamSettings& settings,
                        Picture& picture, const Progress& progress) {
    Work& work = *work_;
    work.picture = &picture;
    work.plan = &plan;
    work.lights = &lights;
    work.colours = &colours;
    work.settings = settings;
    work.prepare(scene);
    BeamReport& report = work.report;

    std::vector<ScreenView> views;
    if (plan.on(Effects::aperture)) {
        const int points = scene.settings.samples > 0 ? scene.settings.samples : k_pupil_points;
        for (const ScreenPoint& p : pupil_points(points))
            views.push_back(screen_view(scene.camera, p.x, p.y));
    } else {
        Camera pinhole = scene.camera;
        pinhole.aperture_radius = 0;
        views.push_back(screen_view(pinhole));
    }
    work.view_share = 1.0 / static_cast<double>(views.size());
    const std::size_t bands = plan.bands.size();
    work.trees.resize(views.size() * bands);
    const int strips = (work.height + k_strip - 1) / k_strip;
    tbb::enumerable_thread_specific<Desk> desks([&] { return Desk(work.width); });
    StripSums whole;
    double lost = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (progress && !progress(static_cast<double>(v) / static_cast<double>(views.size())))
            throw Interrupted();
        std::vector<StripSums> sums(static_cast<std::size_t>(strips));
        on_threads(settings.threads, [&] {
            const auto building = Clock::now();
            tbb::parallel_for(
                std::size_t{0}, bands,
                [&](std::size_t b) {
                    SortedTree& sorted = work.trees[v * bands + b];
                    const double n = plan.bands[b].n / plan.bands[b].n_outside;
                    if (sorted.grown && sorted.view == views[v] && sorted.n == n &&
                        sorted.limits == settings.limits)
                        return;
                    sorted.grown = false;
                    sorted.view = views[v];
                    sorted.n = n;
                    sorted.limits = settings.limits;
                    build_beams(work.net, views[v], n, settings.limits, sorted.tree);
                    sorted.sort(strips);
                    sorted.grown = true;
                },
                tbb::simple_partitioner());
            report.seconds_build += seconds_since(building);
            const auto shading = Clock::now();
            tbb::parallel_for(
                0, strips,
                [&](int strip) {
                    work.shade_strip(strip, views[v], v * bands, v == 0, desks.local(),
                                     sums[static_cast<std::size_t>(strip)]);
                    if (v + 1 == views.size()) work.develop(strip);
                },
                tbb::simple_partitioner());
            report.seconds_shade += seconds_since(shading);
        });
        for (const StripSums& sum : sums) {
            whole.filled += sum.filled;
            whole.remainder += sum.remainder;
            whole.absorbed += sum.absorbed;
            whole.luminance += sum.luminance;
            whole.fragments += sum.fragments;
            whole.retraced += sum.retraced;
        }
        for (std::size_t b = 0; b < bands; ++b) {
            const BeamTree& tree = work.trees[v * bands + b].tree;
            report.beams += tree.beams();
            report.deepest = std::max(report.deepest, tree.deepest());
            if (tree.front_area > 0) lost += (tree.front_area - tree.leaf_area()) / tree.front_area;
        }
    }
    report.fragments = whole.fragments;
    report.retraced = whole.retraced;
    report.filled = whole.filled;
    report.lost_area = lost / static_cast<double>(views.size() * bands);
    if (whole.filled > 0) {
        report.remainder = whole.remainder / whole.filled;
        report.absorbed = whole.absorbed / whole.filled;
        report.luminance = whole.luminance / whole.filled;
    }
    if (scene.settings.spectral) {
        picture.wavelengths_nm = plan.wavelengths_nm;
        for (int node = 0; node < work.nodes; ++node) {
            const float* plane =
                work.planes.data() + static_cast<std::size_t>(node) * work.pixels();
            picture.spectral.emplace_back(plane, plane + work.pixels());
        }
    }
}

}  // namespace culet
