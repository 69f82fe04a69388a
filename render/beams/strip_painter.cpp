#include "render/beams/strip_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/setup/built_effects.h"

namespace culet {

namespace {

// False for points outside by more than rounding.
bool may_be_within(const std::vector<ScreenPoint>& outline, const ScreenPoint& p) {
    constexpr double k_rounding = 1e-6;  // pixels
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const double dx = outline[i].x - outline[j].x, dy = outline[i].y - outline[j].y;
        if (dx * (p.y - outline[j].y) - dy * (p.x - outline[j].x) <
            -k_rounding * (std::abs(dx) + std::abs(dy)))
            return false;
    }
    return true;
}

Fragments rest_of(const Fragments& all, int first, int count) {
    Fragments rest = all;
    rest.verified = nullptr;
    rest.count = count - first;
    rest.x += first;
    rest.y += first;
    if (rest.xx != nullptr) {
        rest.xx += first;
        rest.yx += first;
        rest.yy += first;
    }
    rest.radiance += first;
    rest.left += first;
    rest.absorbed += first;
    if (rest.unhidden != nullptr) {
        rest.unhidden += first;
        rest.before += first;
    }
    return rest;
}

// Beams painted between questions whether to go on.
constexpr std::size_t k_asked_every = 16;
// Borders of sure beams are off by at most half of this.
constexpr double k_margin = 0.5;  // pixels

}  // namespace

StripSums& StripSums::operator+=(const StripSums& more) {
    filled += more.filled;
    remainder += more.remainder;
    absorbed += more.absorbed;
    luminance += more.luminance;
    fragments += more.fragments;
    faces += more.faces;
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
        verified_.resize(size);
    }
    if (radiance_.size() < left_.size() * static_cast<std::size_t>(nodes)) {
        radiance_.resize(left_.size() * static_cast<std::size_t>(nodes));
        before_.resize(radiance_.size());
    }
}

// Paints a beam in the colour of its middle.
void StripPainter::paint_flat(const CoveredPixels& covered, const Beam& beam,
                              const std::uint16_t* facets, const ShadedEye& eye,
                              const ShadingPass& pass) {
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
    if (hides_) {
        fragments.unhidden = unhidden_.data();
        fragments.before = before_.data();
    }
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets, beam.facets, fragments);
    ++sums_.fragments;
    sums_.faces += beam.facets;
    const float *shares = covered.share.data(), unhidden = hides_ ? unhidden_[0] : 1.0f;
    const double filled =
        options_.share * static_cast<double>(sum_of_shared(nullptr, shares, covered.count));
    for (int node = 0; node < nodes; ++node) {
        const std::size_t of_node = static_cast<std::size_t>(node * k_shading_room);
        const float value = radiance_[of_node] + (hides_ ? before_[of_node] : 0.0f);
        add_to_runs(covered.runs, nullptr, shares, static_cast<float>(options_.share) * value,
                    plane(pass, node));
        sums_.luminance += pass.luminance[static_cast<std::size_t>(node)] * filled *
                           static_cast<double>(radiance_[of_node]);
    }
    if (pass.counts_area) {
        add_to_runs(covered.runs, nullptr, shares, 1, strip(cover_));
        if (hides_) add_to_runs(covered.runs, nullptr, shares, unhidden, strip(visible_));
        sums_.filled += filled * static_cast<double>(unhidden);
    }
    sums_.remainder += filled * pass.weight * nodes * static_cast<double>(left_[0]);
    sums_.absorbed += filled * pass.weight * nodes * static_cast<double>(absorbed_[0]);
}

// Shades a ray along the facets that it actually meets. False if it misses the stone.
bool StripPainter::retrace(int pixel, const ShadingPass& pass, std::size_t longest, float* radiance,
                           int stride, float& left, float& absorbed, float& unhidden,
                           float* before) {
    const ScreenPoint at{pixel % canvas_.width + 0.5, pixel / canvas_.width + 0.5};
    // As many facets as its beam has; else all that matter.
    const bool as_beam = longest > 0;
    find_facets(stone_.body, *view_, at, pass.n,
                as_beam ? static_cast<int>(longest) : options_.depth,
                as_beam ? 0.0 : options_.cut_weight, facets_);
    if (facets_.empty()) return false;
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

// Prepares fragments, with outputs for the radiance only.
Fragments StripPainter::fragments_of(const CoveredPixels& covered, const ShadingPass& pass) {
    const int nodes = pass.lights.nodes;
    reserve(covered.count, nodes);
    Fragments fragments;
    fragments.x = covered.x.data();
    fragments.y = covered.y.data();
    fragments.soft = options_.shading != BeamShading::single;
    if (fragments.soft && pass.lights.any_edge) {
        fragments.xx = covered.xx.data();
        fragments.yx = covered.yx.data();
        fragments.yy = covered.yy.data();
        fragments.corners = covered.corners;
        fragments.corner_count = covered.corner_count;
        fragments.reference = covered.reference;
    }
    fragments.count = covered.count;
    fragments.radiance = radiance_.data();
    fragments.stride = static_cast<int>(left_.size());
    return fragments;
}

// Adds the radiance found last; with `before` also that of lights in front of the stone.
void StripPainter::add_light(const CoveredPixels& covered, const float* shares,
                             const ShadingPass& pass, bool before) {
    const float of_picture = static_cast<float>(options_.share);
    const int stride = static_cast<int>(left_.size());
    for (int node = 0; node < pass.lights.nodes; ++node) {
        const float* radiance = radiance_.data() + node * stride;
        add_to_runs(covered.runs, radiance, shares, of_picture, plane(pass, node));
        if (before)
            add_to_runs(covered.runs, before_.data() + node * stride, shares, of_picture,
                        plane(pass, node));
        sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                           static_cast<double>(sum_of_shared(radiance, shares, covered.count));
    }
}

// `unhidden`: visible share of each pixel's part; null: all.
void StripPainter::add_cover(const CoveredPixels& covered, const float* shares,
                             const float* unhidden) {
    add_to_runs(covered.runs, nullptr, shares, 1, strip(cover_));
    if (hides_) add_to_runs(covered.runs, unhidden, shares, 1, strip(visible_));
    sums_.filled +=
        options_.share * static_cast<double>(sum_of_shared(unhidden, shares, covered.count));
}

// Shades every pixel along the beam's facets and verifies the first `to_verify`.
void StripPainter::paint_pixels(const CoveredPixels& covered, const Beam& beam, int to_verify,
                                const std::uint16_t* facets, const ShadedEye& eye,
                                const ShadingPass& pass) {
    const int nodes = pass.lights.nodes;
    Fragments fragments = fragments_of(covered, pass);
    fragments.left = left_.data();
    fragments.absorbed = absorbed_.data();
    if (hides_) {
        fragments.unhidden = unhidden_.data();
        fragments.before = before_.data();
    }
    const ShadingJob job{&stone_.shaded, &pass.optics, &pass.lights};
    const int verified = std::min(to_verify, covered.count);
    if (verified > 0) {
        fragments.count = verified;
        fragments.verified = verified_.data();
        shade_beam(job, eye, facets, beam.facets, fragments);
    }
    if (verified < covered.count)
        shade_beam(job, eye, facets, beam.facets, rest_of(fragments, verified, covered.count));
    sums_.fragments += covered.count;
    sums_.faces += static_cast<long long>(beam.facets) * ((covered.count + 7) / 8);

    const float* share = covered.share.data();
    if (options_.shading == BeamShading::single) {
        // If rounding puts a pixel's middle into two beams, the first takes it.
        std::copy_n(covered.share.data(), covered.count, share_.data());
        claim_runs(covered.runs, strip(taken_), share_.data());
        share = share_.data();
    }
    if (any_unmarked_whole(verified_.data(), share, verified))
        retrace_astray(covered, verified, beam, pass, share);
    add_light(covered, share, pass, hides_);
    if (pass.counts_area) add_cover(covered, share, hides_ ? unhidden_.data() : nullptr);
    const double of_sums = options_.share * pass.weight * nodes;
    sums_.remainder +=
        of_sums * static_cast<double>(sum_of_shared(left_.data(), share, covered.count));
    if (k_has_effects && pass.optics.absorbs())
        sums_.absorbed +=
            of_sums * static_cast<double>(sum_of_shared(absorbed_.data(), share, covered.count));
}

// Retraces whole pixels whose rays meet other facets than the beam's.
void StripPainter::retrace_astray(const CoveredPixels& covered, int verified, const Beam& beam,
                                  const ShadingPass& pass, const float* share) {
    const int stride = static_cast<int>(left_.size());
    for (const PixelRun& run : covered.runs) {
        for (int k = 0; k < run.count; ++k) {
            const std::size_t i = static_cast<std::size_t>(run.first + k);
            if (run.first + k >= verified || verified_[i] > 0 || share[i] < 1) continue;
            if (!retrace(run.pixel + k, pass, beam.facets, radiance_.data() + i, stride, left_[i],
                         absorbed_[i], unhidden_[i], before_.data() + i) &&
                options_.shading == BeamShading::single)
                share_[i] = 0;  // misses the stone
        }
    }
}

void StripPainter::paint_beam(const SortedBeams& beams, BeamNumber number,
                              const ShadingPass& pass) {
    const BeamBranch& branch = beams.tree.branches[number.branch];
    const Beam& beam = branch.beams[number.beam];
    const ScreenPoint* corners = branch.corners.data() + beam.corner;
    const std::uint16_t* facets = branch.facets.data() + beam.facet;
    const bool flat = options_.shading == BeamShading::flat;
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
    // In sure beams, rays half a pixel inside need no verification. With anti-aliasing all whole
    // pixels lie that deep; others are averages over beams anyway.
    const bool sure = beam.sure && beams.n == pass.n;
    const bool single = options_.shading == BeamShading::single;
    const CoveredPixels& covered =
        single ? coverage_.middles(corners, beam.corners, middle, row_begin_, row_end_,
                                   sure ? k_margin : std::numeric_limits<double>::infinity())
               : coverage_.areas(corners, beam.corners, middle, row_begin_, row_end_,
                                 !flat && pass.lights.any_edge);
    if (covered.count == 0) return;
    if (flat) {
        paint_flat(covered, beam, facets, eye, pass);
    } else {
        // With anti-aliasing, a beam that follows its middle ray alone is not verified.
        const bool looked_at = single || !(sure || beam.follows_middle_ray);
        paint_pixels(covered, beam, looked_at ? covered.near_border : 0, facets, eye, pass);
    }
}

// Retraces pixels that no beam took, next to pixels that one did.
void StripPainter::fill_holes(const std::vector<FrontFacet>& fronts,
                              const std::vector<ShadingPass>& passes) {
    const int width = canvas_.width;
    holes_.clear();
    find_gaps(strip(taken_), width, row_end_ - row_begin_, holes_);
    std::erase_if(holes_, [&](int pixel) {
        const ScreenPoint middle{pixel % width + 0.5, pixel / width + 0.5};
        return std::none_of(fronts.begin(), fronts.end(), [&](const FrontFacet& front) {
            return may_be_within(front.outline, middle);
        });
    });
    for (int pixel : holes_) {
        for (const ShadingPass& pass : passes) {
            const int nodes = pass.lights.nodes;
            reserve(1, nodes);
            float left = 0, absorbed = 0, unhidden = 1;
            if (!retrace(pixel, pass, 0, radiance_.data(), 1, left, absorbed, unhidden,
                         before_.data()))
                break;
            for (int node = 0; node < nodes; ++node) {
                const float seen = radiance_[static_cast<std::size_t>(node)];
                plane(pass, node).values[pixel] += static_cast<float>(options_.share) *
                                                   (seen + before_[static_cast<std::size_t>(node)]);
                sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                                   static_cast<double>(seen);
            }
            const double of_sums = options_.share * pass.weight * nodes;
            sums_.remainder += of_sums * static_cast<double>(left);
            sums_.absorbed += of_sums * static_cast<double>(absorbed);
            if (!pass.counts_area) continue;
            const std::size_t in_strip = static_cast<std::size_t>(pixel - row_begin_ * width);
            cover_[in_strip] += 1;
            if (hides_) visible_[in_strip] += unhidden;
            sums_.filled += options_.share * static_cast<double>(unhidden);
        }
    }
}

void StripPainter::add_background(const std::vector<ShadingPass>& passes) {
    const int width = canvas_.width;
    const ScreenPoint reference{0.5 * width, 0.5 * (row_begin_ + row_end_)};
    const ShadedEye eye = shaded_eye(*view_, reference, stone_.shaded.middle);
    BareRow bare;
    bare.x = static_cast<float>(0.5 - reference.x);
    bare.count = width;
    bare.stride = canvas_.pixels();
    bare.factor = static_cast<float>(options_.share);
    bare.soft = options_.shading != BeamShading::single;
    for (const ShadingPass& pass : passes) {
        for (int y = row_begin_; y < row_end_; ++y) {
            bare.y = static_cast<float>(y + 0.5 - reference.y);
            bare.cover = cover_.data() + static_cast<std::ptrdiff_t>(y - row_begin_) * width;
            bare.radiance = plane(pass, 0).values + static_cast<std::ptrdiff_t>(y) * width;
            shade_background(pass.lights, pass.optics, eye, bare);
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
    bool split = false;
    for (const ShadingPass& pass : passes) {
        if (k_has_effects && pass.split) {
            split = true;
            paint_split(fronts, pass);
            continue;
        }
        if (options.shading == BeamShading::single) taken_.assign(count, 0);
        const SortedBeams& sorted = beams[pass.beams];
        std::size_t painted = 0;
        for (const BeamNumber& number : sorted.strips[static_cast<std::size_t>(strip)]) {
            if (painted++ % k_asked_every == 0 && !goes_on()) return sums_;
            paint_beam(sorted, number, pass);
        }
    }
    if (options.shading == BeamShading::single && !split) fill_holes(fronts, passes);
    add_background(passes);
    add_up_to_one(hides_ ? visible_.data() : cover_.data(), static_cast<int>(count),
                  static_cast<float>(options.share), canvas_.coverage.data() + begin);
    return sums_;
}

}  // namespace culet
