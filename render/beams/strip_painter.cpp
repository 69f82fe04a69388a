#include "render/beams/strip_painter.h"

#include <algorithm>

namespace culet {

namespace {

constexpr float k_filled = 1 - 1e-5f;
// Pixels along the edge of a cell whose crystal beams have one ray of reference.
constexpr int k_cell = 12;

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
        share_.resize(size);
        follows_.resize(size);
    }
    if (radiance_.size() < left_.size() * static_cast<std::size_t>(nodes))
        radiance_.resize(left_.size() * static_cast<std::size_t>(nodes));
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
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets, beam.facets, fragments);
    ++sums_.fragments;
    float area = 0;
    for (int row = 0; row < grid.rows; ++row) {
        const float* share = grid.row(row);
        const int pixel = (grid.y + row) * canvas_.width + grid.x;
        for (int i = 0; i < grid.columns; ++i) area += share[i];
        if (pass.counts_area) {
            float* covered = &cover(pixel);
            for (int i = 0; i < grid.columns; ++i) covered[i] += share[i];
        }
        for (int node = 0; node < nodes; ++node) {
            float* to = plane(pass, node) + pixel;
            const float value = static_cast<float>(options_.share) *
                                radiance_[static_cast<std::size_t>(node * k_shading_room)];
            for (int i = 0; i < grid.columns; ++i) to[i] += value * share[i];
        }
    }
    const double filled = options_.share * static_cast<double>(area);
    for (int node = 0; node < nodes; ++node) {
        sums_.luminance +=
            pass.luminance[static_cast<std::size_t>(node)] * filled *
            static_cast<double>(radiance_[static_cast<std::size_t>(node * k_shading_room)]);
    }
    if (pass.counts_area) sums_.filled += filled;
    sums_.remainder += filled * pass.weight * nodes * static_cast<double>(left_[0]);
    sums_.absorbed += filled * pass.weight * nodes * static_cast<double>(absorbed_[0]);
}

// A ray along the facets that it does meet. False: it misses the stone.
bool StripPainter::retrace(int pixel, const ShadingPass& pass, std::size_t longest, float* radiance,
                           int stride, float& left, float& absorbed) {
    const ScreenPoint at{pixel % canvas_.width + 0.5, pixel / canvas_.width + 0.5};
    find_facets(stone_.body, *view_, at, pass.n, options_.depth,
                longest > 0 ? 0.0 : options_.cut_weight, facets_);
    if (facets_.empty()) return false;
    if (longest > 0 && facets_.size() > longest) facets_.resize(longest);
    const ShadedEye eye =
        shaded_eye(*view_, at, stone_.net.plane(facets_[0]), stone_.shaded.middle);
    static const float k_here[k_shading_room] = {};
    const int nodes = pass.lights.nodes;
    std::vector<float> seen(static_cast<std::size_t>(nodes * k_shading_room));
    float lefts[k_shading_room], lost[k_shading_room];
    Fragments fragments;
    fragments.x = fragments.y = k_here;
    fragments.count = 1;
    fragments.radiance = seen.data();
    fragments.stride = k_shading_room;
    fragments.left = lefts;
    fragments.absorbed = lost;
    fragments.soft = options_.shading == BeamShading::averaged;
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets_.data(),
               static_cast<int>(facets_.size()), fragments);
    for (int node = 0; node < nodes; ++node)
        radiance[node * stride] = seen[static_cast<std::size_t>(node * k_shading_room)];
    left = lefts[0];
    absorbed = lost[0];
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
    fragments.follows = follows_.data();
    fragments.soft = options_.shading == BeamShading::averaged;
    shade_beam({&stone_.shaded, &pass.optics, &pass.lights}, eye, facets, beam.facets, fragments);
    sums_.fragments += covered.count;

    float* share = share_.data();
    std::copy_n(covered.share.data(), count, share);
    for (std::size_t i = 0; i < count; ++i) {
        // Pixels of which other beams have a part are means of their beams anyway.
        if (follows_[i] || share[i] < 1) continue;
        if (!retrace(covered.pixel[i], pass, beam.facets, radiance_.data() + i, fragments.stride,
                     left_[i], absorbed_[i]) &&
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
        sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                           static_cast<double>(light);
    }
    float filled = 0, remainder = 0, absorbed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        filled += share[i];
        remainder += share[i] * left_[i];
        absorbed += share[i] * absorbed_[i];
    }
    if (pass.counts_area) {
        for (std::size_t i = 0; i < count; ++i) cover(covered.pixel[i]) += share[i];
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
    ScreenPoint middle{0, 0};
    for (int i = 0; i < beam.corners; ++i) {
        middle.x += corners[i].x;
        middle.y += corners[i].y;
    }
    middle.x /= beam.corners;
    middle.y /= beam.corners;
    const ShadedEye eye =
        shaded_eye(*view_, middle, stone_.net.plane(facets[0]), stone_.shaded.middle);
    if (options_.shading == BeamShading::flat) {
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

void StripPainter::paint_leaving(const LeavingBeam& beam, const ScreenPoint* corners,
                                 std::size_t count, const ShadingPass& pass) {
    const CoveredPixels& covered =
        options_.shading == BeamShading::single
            ? coverage_.middles(corners, count, beam.reference, row_begin_, row_end_)
            : coverage_.touched(coverage_.areas(corners, count, row_begin_, row_end_),
                                beam.reference);
    if (covered.count == 0) return;
    const int nodes = pass.lights.nodes;
    reserve(covered.count, nodes);
    const auto store = [](const std::array<Vec3, 3>& from, float to[3][3], const Vec3& about) {
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k)
                to[i][k] = static_cast<float>(from[static_cast<std::size_t>(i)][k] -
                                              (i == 0 ? about[k] : 0.0));
        }
    };
    ShadedLeaving leaving;
    store(beam.point, leaving.point, stone_.shaded.middle);
    store(beam.direction, leaving.direction, Vec3(0));
    store(beam.s, leaving.s, Vec3(0));
    for (std::size_t i = 0; i < 3; ++i) {
        leaving.weight[i] = static_cast<float>(beam.weight[i]);
        leaving.Q[i] = static_cast<float>(beam.Q[i]);
        leaving.U[i] = static_cast<float>(beam.U[i]);
    }
    leaving.polarised = pass.parted->polarised_lights;
    for (std::size_t node = 0; node < static_cast<std::size_t>(nodes); ++node) {
        for (std::size_t i = 0; i < 3; ++i)
            leaving.transmitted.push_back(static_cast<float>(beam.transmitted[i][node]));
    }
    Fragments fragments;
    fragments.x = covered.x.data();
    fragments.y = covered.y.data();
    fragments.count = covered.count;
    fragments.radiance = radiance_.data();
    fragments.stride = static_cast<int>(left_.size());
    fragments.soft = options_.shading != BeamShading::single;
    shade_leaving(pass.lights, leaving, fragments);
    sums_.fragments += covered.count;
    sums_.deepest = std::max(sums_.deepest, beam.facets);
    const float of_picture = static_cast<float>(options_.share);
    for (int node = 0; node < nodes; ++node) {
        float* to = plane(pass, node);
        const float* radiance = radiance_.data() + node * fragments.stride;
        float light = 0;
        for (int i = 0; i < covered.count; ++i) {
            const std::size_t at = static_cast<std::size_t>(i);
            const float seen = radiance[i] * covered.share[at];
            to[covered.pixel[at]] += of_picture * seen;
            light += seen;
        }
        sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                           static_cast<double>(light);
    }
    // What is mirrored at the front covers each pixel once.
    if (!pass.counts_area || beam.facets > 1) return;
    for (int i = 0; i < covered.count; ++i) {
        const std::size_t at = static_cast<std::size_t>(i);
        cover(covered.pixel[at]) += covered.share[at];
        sums_.filled += options_.share * static_cast<double>(covered.share[at]);
    }
}

// Cell by cell of every front facet.
void StripPainter::paint_parted(const std::vector<FrontFacet>& fronts, const ShadingPass& pass) {
    PartedBeams beams(stone_.net, pass.parted->band, {options_.depth, options_.cut_weight},
                      pass.parted->response);
    const PartedBeams::Sink sink = [&](const LeavingBeam& beam, const ScreenPoint* corners,
                                       std::size_t count) {
        paint_leaving(beam, corners, count, pass);
    };
    RegionCutter cutter;
    for (const FrontFacet& front : fronts) {
        double low = front.outline[0].x, high = low;
        for (const ScreenPoint& p : front.outline) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
        const int first = static_cast<int>(low) / k_cell, last = static_cast<int>(high) / k_cell;
        for (int y = row_begin_; y < row_end_; y += k_cell) {
            const int y_end = std::min(y + k_cell, row_end_);
            for (int column = first; column <= last; ++column) {
                cutter.take(front.outline.data(), front.outline.size(), 4);
                const double left = column * k_cell, right = left + k_cell;
                bool any = true;
                for (const Vec3& line :
                     {Vec3{1, 0, -left}, Vec3{-1, 0, right}, Vec3{0, 1, -static_cast<double>(y)},
                      Vec3{0, -1, static_cast<double>(y_end)}}) {
                    any = any && cutter.measure(line).second > 0;
                    if (any) cutter.cut();
                }
                if (any && doubled_area(cutter.corners(), cutter.count()) > 0)
                    beams.grow(*view_, front.facet, cutter.corners(), cutter.count(), sink);
            }
        }
    }
    const double of_sums = options_.share * pass.weight * pass.lights.nodes;
    sums_.beams += beams.beams();
    sums_.remainder += of_sums * beams.remainder();
    sums_.absorbed += of_sums * beams.absorbed();
}

// Middles of pixels that no beam took, next to pixels that one did.
void StripPainter::fill_holes(const std::vector<ShadingPass>& passes) {
    const int width = canvas_.width;
    const auto taken = [&](int x, int y) {
        return x >= 0 && x < width && y >= row_begin_ && y < row_end_ && cover(y * width + x) > 0;
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
            float left = 0, absorbed = 0;
            if (!retrace(pixel, pass, 0, radiance_.data(), 1, left, absorbed)) break;
            for (int node = 0; node < nodes; ++node) {
                const float seen = radiance_[static_cast<std::size_t>(node)];
                plane(pass, node)[pixel] += static_cast<float>(options_.share) * seen;
                sums_.luminance += options_.share * pass.luminance[static_cast<std::size_t>(node)] *
                                   static_cast<double>(seen);
            }
            const double of_sums = options_.share * pass.weight * nodes;
            sums_.remainder += of_sums * static_cast<double>(left);
            sums_.absorbed += of_sums * static_cast<double>(absorbed);
            if (!pass.counts_area) continue;
            cover(pixel) = 1;
            sums_.filled += options_.share;
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
    row_begin_ = strip * k_strip;
    row_end_ = std::min(row_begin_ + k_strip, canvas_.height);
    sums_ = {};
    const std::size_t begin = static_cast<std::size_t>(row_begin_) *
                              static_cast<std::size_t>(canvas_.width),
                      count = static_cast<std::size_t>(row_end_ - row_begin_) *
                              static_cast<std::size_t>(canvas_.width);
    cover_.assign(count, 0.0f);
    bool parted = false;
    for (const ShadingPass& pass : passes) {
        if (pass.parted) {
            parted = true;
            paint_parted(fronts, pass);
            continue;
        }
        const SortedBeams& sorted = beams[pass.beams];
        for (const LeafNumber& number : sorted.strips[static_cast<std::size_t>(strip)])
            paint_beam(sorted, number, pass);
    }
    if (options.shading == BeamShading::single && !parted) fill_holes(passes);
    add_background(passes);
    const float share = static_cast<float>(options.share);
    for (std::size_t i = 0; i < count; ++i)
        canvas_.coverage[begin + i] += share * std::min(cover_[i], 1.0f);
    return sums_;
}

}  // namespace culet
