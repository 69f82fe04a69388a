#include "render/beams/beam_grower.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/optics/fresnel.h"

namespace culet {

namespace {

// Regions of at most this area in square pixels over a pixel's angle (radians) need no check: the
// map's error is about the square of a region's angular size.
constexpr double k_surely_small = 0.046;
constexpr double k_surely_right = 0.25;  // pixels

double mean_reflectance(double n, double cosine) {
    const FaceAmplitudes face = fresnel(n, 1.0, n * cosine);
    return face.total ? 1.0 : 0.5 * (std::norm(face.r_s) + std::norm(face.r_p));
}

}  // namespace

void BeamGrower::prepare(const FacetNet& net, const ScreenView& view, double n,
                         const BeamLimits& limits, double front_area, std::atomic<long long>& grown,
                         const std::function<bool(long long)>& goes_on) {
    net_ = &net;
    view_ = &view;
    n_ = n;
    limits_ = &limits;
    least_ = limits.cut_share * front_area;
    const ScreenPoint centre{0.5 * view.width, 0.5 * view.height};
    const double pixel = glm::length(view.vx) / glm::length(view.towards(centre));
    small_ = pixel > 0 ? k_surely_small / pixel : std::numeric_limits<double>::infinity();
    grown_ = &grown;
    goes_on_ = &goes_on;
    stopped_ = false;
    splitter_.prepare(net);
}

const std::vector<BeamTrunk>& BeamGrower::split_front(int facet,
                                                      const std::vector<ScreenPoint>& outline) {
    pool_ = outline;
    path_.assign(1, static_cast<std::uint16_t>(facet));
    children_.clear();
    const double doubled = doubled_area(outline.data(), outline.size());
    const ScreenPoint middle = middle_of(outline.data(), outline.size());
    const Pencil pencil = pencil_through(*view_, middle, net_->plane(facet), n_);
    const FaceAmplitudes face = fresnel(1.0, n_, pencil.cos_i);
    const BeamTrunk trunk{{facet, {0, outline.size()}, doubled},
                          0.5 * (face.t_s * face.t_s + face.t_p * face.t_p)};
    if (limits_->depth > 1 && worth_splitting(trunk)) split(trunk, pencil, Folding(), middle);
    return children_;
}

void BeamGrower::keep_front(int facet, const std::vector<ScreenPoint>& outline, BeamBranch& out) {
    out_ = &out;
    ++out.grown;
    pool_ = outline;
    path_.assign(1, static_cast<std::uint16_t>(facet));
    add_beam({{facet, {0, outline.size()}, doubled_area(outline.data(), outline.size())}, 1});
}

void BeamGrower::grow_branch(int front, const ScreenPoint& middle, const BeamTrunk& child,
                             const ScreenPoint* region, BeamBranch& out) {
    out_ = &out;
    pool_.assign(region, region + child.part.region.count);
    path_.assign(1, static_cast<std::uint16_t>(front));
    children_.clear();
    front_ = pencil_through(*view_, middle, net_->plane(front), n_);
    BeamTrunk trunk = child;
    trunk.part.region.first = 0;
    counted_ = 0;
    stopped_ = !(*goes_on_)(*grown_);
    grow(trunk, Folding());
}

void BeamGrower::add_beam(const BeamTrunk& trunk) {
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
    out_->beams.push_back(beam);
    out_->deepest = std::max(out_->deepest, static_cast<int>(path_.size()));
    out_->exit_area += 0.5 * trunk.part.doubled_area;
}

// `folding` leads to the stone before the trunk's facet mirrors it.
void BeamGrower::grow(const BeamTrunk& trunk, const Folding& folding) {
    ++out_->grown;
    if (too_many()) return;
    path_.push_back(static_cast<std::uint16_t>(trunk.part.facet));
    if (static_cast<int>(path_.size()) >= limits_->depth) {
        add_beam(trunk);
    } else {
        go_on(trunk, folding);
    }
    path_.pop_back();
}

void BeamGrower::go_on(const BeamTrunk& trunk, const Folding& before) {
    const ScreenPoint middle =
        middle_of(pool_.data() + trunk.part.region.first, trunk.part.region.count);
    const Plane& plane = net_->plane(trunk.part.facet);
    const Pencil pencil = limits_->refraction == Refraction::astigmatic
                              ? pencil_through(*view_, middle, net_->plane(path_.front()), n_)
                              : front_;
    const Folding folding = before.mirrored(plane);
    const double cosine = glm::dot(before.turn * pencil.direction, plane.normal);
    BeamTrunk next = trunk;
    next.weight *= mean_reflectance(n_, std::clamp(cosine, 0.0, 1.0));
    if (!worth_splitting(next)) {
        add_beam(trunk);
        return;
    }
    if (0.5 * next.weight * next.part.doubled_area < limits_->middle_ray_area) {
        const std::size_t length = path_.size();
        follow_middle_ray(next, folding.turn * pencil.direction, folding.point(pencil.x0));
        add_beam(trunk);
        out_->beams.back().follows_middle_ray = true;
        path_.resize(length);
        return;
    }
    const std::size_t first_child = children_.size(), pool_before = pool_.size();
    split(next, pencil, folding, middle);
    // Growing a child appends to `children_` and restores its size.
    const std::size_t end = children_.size();
    for (std::size_t i = first_child; i < end; ++i) {
        const BeamTrunk child = children_[i];
        grow(child, folding);
    }
    children_.resize(first_child);
    pool_.resize(pool_before);
}

// Asks only now and then, as the branches share one count.
bool BeamGrower::too_many() {
    constexpr long long k_now_and_then = 1024;
    if (out_->grown - counted_ >= k_now_and_then) {
        *grown_ += out_->grown - counted_;
        counted_ = out_->grown;
        stopped_ = stopped_ || !(*goes_on_)(*grown_);
    }
    return stopped_ || *grown_ > limits_->most_beams;
}

// Appends the facets that the ray along `d` through `point` meets behind the trunk's facet.
void BeamGrower::follow_middle_ray(const BeamTrunk& trunk, Vec3 d, const Vec3& point) {
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
        ++out_->faces;
    }
}

bool BeamGrower::worth_splitting(const BeamTrunk& trunk) const {
    return trunk.weight >= limits_->cut_weight &&
           0.5 * trunk.weight * trunk.part.doubled_area >= least_;
}

void BeamGrower::split(const BeamTrunk& trunk, const Pencil& pencil, const Folding& folding,
                       const ScreenPoint& middle, int halvings) {
    const Vec3 d = folding.turn * pencil.direction, o = folding.point(pencil.x0);
    const Plane& left = net_->plane(trunk.part.facet);
    const double towards = glm::dot(left.normal, d);
    const Vec3 x = towards != 0 ? o + (left.offset - glm::dot(left.normal, o)) / towards * d : o;
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

// Largest error of the map at the region's corners, in pixels.
double BeamGrower::map_error(const PencilMap& map, const Region& region, const Folding& folding,
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

// Halves a region and splits both halves, each with its own map.
void BeamGrower::halve(const BeamTrunk& trunk, const Folding& folding, int halvings) {
    const Region whole = trunk.part.region;
    const ScreenPoint middle = middle_of(pool_.data() + whole.first, whole.count);
    // Cut across the direction of the corner farthest from the middle.
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
        BeamTrunk half = trunk;
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
        split(half, pencil_through(*view_, centre, net_->plane(path_.front()), n_), folding, centre,
              halvings);
    }
}

}  // namespace culet
