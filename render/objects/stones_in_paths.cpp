// Stones as parts of light paths among objects.

#include <algorithm>

#include "render/objects/object_paths.h"
#include "render/reference/crystal_paths.h"
#include "render/reference/light_paths.h"

namespace culet {

namespace {

// Less important exits are followed with proportional probability: of a stone seen directly, and of
// one whose light other surfaces scatter.
constexpr double k_seen_threshold = 0.1, k_spread_threshold = 0.5;

// The part of a band within first .. first + count - 1.
Band part_of(const Band& band, int first, int count) {
    Band part = band;
    part.first = std::max(band.first, first);
    part.count = std::min(band.first + band.count, first + count) - part.first;
    for (NodeWeights& axis : part.absorption)
        std::copy_n(axis.begin() + (part.first - band.first), part.count, axis.begin());
    return part;
}

// Objects between parts of a stone.
class AroundStone : public Obstacles {
public:
    AroundStone(const SceneWithObjects& scene, int stone) : scene_(scene), stone_(stone) {}
    double nearest_distance(const Vec3& origin, const Vec3& direction) const override {
        return std::min(scene_.world.nearest(origin, direction, {-1, -1, stone_}).distance,
                        scene_.lights.nearest_distance(origin, direction));
    }

private:
    const SceneWithObjects& scene_;
    int stone_;
};

}  // namespace

// Gathers the light that arrives at a stone's exits.
class ObjectPaths::StoneSink {
public:
    StoneSink(ObjectPaths& outer, const WorldRay& ray, int stone, const Band& band, double weight,
              ArrivingLight& light)
        : outer_(outer),
          inner_(outer.scene_, band.first, band.count, outer.planes_, outer.random_),
          ray_(ray),
          stone_(stone),
          weight_(weight),
          count_(band.count),
          offset_(band.first - outer.first_),
          light_(light) {}

    void path_exits(const PathEnd& end, const PathTrace&) {
        const double power = end.coherency.power();
        const double weight = ask(end.at, end.direction, end.u, end.v, power, end.transmitted);
        if (weight == 0) return;
        for (int i = 0; i < count_; ++i) {
            const double share = weight_ * weight * end.transmitted[i];
            if (outer_.planes_ == 1) {
                light_[0][offset_ + i] += share * power * in_[0][i];
                continue;
            }
            const Stokes seen =
                stokes_of_light(end.coherency, {in_[0][i], in_[1][i], in_[2][i], in_[3][i]});
            for (int k = 0; k < 4; ++k) light_[k][offset_ + i] += share * seen[k];
        }
    }
    void path_exits(const Vec3& at, const Vec3& direction, const NodeWeights& share,
                    const PathTrace&) {
        const double weight = ask(at, direction, Vec3(0), Vec3(0), 1, share);
        if (weight == 0) return;
        for (int i = 0; i < count_; ++i)
            light_[0][offset_ + i] += weight_ * weight * share[i] * in_[0][i];
    }
    void remainder(const NodeWeights&) {}
    void absorbed(const NodeWeights&) {}
    void cut(const NodeWeights&) {}
    // They have mean 0.
    void roulette(const NodeWeights&) {}
    void choice_begins() {}
    void choice_ends(bool) {}

private:
    // Writes the arriving light to `in_` and returns its weight; 0: not followed.
    double ask(const Vec3& at, const Vec3& direction, const Vec3& u, const Vec3& v, double power,
               const NodeWeights& share) {
        const double most = *std::max_element(share.begin(), share.begin() + count_);
        WorldRay next{at, direction, u, v, {-1, -1, stone_}, ray_.medium};
        next.depth = ray_.depth + 1;
        next.importance = ray_.importance * power * most;
        const double threshold = ray_.depth == 0 ? k_seen_threshold : k_spread_threshold;
        return inner_.arriving_if_it_matters(next, threshold, in_);
    }

    ObjectPaths& outer_;
    ObjectPaths inner_;
    const WorldRay& ray_;
    int stone_;
    double weight_;
    int count_, offset_;
    ArrivingLight& light_;
    ArrivingLight in_;
};

void ObjectPaths::through_stone(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light) {
    const SceneWithObjects::ReadyStone& stone = scene_.stones[static_cast<std::size_t>(hit.stone)];
    const StoneBody& body = scene_.world.stone(hit.stone);
    const BodyHit entry{hit.part, hit.distance};
    const EyeRay eye{ray.origin, ray.direction};
    const AroundStone around(scene_, hit.stone);
    std::vector<const Band*> bands;
    for (const Band& band : stone.setup.bands) {
        if (band.first + band.count > first_ && band.first < first_ + count_)
            bands.push_back(&band);
    }
    // Scattered light is followed at only one of the stone's bands, chosen at random.
    double weight = 1;
    if (ray.depth > 0 && bands.size() > 1) {
        weight = static_cast<double>(bands.size());
        bands = {bands[random_.next() % bands.size()]};
    }
    for (const Band* any : bands) {
        const Band& whole = *any;
        const bool all = whole.first >= first_ && whole.first + whole.count <= first_ + count_;
        const Band part = all ? Band() : part_of(whole, first_, count_);
        const Band& band = all ? whole : part;
        StoneSink sink(*this, ray, hit.stone, band, weight, light);
        PathLimits limits = stone.limits;
        limits.seed = random_.next();
        limits.obstacles = &around;
        PathWork work = work_along_paths(stone.setup);
        work.rays = 1;
        if (stone.setup.general) {
            CrystalPaths<StoneSink> paths(body, band, limits, sink);
            paths.trace(eye, ray.u, ray.v, entry);
            work.events = static_cast<double>(paths.events());
        } else {
            PathTrace trace;
            LightPaths<StoneSink, false> paths(body.planes(), band, limits, sink, trace);
            paths.trace(eye, entry);
            work.events = static_cast<double>(trace.length);
        }
        spent_ns_ += price_ns(work);
    }
}

}  // namespace culet
