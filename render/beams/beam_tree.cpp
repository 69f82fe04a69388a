#include "render/beams/beam_tree.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "render/beams/region_splitter.h"
#include "render/fresnel.h"

namespace culet {

namespace {

// Regions up to so many square pixels, times a pixel's angle, need not be looked at: a map is off
// by about the square of the angle that a region fills.
constexpr double k_surely_small = 0.046;
constexpr double k_surely_right = 0.25;  // pixels
constexpr int k_most_halvings = 12;

double mean_reflectance(double n, double cosine) {
    const FaceAmplitudes face = fresnel(n, 1.0, n * cosine);
    return face.total ? 1.0 : 0.5 * (std::norm(face.r_s) + std::norm(face.r_p));
}

// A beam that is to be split: what its rays have in common.
struct Trunk {
    FacetRegion part;   // the facet met last
    double weight = 1;  // of what goes on behind the facet before that
    bool sure = true;   // no border is off by more than k_surely_right
};

// Grows the beams below one beam, and keeps the room for it.
class Grower {
public:
    void prepare(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 double front_area, std::atomic<long long>& grown) {
        net_ = &net;
        view_ = &view;
        n_ = n;
        limits_ = &limits;
        least_ = limits.cut_share * front_area;
        const ScreenPoint centre{0.5 * view.width, 0.5 * view.height};
        const double pixel = glm::length(view.vx) / glm::length(view.towards(centre));
        small_ = pixel > 0 ? k_surely_small / pixel : std::numeric_limits<double>::infinity();
        grown_ = &grown;
        splitter_.prepare(net);
    }

    /// Beams behind the front facet's, with the corners of their regions in `corners()`. None when
    /// the front beam is not to be split.
    const std::vector<Trunk>& split_front(int facet, const std::vector<ScreenPoint>& outline) {
        pool_ = outline;
        path_.assign(1, static_cast<std::uint16_t>(facet));
        children_.clear();
        const double doubled = doubled_area(outline.data(), outline.size());
        const ScreenPoint middle = middle_of(outline.data(), outline.size());
        const Pencil pencil = pencil_through(*view_, middle, net_->plane(facet), n_);
        const FaceAmplitudes face = fresnel(1.0, n_, pencil.cos_i);
        const Trunk trunk{{facet, {0, outline.size()}, doubled},
                          0.5 * (face.t_s * face.t_s + face.t_p * face.t_p)};
        if (limits_->depth > 1 && worth_splitting(trunk)) split(trunk, pencil, Folding(), middle);
        return children_;
    }
    const std::vector<ScreenPoint>& corners() const { return pool_; }

    /// A beam that nothing is split from: the front facet's.
    void keep_front(int facet, const std::vector<ScreenPoint>& outline, BeamBranch& out) {
        out_ = &out;
        ++out.beams;
        pool_ = outline;
        path_.assign(1, static_cast<std::uint16_t>(facet));
        leaf({{facet, {0, outline.size()}, doubled_area(outline.data(), outline.size())}, 1});
    }

    /// All beams below one that `split_front` found; `middle`: of the front facet's outline.
    void grow_branch(int front, const ScreenPoint& middle, const Trunk& child,
                     const ScreenPoint* region, BeamBranch& out) {
        out_ = &out;
        pool_.assign(region, region + child.part.region.count);
        path_.assign(1, static_cast<std::uint16_t>(front));
        children_.clear();
        front_ = pencil_through(*view_, middle, net_->plane(front), n_);
        Trunk trunk = child;
        trunk.part.region.first = 0;
        counted_ = 0;
        grow(trunk, Folding());
    }

private:
    void leaf(const Trunk& trunk) {
        const ScreenPoint* corners = pool_.data() + trunk.part.region.first;
        Beam beam;
        beam.corner = static_cast<std::uint32_t>(out_->corners.size());
        beam.corners = static_cast<std::uint16_t>(trunk.part.region.count);
        beam.facet = static_cast<std::uint32_t>(out_->facets.size());
        beam.facets = static_cast<std::uint16_t>(path_.size());
        beam.sure = trunk.sure;
        double low = corners[0].y, high = low;
        for (std::size_t i = 1; i < trunk.part.region.count; ++i) {
            low = std::min(low, corners[i].y);
            high = std::max(high, corners[i].y);
        }
        beam.first_row = static_cast<std::int32_t>(std::floor(low));
        beam.end_row = static_cast<std::int32_t>(std::ceil(high));
        out_->corners.insert(out_->corners.end(), corners, corners + trunk.part.region.count);
        out_->facets.insert(out_->facets.end(), path_.begin(), path_.end());
        out_->leaves.push_back(beam);
        out_->deepest = std::max(out_->deepest, static_cast<int>(path_.size()));
        out_->leaf_area += 0.5 * trunk.part.doubled_area;
    }

    // `folding`: to the stone before the trunk's facet mirrors it.
    void grow(const Trunk& trunk, const Folding& folding) {
        ++out_->beams;
        if (too_many()) return;
        path_.push_back(static_cast<std::uint16_t>(trunk.part.facet));
        if (static_cast<int>(path_.size()) >= limits_->depth) {
            leaf(trunk);
        } else {
            go_on(trunk, folding);
        }
        path_.pop_back();
    }

    void go_on(const Trunk& trunk, const Folding& before) {
        const ScreenPoint middle =
            middle_of(pool_.data() + trunk.part.region.first, trunk.part.region.count);
        const Plane& plane = net_->plane(trunk.part.facet);
        const Pencil pencil = limits_->refraction == Refraction::astigmatic
                                  ? pencil_through(*view_, middle, net_->plane(path_.front()), n_)
                                  : front_;
        const Folding folding = before.mirrored(plane);
        const double cosine = glm::dot(before.turn * pencil.direction, plane.normal);
        Trunk next = trunk;
        next.weight *= mean_reflectance(n_, std::clamp(cosine, 0.0, 1.0));
        if (!worth_splitting(next)) {
            leaf(trunk);
            return;
        }
        if (0.5 * next.weight * next.part.doubled_area < limits_->alone) {
            const std::size_t length = path_.size();
            follow_alone(next, folding.turn * pencil.direction, folding.point(pencil.x0));
            leaf(trunk);
            out_->leaves.back().alone = true;
            path_.resize(length);
            return;
        }
        const std::size_t first_child = children_.size(), pool_before = pool_.size();
        split(next, pencil, folding, middle);
        // Growing a child appends to `children_` and takes away what it appended.
        const std::size_t end = children_.size();
        for (std::size_t i = first_child; i < end; ++i) {
            const Trunk child = children_[i];
            grow(child, folding);
        }
        children_.resize(first_child);
        pool_.resize(pool_before);
    }

    // Asks now and then only: the branches share one count.
    bool too_many() {
        constexpr long long k_now_and_then = 1024;
        if (out_->beams - counted_ >= k_now_and_then) {
            *grown_ += out_->beams - counted_;
            counted_ = out_->beams;
        }
        return *grown_ > limits_->most_beams;
    }

    // Adds to the path what the ray along `d` through `point` meets behind the trunk's facet.
    void follow_alone(const Trunk& trunk, Vec3 d, const Vec3& point) {
        const Plane& left = net_->plane(trunk.part.facet);
        Vec3 x = point - height_above(left, point) / glm::dot(left.normal, d) * d;
        double weight = trunk.weight;
        while (static_cast<int>(path_.size()) < limits_->depth && weight >= limits_->cut_weight) {
            const int facet = net_->exit_of(path_.back(), x, d);
            const Plane& plane = net_->plane(facet);
            const double cosine = glm::dot(plane.normal, d);
            if (!(cosine > 0)) return;  // along an edge
            x -= height_above(plane, x) / cosine * d;
            d -= 2 * cosine * plane.normal;
            weight *= mean_reflectance(n_, std::min(cosine, 1.0));
            path_.push_back(static_cast<std::uint16_t>(facet));
        }
    }

    bool worth_splitting(const Trunk& trunk) const {
        return trunk.weight >= limits_->cut_weight &&
               0.5 * trunk.weight * trunk.part.doubled_area >= least_;
    }

    void split(const Trunk& trunk, const Pencil& pencil, const Folding& folding,
               const ScreenPoint& middle, int halvings = k_most_halvings) {
        const Vec3 d = folding.turn * pencil.direction, o = folding.point(pencil.x0);
        const Plane& left = net_->plane(trunk.part.facet);
        const double towards = glm::dot(left.normal, d);
        const Vec3 x =
            towards != 0 ? o + (left.offset - glm::dot(left.normal, o)) / towards * d : o;
        const int exit = net_->exit_of(trunk.part.facet, x, d);
        const Plane& hit = net_->plane(exit);
        const double into = glm::dot(hit.normal, d);
        const double length = into > 0 ? (hit.offset - glm::dot(hit.normal, o)) / into : 0;
        const double depth = std::max(0.0, length) * pencil.cos_t;
        InsideView inside;
        inside.map = map_of(pencil, limits_->refraction, folding, depth);
        const double k =
            limits_->refraction == Refraction::parallel ? 0 : 0.5 * (pencil.k_s + pencil.k_t);
        inside.eye =
            folding.turn * (k * pencil.x0 - pencil.direction / pencil.cos_t) + k * folding.shift;
        inside.eye_weight = k;
        inside.parity = path_.size() % 2 == 1 ? 1 : -1;

        bool sure = trunk.sure;
        if (limits_->refraction != Refraction::astigmatic) {
            sure = false;
        } else if (trunk.part.doubled_area > 2 * small_) {
            const double error = map_error(inside.map, trunk.part.region, folding, exit);
            if (halvings > 0 && error > limits_->map_error) {
                halve(trunk, folding, halvings - 1);
                return;
            }
            sure = sure && error <= k_surely_right;
        }
        parts_.clear();
        splitter_.split(inside, pool_, trunk.part.region, trunk.part.facet, exit, middle, parts_);
        for (const FacetRegion& part : parts_) children_.push_back({part, trunk.weight, sure});
    }

    // How far the map is off, in pixels, at the region's corners.
    double map_error(const PencilMap& map, const Region& region, const Folding& folding,
                     int exit) const {
        const Plane &hit = net_->plane(exit), &front = net_->plane(path_.front());
        double most = 0;
        for (std::size_t i = 0; i < region.count; ++i) {
            const ScreenPoint& corner = pool_[region.first + i];
            const InsideRay exact = ray_through(*view_, corner, front, n_);
            const Vec3 d = folding.turn * exact.direction, o = folding.point(exact.x0);
            const double into = glm::dot(hit.normal, d);
            if (!(into > 0)) continue;
            const ScreenImage seen = map.of(o + (hit.offset - glm::dot(hit.normal, o)) / into * d);
            if (!(seen.z > 0)) continue;
            most = std::max(
                {most, std::abs(seen.x / seen.z - corner.x), std::abs(seen.y / seen.z - corner.y)});
        }
        return most;
    }

    // Splits the beams behind two halves of a region, each with a map of its own.
    void halve(const Trunk& trunk, const Folding& folding, int halvings) {
        const Region whole = trunk.part.region;
        const ScreenPoint middle = middle_of(pool_.data() + whole.first, whole.count);
        // Across the direction of the corner farthest from the middle.
        double farthest = 0, dx = 1, dy = 0;
        for (std::size_t i = 0; i < whole.count; ++i) {
            const ScreenPoint& p = pool_[whole.first + i];
            const double x = p.x - middle.x, y = p.y - middle.y;
            if (x * x + y * y <= farthest) continue;
            farthest = x * x + y * y;
            dx = x;
            dy = y;
        }
        for (const double sign : {1.0, -1.0}) {
            Trunk half = trunk;
            const Vec3 line = sign * Vec3{dx, dy, -dx * middle.x - dy * middle.y};
            cutter_.take(pool_.data() + whole.first, whole.count, 1);
            cutter_.measure(line);
            cutter_.cut();
            const std::size_t count = cutter_.count();
            half.part.doubled_area = doubled_area(cutter_.corners(), count);
            if (count < 3 || !(half.part.doubled_area > 0)) continue;
            half.part.region = {pool_.size(), count};
            pool_.insert(pool_.end(), cutter_.corners(), cutter_.corners() + count);
            const ScreenPoint centre = middle_of(cutter_.corners(), count);
            split(half, pencil_through(*view_, centre, net_->plane(path_.front()), n_), folding,
                  centre, halvings);
        }
    }

    const FacetNet* net_ = nullptr;
    const ScreenView* view_ = nullptr;
    const BeamLimits* limits_ = nullptr;
    double n_ = 1, least_ = 0, small_ = 0;
    std::atomic<long long>* grown_ = nullptr;  // in all branches
    long long counted_ = 0;                    // of this branch, in that
    BeamBranch* out_ = nullptr;
    Pencil front_;
    std::vector<std::uint16_t> path_;
    std::vector<ScreenPoint> pool_;
    std::vector<FacetRegion> parts_;
    std::vector<Trunk> children_;
    RegionSplitter splitter_;
    RegionCutter cutter_;
};

// What the picture shows of a facet, positively oriented; empty when nothing.
std::vector<ScreenPoint> seen_outline(const FacetNet& net, int facet, const ScreenView& view) {
    std::vector<Vec3> images;
    for (const NetEdge& edge : net.edges(facet))
        images.push_back(view.of_point(net.corners()[static_cast<std::size_t>(edge.from)]));
    // The picture's four borders, before division by w: what is behind the eye goes with them.
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
    // Counter-clockwise from outside is from y to x in a picture whose y runs down.
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
    leaves.clear();
    corners.clear();
    facets.clear();
    beams = 0;
    leaf_area = 0;
    deepest = 0;
}

long long BeamTree::beams() const {
    long long sum = 0;
    for (std::size_t i = 0; i < branch_count; ++i) sum += branches[i].beams;
    return sum;
}

int BeamTree::deepest() const {
    int most = 0;
    for (std::size_t i = 0; i < branch_count; ++i) most = std::max(most, branches[i].deepest);
    return most;
}

double BeamTree::leaf_area() const {
    double sum = 0;
    for (std::size_t i = 0; i < branch_count; ++i) sum += branches[i].leaf_area;
    return sum;
}

void build_beams(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 BeamTree& tree) {
    struct Front : FrontFacet {
        std::vector<ScreenPoint> corners;
        std::vector<Trunk> children;
    };
    std::vector<Front> fronts;
    tree.front_area = 0;
    for (FrontFacet& facet : front_facets(net, view)) {
        tree.front_area += 0.5 * doubled_area(facet.outline.data(), facet.outline.size());
        fronts.push_back({std::move(facet), {}, {}});
    }
    std::atomic<long long> grown{0};
    tbb::enumerable_thread_specific<Grower> growers;
    const auto grower = [&]() -> Grower& {
        Grower& mine = growers.local();
        mine.prepare(net, view, n, limits, tree.front_area, grown);
        return mine;
    };
    tbb::parallel_for(
        std::size_t{0}, fronts.size(),
        [&](std::size_t i) {
            Grower& mine = grower();
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
            Grower& mine = grower();
            if (starts[i].child == k_none) {
                mine.keep_front(front.facet, front.outline, out);
                return;
            }
            const Trunk& child = front.children[starts[i].child];
            mine.grow_branch(front.facet, middle_of(front.outline.data(), front.outline.size()),
                             child, front.corners.data() + child.part.region.first, out);
        },
        tbb::simple_partitioner());
    if (tree.beams() <= limits.most_beams) return;
    // Whether there are too many does not depend on who grew which first, so neither does this.
    constexpr double k_fewer = 8, k_least_share = 1e-10;
    BeamLimits fewer = limits;
    fewer.cut_share = std::max(k_fewer * limits.cut_share, k_least_share);
    for (std::size_t i = 0; i < tree.branch_count; ++i) tree.branches[i] = {};
    build_beams(net, view, n, fewer, tree);
}

}  // namespace culet
