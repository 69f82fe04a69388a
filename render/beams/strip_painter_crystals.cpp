// Paints strips of crystals with split waves (split_beams.h).

#include <algorithm>

#include "render/beams/strip_painter.h"

namespace culet {

namespace {

// Side in pixels of a cell with one reference ray. Second-order errors grow as the square of its
// share of the stone's width; a cell costs as much as about 10 pixels.
int cell_of(const std::vector<FrontFacet>& fronts) {
    constexpr double k_cells_across = 64;
    constexpr int k_least = 4, k_most = 16;
    double low = 1e300, high = -1e300;
    for (const FrontFacet& front : fronts) {
        for (const ScreenPoint& p : front.outline) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
    }
    return std::clamp(static_cast<int>((high - low) / k_cells_across), k_least, k_most);
}

}  // namespace

void StripPainter::paint_leaving(const LeavingBeam& beam, const ScreenPoint* corners,
                                 std::size_t count, const ShadingPass& pass) {
    const CoveredPixels& covered =
        options_.shading == BeamShading::single
            ? coverage_.middles(corners, count, beam.reference, row_begin_, row_end_)
            : coverage_.areas(corners, count, beam.reference, row_begin_, row_end_,
                              pass.lights.any_edge);
    if (covered.count == 0) return;
    const int nodes = pass.lights.nodes;
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
    leaving.polarised = pass.split->polarised_lights;
    for (std::size_t node = 0; node < static_cast<std::size_t>(nodes); ++node) {
        for (std::size_t i = 0; i < 3; ++i)
            leaving.transmitted.push_back(static_cast<float>(beam.transmitted[i][node]));
    }
    const Fragments fragments = fragments_of(covered, pass);
    shade_leaving(pass.lights, leaving, fragments);
    sums_.fragments += covered.count;
    sums_.deepest = std::max(sums_.deepest, beam.facets);
    add_light(covered, covered.share.data(), pass, false);
    // The reflection at the front covers each pixel once.
    if (pass.counts_area && beam.facets == 1) add_cover(covered, covered.share.data(), nullptr);
}

// Paints every front facet cell by cell.
void StripPainter::paint_split(const std::vector<FrontFacet>& fronts, const ShadingPass& pass) {
    const long long before = sums_.beams;
    const auto goes_on_with = [&](long long grown) {
        sums_.beams = before + grown;
        return goes_on();
    };
    SplitBeams beams(stone_.net, pass.split->band,
                     {options_.depth, options_.cut_weight, goes_on_with}, pass.split->response);
    const SplitBeams::Sink sink = [&](const LeavingBeam& beam, const ScreenPoint* corners,
                                      std::size_t count) {
        paint_leaving(beam, corners, count, pass);
    };
    RegionCutter cutter;
    const int cell = cell_of(fronts);
    for (const FrontFacet& front : fronts) {
        double low = front.outline[0].x, high = low;
        for (const ScreenPoint& p : front.outline) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
        const int first = static_cast<int>(low) / cell, last = static_cast<int>(high) / cell;
        for (int y = row_begin_; y < row_end_; y += cell) {
            const int y_end = std::min(y + cell, row_end_);
            for (int column = first; column <= last; ++column) {
                cutter.take(front.outline.data(), front.outline.size(), 4);
                const double left = column * cell, right = left + cell;
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
    sums_.beams = before + beams.beams();
    sums_.remainder += of_sums * beams.remainder();
    sums_.absorbed += of_sums * beams.absorbed();
}

}  // namespace culet
