#include "render/grade/eye_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/beams/screen_region.h"
#include "render/optics/fresnel.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Size of the plane on which outlines are measured; its pixels have no meaning.
constexpr int k_picture = 1000;
constexpr double k_room_around = 1.05;
// Number of outlines made between calls of `goes_on`: about a millisecond.
constexpr std::size_t k_outlines = 1000;

Vec3 refracted_out(const Vec3& d, const Vec3& normal, double n, double cosine, double q_out) {
    return glm::normalize(n * d + (q_out - n * cosine) * normal);
}

// Splits a beam at a face.
void meet_face(const Plane& plane, double n, EyeExit& exit, double weight) {
    const double cosine = std::clamp(glm::dot(exit.inside, plane.normal), 0.0, 1.0);
    const FaceReflection face = mean_reflection(n, 1, n * cosine);
    exit.remaining = weight * face.mean;
    exit.weight = face.total ? 0 : weight * (1 - face.mean);
    if (!face.total) exit.direction = refracted_out(exit.inside, plane.normal, n, cosine, face.q2);
}

double cross(const ScreenPoint& o, const ScreenPoint& a, const ScreenPoint& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// Andrew's monotone chain (1979), counter-clockwise.
std::vector<ScreenPoint> convex_hull(std::vector<ScreenPoint> points) {
    if (points.size() < 3) return points;
    std::sort(points.begin(), points.end(), [](const ScreenPoint& a, const ScreenPoint& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<ScreenPoint> hull(2 * points.size());
    std::size_t count = 0;
    const auto add = [&](const ScreenPoint& p, std::size_t least) {
        while (count >= least + 2 && !(cross(hull[count - 2], hull[count - 1], p) > 0)) --count;
        hull[count++] = p;
    };
    for (const ScreenPoint& p : points) add(p, 0);
    const std::size_t lower = count - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    hull.resize(count > 1 ? count - 1 : count);
    return hull;
}

// Converts the beams of a tree, in the order of a walk, to its nodes.
class NodeCollector {
public:
    NodeCollector(const FacetNet& net, const ScreenView& view, double n, bool regions,
                  double pixel_area, EyeLight& light)
        : net_(net), view_(view), n_(n), regions_(regions), pixel_area_(pixel_area), light_(light) {
        front_of_facet_.assign(static_cast<std::size_t>(net.facets()), -1);
        for (std::size_t i = 0; i < light.fronts.size(); ++i)
            front_of_facet_[static_cast<std::size_t>(light.fronts[i].facet)] = static_cast<int>(i);
    }

    void add_branch(const BeamBranch& branch) {
        open_.clear();
        for (const Beam& beam : branch.beams) add_beam(branch, beam);
    }

private:
    void add_beam(const BeamBranch& branch, const Beam& beam) {
        const std::uint16_t* facets = branch.facets.data() + beam.facet;
        const ScreenPoint* corners = branch.corners.data() + beam.corner;
        const double area = 0.5 * pixel_area_ * doubled_area(corners, beam.corners);
        EyeFront& front = light_.fronts[static_cast<std::size_t>(front_of_facet_[facets[0]])];
        // Number of open nodes that contain this beam.
        std::size_t common = 0;
        while (common < open_.size() && common + 1 < beam.facets &&
               light_.exits[static_cast<std::size_t>(open_[common])].facet == facets[common + 1])
            ++common;
        open_.resize(common);
        for (std::size_t i = common + 1; i < beam.facets; ++i) open(facets[0], facets[i]);
        for (const int node : open_) {
            light_.exits[static_cast<std::size_t>(node)].area += area;
            if (!regions_) continue;
            std::vector<ScreenPoint>& outline = light_.regions[static_cast<std::size_t>(node)];
            outline.insert(outline.end(), corners, corners + beam.corners);
        }
        const double left = open_.empty()
                                ? 1 - front.reflectance
                                : light_.exits[static_cast<std::size_t>(open_.back())].remaining;
        front.residual += area * left;
    }

    void open(int front_facet, int facet) {
        EyeExit exit;
        exit.front = front_of_facet_[static_cast<std::size_t>(front_facet)];
        exit.facet = facet;
        exit.faces = static_cast<int>(open_.size()) + 2;
        double weight = 0;
        if (open_.empty()) {
            const Plane& plane = net_.plane(front_facet);
            weight = 1 - light_.fronts[static_cast<std::size_t>(exit.front)].reflectance;
            const double cosine = glm::dot(light_.towards_eye, plane.normal);
            const double q = std::sqrt((n_ - 1) * (n_ + 1) + cosine * cosine);
            exit.inside = glm::normalize((cosine - q) * plane.normal - light_.towards_eye);
        } else {
            const EyeExit& before = light_.exits[static_cast<std::size_t>(open_.back())];
            const Vec3& normal = net_.plane(before.facet).normal;
            exit.parent = open_.back();
            weight = before.remaining;
            exit.inside =
                glm::normalize(before.inside - 2 * glm::dot(before.inside, normal) * normal);
        }
        meet_face(net_.plane(facet), n_, exit, weight);
        open_.push_back(static_cast<int>(light_.exits.size()));
        light_.exits.push_back(exit);
        if (regions_) light_.regions.emplace_back();
    }

    const FacetNet& net_;
    const ScreenView& view_;
    double n_;
    bool regions_;
    double pixel_area_;
    EyeLight& light_;
    std::vector<int> front_of_facet_;
    std::vector<int> open_;  // indices of exits, from the second facet on
};

EyeFront front_of(const FrontFacet& seen, const Plane& plane, const Vec3& towards_eye, double n,
                  double pixel_area) {
    EyeFront front;
    front.facet = seen.facet;
    front.area = 0.5 * pixel_area * doubled_area(seen.outline.data(), seen.outline.size());
    const double cosine = std::clamp(glm::dot(towards_eye, plane.normal), 0.0, 1.0);
    front.reflectance = mean_reflection(1, n, cosine).mean;
    front.reflected = glm::normalize(2 * cosine * plane.normal - towards_eye);
    return front;
}

}  // namespace

EyeLightTracer::EyeLightTracer(const Solid& convex, std::function<bool()> goes_on)
    : net_(convex), goes_on_(std::move(goes_on)) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& corner : net_.corners()) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    middle_ = 0.5 * (low + high);
    double farthest = 0;
    for (const Vec3& corner : net_.corners())
        farthest = std::max(farthest, glm::length(corner - middle_));
    diameter_ = 2 * farthest;
}

Camera EyeLightTracer::camera_towards(const Vec3& towards_eye) const {
    Camera camera;
    camera.look_at = middle_;
    camera.position = middle_ + 2 * diameter_ * towards_eye;
    const Vec3 y{0, 1, 0}, z{0, 0, 1};
    camera.up = std::abs(towards_eye.y) < 0.9 ? y : z;
    camera.orthographic_width = k_room_around * diameter_;
    camera.width = camera.height = k_picture;
    return camera;
}

EyeLight EyeLightTracer::trace(const Vec3& towards_eye, double n,
                               const EyeLightLimits& limits) const {
    check(n > 1, "the index of a graded stone is above 1");
    const ScreenView view = screen_view(camera_towards(towards_eye));
    const double pixel = k_room_around * diameter_ / k_picture, pixel_area = pixel * pixel;
    EyeLight light;
    light.towards_eye = towards_eye;
    light.right = view.right;
    light.up = -glm::cross(view.forward, view.right);
    for (const FrontFacet& seen : front_facets(net_, view)) {
        light.fronts.push_back(front_of(seen, net_.plane(seen.facet), towards_eye, n, pixel_area));
        light.area += light.fronts.back().area;
    }
    BeamLimits beam_limits;
    beam_limits.depth = limits.faces;
    beam_limits.cut_weight = limits.cut_weight;
    // Exact for an eye infinitely far away: one direction per front facet.
    beam_limits.refraction = Refraction::parallel;
    BeamTree tree;
    const auto goes_on = [&](long long) { return !goes_on_ || goes_on_(); };
    if (!build_beams(net_, view, n, beam_limits, tree, goes_on)) throw Interrupted();
    NodeCollector collector(net_, view, n, limits.regions, pixel_area, light);
    for (std::size_t i = 0; i < tree.branch_count; ++i) {
        if (!goes_on(0)) throw Interrupted();
        collector.add_branch(tree.branches[i]);
    }
    // Area that no beam covers, by rounding, counts as not followed.
    std::vector<double> covered(light.fronts.size(), 0);
    for (const EyeExit& exit : light.exits) {
        if (exit.parent < 0) covered[static_cast<std::size_t>(exit.front)] += exit.area;
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
        EyeFront& front = light.fronts[i];
        if (covered[i] > 0) front.residual += (1 - front.reflectance) * (front.area - covered[i]);
    }
    // Convert pixels to the plane through the origin.
    const Vec3 corner = view.origin({0, 0});
    const ScreenPoint shift{glm::dot(corner, light.right), glm::dot(corner, light.up)};
    for (std::size_t i = 0; i < light.regions.size(); ++i) {
        if (i % k_outlines == 0 && !goes_on(0)) throw Interrupted();
        std::vector<ScreenPoint>& outline = light.regions[i];
        for (ScreenPoint& p : outline) p = {shift.x + pixel * p.x, shift.y - pixel * p.y};
        outline = convex_hull(std::move(outline));
    }
    return light;
}

}  // namespace culet
