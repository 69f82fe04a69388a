#include "render/grade/fire.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "render/beams/screen_region.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Finds exits by their sequence of facets.
class ExitIndex {
public:
    explicit ExitIndex(const EyeLight& light) : fronts_(light.fronts.size()) {
        children_.reserve(2 * light.exits.size());
        for (std::size_t i = 0; i < light.exits.size(); ++i) {
            const EyeExit& exit = light.exits[i];
            children_.emplace(key(exit.parent, exit.front, exit.facet), static_cast<int>(i));
        }
    }
    /// Returns -1 if there is none.
    int child(int parent, int front, int facet) const {
        const auto found = children_.find(key(parent, front, facet));
        return found == children_.end() ? -1 : found->second;
    }

private:
    std::uint64_t key(int parent, int front, int facet) const {
        const std::size_t node = parent < 0 ? static_cast<std::size_t>(front)
                                            : fronts_ + static_cast<std::size_t>(parent);
        return (static_cast<std::uint64_t>(node) << 16) | static_cast<std::uint64_t>(facet);
    }
    std::size_t fronts_;
    std::unordered_map<std::uint64_t, int> children_;
};

// Area common to three convex, counter-clockwise outlines.
double common_area(RegionCutter& cutter, const std::vector<ScreenPoint>& a,
                   const std::vector<ScreenPoint>& b, const std::vector<ScreenPoint>& c) {
    if (a.size() < 3 || b.size() < 3 || c.size() < 3) return 0;
    cutter.take(a.data(), a.size(), b.size() + c.size());
    for (const std::vector<ScreenPoint>* other : {&b, &c}) {
        for (std::size_t i = 0; i < other->size(); ++i) {
            const ScreenPoint& p = (*other)[i];
            const ScreenPoint& q = (*other)[(i + 1) % other->size()];
            const double dx = q.x - p.x, dy = q.y - p.y;
            const auto [low, high] = cutter.measure({-dy, dx, dy * p.x - dx * p.y});
            if (!(high > 0)) return 0;
            if (low < 0) cutter.cut();
            if (cutter.count() < 3) return 0;
        }
    }
    return 0.5 * doubled_area(cutter.corners(), cutter.count());
}

}  // namespace

void Fire::add(const Fire& other, double factor) {
    // `spread` is a mean over `matched`.
    const double all = matched + factor * other.matched;
    if (all > 0) spread = (spread * matched + other.spread * factor * other.matched) / all;
    separated += factor * other.separated;
    spectral += factor * other.spectral;
    matched = all;
}

Fire fire_of(const std::array<EyeLight, 3>& colours, const std::vector<bool>& crown,
             const Vec3& axis, double view_cone) {
    const EyeLight &blue = colours[0], &green = colours[1], &red = colours[2];
    const ExitIndex in_green(green), in_red(red);
    const double cos_view = std::cos(view_cone), apart = radians(k_fire_apart_deg);
    const double pupil = radians(k_pupil_deg);
    RegionCutter cutter;
    Fire fire;
    double spread_sum = 0;
    std::vector<std::array<int, 2>> partners(blue.exits.size(), {-1, -1});
    for (std::size_t i = 0; i < blue.exits.size(); ++i) {
        const EyeExit& b = blue.exits[i];
        std::array<int, 2> above{-1, -1};
        if (b.parent >= 0) {
            above = partners[static_cast<std::size_t>(b.parent)];
            if (above[0] < 0 || above[1] < 0) continue;
        }
        partners[i] = {in_green.child(above[0], b.front, b.facet),
                       in_red.child(above[1], b.front, b.facet)};
        if (partners[i][0] < 0 || partners[i][1] < 0) continue;
        const EyeExit& g = green.exits[static_cast<std::size_t>(partners[i][0])];
        const EyeExit& r = red.exits[static_cast<std::size_t>(partners[i][1])];
        const double energy = std::min({b.weight, g.weight, r.weight});
        if (!(energy > 0) || !crown[static_cast<std::size_t>(b.facet)]) continue;
        if (glm::dot(b.direction, axis) < cos_view || glm::dot(g.direction, axis) < cos_view ||
            glm::dot(r.direction, axis) < cos_view)
            continue;
        const double share =
            energy * common_area(cutter, blue.regions[i],
                                 green.regions[static_cast<std::size_t>(partners[i][0])],
                                 red.regions[static_cast<std::size_t>(partners[i][1])]);
        const double fan = angle_between(r.direction, b.direction);
        fire.matched += share;
        spread_sum += share * fan;
        if (fan >= apart) fire.separated += share;
        if (fan > pupil) fire.spectral += share * (1 - pupil / fan);
    }
    fire.spread = fire.matched > 0 ? spread_sum / fire.matched : 0;
    fire.matched /= blue.area;
    fire.separated /= blue.area;
    fire.spectral /= blue.area;
    return fire;
}

}  // namespace culet
