#include "render/beams/strip_painter.h"

#include <algorithm>

namespace culet {

namespace {

constexpr float k_filled = 1 - 1e-5f;

}  // namespace

StripSums& StripSums::operator+=(const StripSums& more) {
    filled += more.filled;
    remainder += more.remainder;
    absorbed += more.absorbed;
    luminance += more.luminance;
    fragments += more.fragments;
    retraced += more.retraced;
    beams += more.beams;
    deepest = std::max(deepest, more.deepest);
    return *this;
}

void StripPainter::reserve(int count, int nodes) {
    const std::size_t size = static_cast<std::size_t>(count + k_shading_room);
    if (left_.size() < size) {
        left_.resize(size);
        absorbed_.resize(size);
        unhidden_.resize(size);
        share_.resize(size);
        follows_.resize(size);
    }
    if (radiance_.size() < left_.size() * static_cast<std::size_t>(nodes)) {
        radiance_.resize(left_.size() * static_cast<std::size_t>(nodes));
        before_.resize(radiance_.size());
    }
}

// One colour for all of the beam: that of its middle.
void StripPainter::paint_flat(const ScreenPoint* corners, const Beam& beam,
                              const std::uint16_t* facets, const ShadedEye& eye,
                              const ShadingPass& pass) {
    const AreaGrid grid = coverage_.areas(corners, beam.corners, row_begin_, row_end_);
    if (grid.rows == 0) return;
    static const float k_here[k_shading_room] = {};
    const int nodes = pass.lights.nodes;
    reserve(1, nodes);
    Fragments fragments;
    fragments.x = fragments.y = k_here;
    fragments.count = 1;
    fragments.radiance = radiance_.data();
    fragments.stride = k_shading_room;
    fragments.left = left_.data();
    fragments.absorbed = absorbed_.data();
    fragments.soft = options_.shading == BeamShading::averaged;
    if (hides_) {
        fragments.unhidden = unhidden_.data();
        fragments.before = before_.data();
    }
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets, beam.facets, fragments);
    ++sums_.fragments;
    const float unhidden = hides_ ? unhidden_[0] : 1.0f;
    float area = 0;
    for (int row = 0; row < grid.rows; ++row) {
        const float* share = grid.row(row);
        const int pixel = (grid.y + row) * canvas_.width + grid.x;
        for (int i = 0; i < grid.columns; ++i) area += share[i];
        if (pass.counts_area) {
            for (int i = 0; i < grid.columns; ++i) add_cover(pixel + i, share[i], unhidden);
        }
        for (int node = 0; node < nodes; ++node) {
            float* to = plane(pass, node) + pixel;
            const std::size_t of_node = static_cast<std::size_t>(node * k_shading_room);
            const float value = static_cast<float>(options_.share) *
                                (radiance_[of_node] + (hides_ ? before_[of_node] : 0.0f));
            for (int i = 0; i < grid.columns; ++i) to[i] += value * share[i];
        }
    }
    const double filled = options_.share * static_cast<double>(area);
    for (int node = 0; node < nodes; ++node) {
        sums_.luminance +=
            pass.luminance[static_cast<std::size_t>(node)] * filled *
            static_cast<double>(radiance_[static_cast<std::size_t>(node * k_shading_room)]);
    }
    if (pass.counts_area) sums_.filled += filled * static_cast<double>(unhidden);
    sums_.remainder += filled * pass.weight * nodes * static_cast<double>(left_[0]);
    sums_.absorbed += filled * pass.weight * nodes * static_cast<double>(absorbed_[0]);
}

// A ray along the facets that it does meet. False: it misses the stone.
bool StripPainter::retrace(int pixel, const ShadingPass& pass, std::size_t longest, float* radiance,
                           int stride, float& left, float& absorbed, float& unhidden,
                           float* before) {
    const ScreenPoint at{pixel % canvas_.width + 0.5, pixel / canvas_.width + 0.5};
    find_facets(stone_.body, *view_, at, pass.n, options_.depth,
                longest > 0 ? 0.0 : options_.cut_weight, facets_);
    if (facets_.empty()) return false;
    if (longest > 0 && facets_.size() > longest) facets_.resize(longest);
    const ShadedEye eye =
        shaded_eye(*view_, at, stone_.net.plane(facets_[0]), stone_.shaded.middle);
    static const float k_here[k_shading_room] = {};
    const int nodes = pass.lights.nodes;
    std::vector<float> seen(static_cast<std::size_t>(nodes * k_shading_room)), nearer(seen);
    float lefts[k_shading_room], lost[k_shading_room], bare[k_shading_room];
    Fragments fragments;
    fragments.x = fragments.y = k_here;
    fragments.count = 1;
    fragments.radiance = seen.data();
    fragments.stride = k_shading_room;
    fragments.left = lefts;
    fragments.absorbed = lost;
    if (hides_) {
        fragments.unhidden = bare;
        fragments.before = nearer.data();
    }
    fragments.soft = options_.shading == BeamShading::averaged;
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets_.data(),
               static_cast<int>(facets_.size()), fragments);
    for (int node = 0; node < nodes; ++node) {
        radiance[node * stride] = seen[static_cast<std::size_t>(node * k_shading_room)];
        before[node * stride] = nearer[static_cast<std::size_t>(node * k_shading_room)];
    }
    left = lefts[0];
    absorbed = lost[0];
    unhidden = hides_ ? bare[0] : 1.0f;
    ++sums_.retraced;
    return true;
}

// Every pixel along the beam's facets.
void StripPainter::paint_pixels(const CoveredPixels& covered, const Beam& beam,
                                const std::uint16_t* facets, const ShadedEye& eye,
                                const ShadingPass& pass) {
    const int nodes = pass.lights.nodes;
    const std::size_t count = static_cast<std::size_t>(covered.count);
    reserve(covered.count, nodes);
    Fragments fragments;
    fragments.x = covered.x.data();
    fragments.y = covered.y.data();
    fragments.count = covered.count;
    fragments.radiance = radiance_.data();
    fragments.stride = static_cast<int>(left_.size());
    fragments.left = left_.data();
    fragments.absorbed = absorbed_.data();
    if (hides_) {
        fragments.unhidden = unhidden_.data();
        fragments.before = before_.data();
    }
    fragments.follows = follows_.data();
    fragments.soft = options_.shading == BeamShading::averaged;
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets, beam.facets, fragments);
    sums_.fragments += covered.count;

    float* share = share_.data();
    std::copy_n(covered.share.data(), count, share);
    if (options_.shading == BeamShading::single) {
        // Where rounding gives a pixel's middle to two beams, the first has it.
        for (std::size_t i = 0; i < count; ++i) {
            std::uint8_t& taken =
                taken_[static_cast<std::size_t>(covered.pixel[i] - row_begin_ * canvas_.width)];
            if (taken) share[i] = 0;
            taken = 1;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        // Pixels of which other beams have a part are means of their beams anyway.
        if (follows_[i] || share[i] < 1) continue;
        if (!retrace(covered.pixel[i], pass, beam.facets, radiance_.data() + i, fragments.stride,
                     left_[i], absorbed_[i], unhidden_[i], before_.data() + i) &&
            options_.shading == BeamShading::single)
            share[i] = 0;  // the pixel's middle misses the stone
    }
    const float of_picture = static_cast<float>(options_.share);
    for (int node = 0; node < nodes; ++node) {
        float* to = plane(pass, node);
        const float* radiance = radiance_.data() + node * fragments.stride;
        float light = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float seen = radiance[i] * share[i];
            to[covered.pixel[i]] += of_picture * seen;
            light += seen;
        }
        if (hides_) {
            const float* before = before_.data() + node * fragments.stride;
            for (std::size_t i = 0; i < count; ++i)
                to[covered.pixel[i]] += of_picture * before[i] * share[i];
        }
        sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                           static_cast<double>(light);
    }
    if (!hides_) std::fill_n(unhidden_.data(), count, 1.0f);
    float filled = 0, remainder = 0, absorbed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        filled += share[i] * unhidden_[i];
        remainder += share[i] * left_[i];
        absorbed += share[i] * absorbed_[i];
    }
    if (pass.counts_area) {
        for (std::size_t i = 0; i < count; ++i) add_cover(covered.pixel[i], share[i], unhidden_[i]);
        sums_.filled += options_.share * static_cast<double>(filled);
    }
    const double of_sums = options_.share * pass.weight * nodes;
    sums_.remainder += of_sums * static_cast<double>(remainder);
    sums_.absorbed += of_sums * static_cast<double>(absorbed);
}

void StripPainter::paint_beam(const SortedBeams& beams, LeafNumber number,
                              const ShadingPass& pass) {
    const BeamBranch& branch = beams.tree.branches[number.branch];
    const Beam& beam = branch.leaves[number.leaf];
    const ScreenPoint* corners = branch.corners.data() + beam.corner;
    const std::uint16_t* facets = branch.facets.data() + beam.facet;
    const bool flat = options_.shading == BeamShading::flat ||
                      (options_.shading == BeamShading::averaged && beam.alone);
    ScreenPoint middle{0, 0};
    if (flat) {
        middle = middle_of(corners, beam.corners);
    } else {
        for (int i = 0; i < beam.corners; ++i) {
            middle.x += corners[i].x / beam.corners;
            middle.y += corners[i].y / beam.corners;
        }
    }
    const ShadedEye eye =
        shaded_eye(*view_, middle, stone_.net.plane(facets[0]), stone_.shaded.middle);
    if (flat) {
        paint_flat(corners, beam, facets, eye, pass);
        return;
    }
    const CoveredPixels& covered =
        options_.shading == BeamShading::single
            ? coverage_.middles(corners, beam.corners, middle, row_begin_, row_end_)
            : coverage_.touched(coverage_.areas(corners, beam.corners, row_begin_, row_end_),
                                middle);
    if (covered.count > 0) paint_pixels(covered, beam, facets, eye, pass);
}

// Middles of pixels that no beam took, next to pixels that one did.
void StripPainter::fill_holes(const std::vector<ShadingPass>& passes) {
    const int width = canvas_.width;
    const auto taken = [&](int x, int y) {
        return x >= 0 && x < width && y >= row_begin_ && y < row_end_ &&
               taken_[static_cast<std::size_t>((y - row_begin_) * width + x)];
    };
    pixel_.clear();
    for (int y = row_begin_; y < row_end_; ++y) {
        for (int x = 0; x < width; ++x) {
            if (!taken(x, y) &&
                (taken(x - 1, y) || taken(x + 1, y) || taken(x, y - 1) || taken(x, y + 1)))
                pixel_.push_back(y * width + x);
        }
    }
    for (int pixel : pixel_) {
        for (const ShadingPass& pass : passes) {
            const int nodes = pass.lights.nodes;
            reserve(1, nodes);
            float left = 0, absorbed = 0, unhidden = 1;
            if (!retrace(pixel, pass, 0, radiance_.data(), 1, left, absorbed, unhidden,
                         before_.data()))
                break;
            for (int node = 0; node < nodes; ++node) {
                const float seen = radiance_[static_cast<std::size_t>(node)];
                plane(pass, node)[pixel] += static_cast<float>(options_.share) *
                                            (seen + before_[static_cast<std::size_t>(node)]);
                sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                                   static_cast<double>(seen);
            }
            const double of_sums = options_.share * pass.weight * nodes;
            sums_.remainder += of_sums * static_cast<double>(left);
            sums_.absorbed += of_sums * static_cast<double>(absorbed);
            if (!pass.counts_area) continue;
            add_cover(pixel, 1, unhidden);
            sums_.filled += options_.share * static_cast<double>(unhidden);
        }
    }
}

void StripPainter::add_background(const std::vector<ShadingPass>& passes) {
    const int width = canvas_.width;
    const ScreenPoint reference{0.5 * width, 0.5 * (row_begin_ + row_end_)};
    const std::size_t most =
        static_cast<std::size_t>((row_end_ - row_begin_) * width) + k_shading_room;
    x_.resize(most);
    y_.resize(most);
    pixel_.resize(most);
    int count = 0;
    for (int y = row_begin_; y < row_end_; ++y) {
        const float* covered = &cover(y * width);
        const int row_start = count;
        int* found = pixel_.data();
        for (int x = 0; x < width; ++x) {
            found[count] = x;
            count += covered[x] < k_filled;
        }
        const float x0 = static_cast<float>(0.5 - reference.x),
                    y0 = static_cast<float>(y + 0.5 - reference.y);
        for (int i = row_start; i < count; ++i) {
            x_[static_cast<std::size_t>(i)] = static_cast<float>(found[i]) + x0;
            y_[static_cast<std::size_t>(i)] = y0;
            found[i] += y * width;
        }
    }
    if (count == 0) return;
    const ShadedEye eye = shaded_eye(*view_, reference, stone_.shaded.middle);
    for (const ShadingPass& pass : passes) {
        reserve(count, pass.lights.nodes);
        Fragments fragments;
        fragments.x = x_.data();
        fragments.y = y_.data();
        fragments.count = count;
        fragments.radiance = radiance_.data();
        fragments.stride = static_cast<int>(left_.size());
        fragments.soft = options_.shading != BeamShading::single;
        shade_background(pass.lights, pass.optics, eye, fragments);
        for (int node = 0; node < pass.lights.nodes; ++node) {
            float* to = plane(pass, node);
            const float* radiance = radiance_.data() + node * fragments.stride;
            for (int i = 0; i < count; ++i) {
                const int pixel = pixel_[static_cast<std::size_t>(i)];
                const float bare = std::max(1 - cover(pixel), 0.0f);
                to[pixel] += static_cast<float>(options_.share) * bare * radiance[i];
            }
        }
    }
}

StripSums StripPainter::paint(int strip, const ScreenView& view, const SortedBeams* beams,
                              const std::vector<FrontFacet>& fronts,
                              const std::vector<ShadingPass>& passes, const PaintOptions& options) {
    view_ = &view;
    options_ = options;
    coverage_.set_width(canvas_.width);
    row_begin_ = strip * k_strip;
    row_end_ = std::min(row_begin_ + k_strip, canvas_.height);
    sums_ = {};
    const std::size_t begin = static_cast<std::size_t>(row_begin_) *
                              static_cast<std::size_t>(canvas_.width),
                      count = static_cast<std::size_t>(row_end_ - row_begin_) *
                              static_cast<std::size_t>(canvas_.width);
    cover_.assign(count, 0.0f);
    hides_ =
        !passes.empty() && !(passes[0].lights.spheres.empty() && passes[0].lights.planes.empty());
    if (hides_) visible_.assign(count, 0.0f);
    bool parted = false;
    for (const ShadingPass& pass : passes) {
        if (pass.parted) {
            parted = true;
            paint_parted(fronts, pass);
            continue;
        }
        if (options.shading == BeamShading::single) taken_.assign(count, 0);
        const SortedBeams& sorted = beams[pass.beams];
        for (const LeafNumber& number : sorted.strips[static_cast<std::size_t>(strip)])
            paint_beam(sorted, number, pass);
    }
    if (options.shading == BeamShading::single && !parted) fill_holes(passes);
    add_background(passes);
    const float share = static_cast<float>(options.share);
    const float* seen = hides_ ? visible_.data() : cover_.data();
    for (std::size_t i = 0; i < count; ++i)
        canvas_.coverage[begin + i] += share * std::min(seen[i], 1.0f);
    return sums_;
}

}  // namespace culet
