#include "render/beams/beam_tree.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "render/beams/beam_grower.h"

namespace culet {

namespace {

// The visible outline of a facet, positively oriented; empty if none.
std::vector<ScreenPoint> seen_outline(const FacetNet& net, int facet, const ScreenView& view) {
    std::vector<Vec3> images;
    for (const NetEdge& edge : net.edges(facet))
        images.push_back(view.of_point(net.corners()[static_cast<std::size_t>(edge.from)]));
    // Clip at the picture's four borders before dividing by w; this also removes what lies behind
    // the eye.
    const double width = view.width, height = view.height;
    for (const Vec3& border :
         {Vec3{1, 0, 0}, Vec3{-1, 0, width}, Vec3{0, 1, 0}, Vec3{0, -1, height}}) {
        std::vector<Vec3> kept;
        for (std::size_t i = 0, j = images.size() - 1; i < images.size(); j = i++) {
            const double here = glm::dot(border, images[i]), before = glm::dot(border, images[j]);
            if ((here < 0) != (before < 0))
                kept.push_back(images[j] + before / (before - here) * (images[i] - images[j]));
            if (!(here < 0)) kept.push_back(images[i]);
        }
        images = kept;
        if (images.empty()) return {};
    }
    std::vector<ScreenPoint> outline;
    for (const Vec3& image : images) {
        if (!(image.z > 0)) return {};  // a single point on the eye's plane
        outline.push_back({image.x / image.z, image.y / image.z});
    }
    // Counter-clockwise from outside is from y to x in a picture whose y points down.
    std::reverse(outline.begin(), outline.end());
    return outline;
}

}  // namespace

std::vector<FrontFacet> front_facets(const FacetNet& net, const ScreenView& view) {
    std::vector<FrontFacet> fronts;
    for (int facet = 0; facet < net.facets(); ++facet) {
        if (net.edges(facet).empty() || !view.sees(net.plane(facet))) continue;
        FrontFacet front{facet, seen_outline(net, facet, view)};
        if (front.outline.size() >= 3 &&
            doubled_area(front.outline.data(), front.outline.size()) > 0)
            fronts.push_back(std::move(front));
    }
    return fronts;
}

void BeamBranch::clear() {
    beams.clear();
    corners.clear();
    facets.clear();
    grown = faces = 0;
    exit_area = 0;
    deepest = 0;
}

long long BeamTree::grown() const {
    long long sum = 0;
    for (std::size_t i = 0; i < branch_count; ++i) sum += branches[i].grown;
    return sum;
}

long long BeamTree::faces() const {
    long long sum = 0;
    for (std::size_t i = 0; i < branch_count; ++i) sum += branches[i].faces;
    return sum;
}

int BeamTree::deepest() const {
    int most = 0;
    for (std::size_t i = 0; i < branch_count; ++i) most = std::max(most, branches[i].deepest);
    return most;
}

double BeamTree::exit_area() const {
    double sum = 0;
    for (std::size_t i = 0; i < branch_count; ++i) sum += branches[i].exit_area;
    return sum;
}

namespace {

// Stops early if there are too many beams or `goes_on` says no.
void grow_all(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
              BeamTree& tree, const std::function<bool(long long)>& goes_on) {
    struct Front : FrontFacet {
        std::vector<ScreenPoint> corners;
        std::vector<BeamTrunk> children;
    };
    std::vector<Front> fronts;
    tree.front_area = 0;
    for (FrontFacet& facet : front_facets(net, view)) {
        tree.front_area += 0.5 * doubled_area(facet.outline.data(), facet.outline.size());
        fronts.push_back({std::move(facet), {}, {}});
    }
    std::atomic<long long> grown{0};
    tbb::enumerable_thread_specific<BeamGrower> growers;
    const auto grower = [&]() -> BeamGrower& {
        BeamGrower& mine = growers.local();
        mine.prepare(net, view, n, limits, tree.front_area, grown, goes_on);
        return mine;
    };
    tbb::parallel_for(
        std::size_t{0}, fronts.size(),
        [&](std::size_t i) {
            BeamGrower& mine = grower();
            fronts[i].children = mine.split_front(fronts[i].facet, fronts[i].outline);
            fronts[i].corners = mine.corners();
        },
        tbb::simple_partitioner());
    struct Start {
        std::size_t front = 0, child = 0;
    };
    constexpr std::size_t k_none = ~std::size_t{0};
    std::vector<Start> starts;
    for (std::size_t i = 0; i < fronts.size(); ++i) {
        if (fronts[i].children.empty()) starts.push_back({i, k_none});
        for (std::size_t j = 0; j < fronts[i].children.size(); ++j) starts.push_back({i, j});
    }
    tree.branch_count = starts.size();
    if (tree.branches.size() < starts.size()) tree.branches.resize(starts.size());
    tbb::parallel_for(
        std::size_t{0}, starts.size(),
        [&](std::size_t i) {
            const Front& front = fronts[starts[i].front];
            BeamBranch& out = tree.branches[i];
            out.clear();
            BeamGrower& mine = grower();
            if (starts[i].child == k_none) {
                mine.keep_front(front.facet, front.outline, out);
                return;
            }
            const BeamTrunk& child = front.children[starts[i].child];
            mine.grow_branch(front.facet, middle_of(front.outline.data(), front.outline.size()),
                             child, front.corners.data() + child.part.region.first, out);
        },
        tbb::simple_partitioner());
}

}  // namespace

bool build_beams(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 BeamTree& tree, const std::function<bool(long long)>& goes_on) {
    tree.discarded = 0;
    BeamLimits fewer = limits;
    constexpr double k_fewer = 8, k_least_share = 1e-10;
    for (;;) {
        std::atomic<bool> stopped{false};
        const std::function<bool(long long)> ask = [&](long long grown) {
            // Clamp the count: beyond `most_beams` it depends on thread timing.
            if (goes_on && !goes_on(tree.discarded + std::min(grown, limits.most_beams)))
                stopped = true;
            return !stopped;
        };
        grow_all(net, view, n, fewer, tree, ask);
        if (stopped) return false;
        if (tree.grown() <= limits.most_beams) return true;
        // Whether there are too many does not depend on thread timing, so the result does not
        // either.
        fewer.cut_share = std::max(k_fewer * fewer.cut_share, k_least_share);
        tree.discarded += limits.most_beams;
        for (std::size_t i = 0; i < tree.branch_count; ++i) tree.branches[i] = {};
    }
}

}  // namespace culet
