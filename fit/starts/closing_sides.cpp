#include "fit/starts/closing_sides.h"
#include "fit/starts/constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace culet {

namespace {

struct Sided {
    std::array<Vec3, 2> normal{};  // looking down, looking up
    double sigma = 0;              // radians
    bool has_two = false;
};

// One edge in the round of a facet: the neighbour, and for both sides of each facet the edge's
// vector and its variance.
struct Way {
    int neighbour = -1;
    std::array<std::array<Vec3, 2>, 2> along{};
    std::array<std::array<double, 2>, 2> variance{};
};

class Closing {
public:
    Closing(const FitModel& model, const std::vector<int>& known, double rough);

    bool has_turning() const { return !turning_.empty(); }
    void look();
    std::vector<int> sides(std::vector<int> known) const;

private:
    double misfit(std::size_t facet) const {
        Vec3 left(0);
        double variance = 0;
        for (const Way& w : ways_[facet]) {
            const auto own = std::size_t(up_[facet]), other = std::size_t(up_[w.neighbour]);
            left += w.along[own][other];
            variance += w.variance[own][other];
        }
        return std::min(glm::dot(left, left) / variance, k_closing.most_misfit);
    }
    double around(int facet) const {
        double sum = misfit(std::size_t(facet));
        for (const int n : near_[std::size_t(facet)]) sum += misfit(std::size_t(n));
        return sum;
    }
    double change(int facet) {
        const double before = around(facet);
        turn(facet);
        const double after = around(facet);
        turn(facet);
        return after - before;
    }
    void turn(int facet) { up_[std::size_t(facet)] ^= 1; }
    // A chain of best turns from one facet on (or from anywhere), cut where it gains most.
    struct Chain {
        double gain = 0;
        std::vector<int> turns;
    };
    Chain chain(const std::vector<int>& from, bool grows, int longest);

    std::vector<std::vector<Way>> ways_;
    std::vector<std::vector<int>> near_;  // neighbours
    std::vector<char> up_, may_turn_;
    std::vector<int> turning_;  // facets that may turn
};

std::vector<Sided> sided_normals(const FitModel& model, const std::vector<int>& known,
                                 double rough) {
    const Shape& mesh = model.mesh_shape();
    const std::size_t count = mesh.normals.size();
    std::vector<std::optional<double>> tilt(count), turn(count);
    std::vector<double> sigmas(count, 0);
    for (const Reading& r : model.readings()) {
        if (r.aggregate != Aggregate::single || r.datum.kind != Datum::Kind::up) continue;
        if (r.kind != ReadingKind::inclination && r.kind != ReadingKind::azimuth) continue;
        const auto f = std::size_t(r.facets[0]);
        (r.kind == ReadingKind::inclination ? tilt : turn)[f] = r.value;
        const double part = r.kind == ReadingKind::azimuth && tilt[f] ? std::sin(*tilt[f]) : 1;
        sigmas[f] = std::max(sigmas[f], part * std::hypot(r.sigma, r.rounding / std::sqrt(12.0)));
    }
    std::vector<Sided> result(count);
    for (std::size_t f = 0; f < count; ++f) {
        Sided& s = result[f];
        if (static_cast<int>(f) != model.frame().up_facet() && tilt[f] && turn[f]) {
            const Vec3 level{std::cos(*turn[f]), std::sin(*turn[f]), 0};
            const double z = std::cos(*tilt[f]), flat = std::sin(*tilt[f]);
            s.normal = {flat * level - Vec3{0, 0, z}, flat * level + Vec3{0, 0, z}};
            s.sigma = sigmas[f];
            s.has_two = known[f] == 0;
            continue;
        }
        const std::vector<int>& loop = model.mesh_outline()->loops[f];
        Vec3 mean(0);
        for (const int corner : loop)
            mean += mesh.points[std::size_t(corner)] / double(loop.size());
        double spread = 0;
        for (const int corner : loop) {
            const Vec3 off = mesh.points[std::size_t(corner)] - mean;
            spread += glm::dot(off, off);
        }
        s.normal = {mesh.normals[f], mesh.normals[f]};
        s.sigma = static_cast<int>(f) == model.frame().up_facet()
                      ? 0
                      : rough / std::sqrt(std::max(1e-12, spread / 2));
    }
    return result;
}

// By the edge's facets.
using ReadEdges = std::map<std::pair<int, int>, const Reading*>;
ReadEdges read_edges(const FitModel& model) {
    ReadEdges read;
    for (const Reading& r : model.readings()) {
        if (r.kind != ReadingKind::edge || r.aggregate != Aggregate::single) continue;
        read.emplace(std::minmax(r.facets[0], r.facets[1]), &r);
    }
    return read;
}

Way way_of(int neighbour, const Sided& a, const Sided& b, double length, double sigma) {
    Way way;
    way.neighbour = neighbour;
    const double turn = std::hypot(a.sigma, b.sigma);
    for (const std::size_t i : {0, 1}) {
        for (const std::size_t k : {0, 1}) {
            const Vec3 u = glm::cross(a.normal[i], b.normal[k]);
            const double sine = std::max(k_closing.least_sine, glm::length(u));
            const double swing = std::min(k_closing.any_direction, turn / sine);
            way.along[i][k] = u * (length / sine);
            way.variance[i][k] =
                k_closing.rounding + sigma * sigma + length * length * swing * swing;
        }
    }
    return way;
}

Closing::Closing(const FitModel& model, const std::vector<int>& known, double rough) {
    const std::vector<Sided> sided = sided_normals(model, known, rough);
    const Shape& mesh = model.mesh_shape();
    const std::size_t count = sided.size();
    ways_.resize(count);
    near_.resize(count);
    may_turn_.assign(count, 0);
    for (std::size_t f = 0; f < count; ++f) {
        // The mesh's corners round a facet show its side better than the plane nearest to them,
        // about which a long thin facet can turn over.
        Vec3 area(0);
        const std::vector<int>& loop = model.mesh_outline()->loops[f];
        for (std::size_t k = 0; k < loop.size(); ++k) {
            area += glm::cross(mesh.points[std::size_t(loop[k])],
                               mesh.points[std::size_t(loop[(k + 1) % loop.size()])]);
        }
        up_.push_back(known[f] == 0 ? area.z > 0 : known[f] > 0);
        if (!sided[f].has_two) continue;
        may_turn_[f] = 1;
        turning_.push_back(static_cast<int>(f));
    }
    const ReadEdges read = read_edges(model);
    for (const Edge& e : model.edges().edges) {
        const auto at = read.find(std::minmax(e.left, e.right));
        double length =
            glm::distance(mesh.points[std::size_t(e.from)], mesh.points[std::size_t(e.to)]);
        double sigma = std::hypot(std::numbers::sqrt2 * rough, k_closing.drawn_length * length);
        if (at != read.end()) {
            const Reading& r = *at->second;
            length = r.value / model.frame().unit_of(r);
            sigma = std::hypot(r.sigma, r.rounding / std::sqrt(12.0)) / model.frame().unit_of(r);
        }
        for (const auto& [own, other] : {std::pair{e.left, e.right}, std::pair{e.right, e.left}}) {
            ways_[std::size_t(own)].push_back(
                way_of(other, sided[std::size_t(own)], sided[std::size_t(other)], length, sigma));
            near_[std::size_t(own)].push_back(other);
        }
    }
    for (std::vector<int>& n : near_) {
        std::sort(n.begin(), n.end());
        n.erase(std::unique(n.begin(), n.end()), n.end());
    }
}

Closing::Chain Closing::chain(const std::vector<int>& from, bool grows, int longest) {
    Chain best;
    std::vector<int> turned, front = from;
    std::vector<char> is_turned(up_.size(), 0), in_front(up_.size(), 0);
    for (const int f : front) in_front[std::size_t(f)] = 1;
    double height = 0;
    for (int k = 0; k < longest && height < k_closing.highest; ++k) {
        int next = -1;
        double least = std::numeric_limits<double>::infinity();
        for (const int f : front) {
            if (is_turned[std::size_t(f)]) continue;
            const double by = change(f);
            if (!(by < least)) continue;
            least = by;
            next = f;
        }
        if (next < 0) break;
        turn(next);
        is_turned[std::size_t(next)] = 1;
        turned.push_back(next);
        height += least;
        if (height < -best.gain - k_closing.least_gain) best = {-height, turned};
        if (!grows) continue;
        for (const int n : near_[std::size_t(next)]) {
            if (!may_turn_[std::size_t(n)] || in_front[std::size_t(n)]) continue;
            in_front[std::size_t(n)] = 1;
            front.push_back(n);
        }
    }
    for (const int f : turned) turn(f);
    return best;
}

void Closing::look() {
    for (int round = 0; round < k_closing.most_rounds; ++round) {
        // Only near facets whose edges do not close.
        std::vector<int> suspects;
        for (const int f : turning_) {
            const auto& n = near_[std::size_t(f)];
            if (misfit(std::size_t(f)) > k_closing.open ||
                std::any_of(n.begin(), n.end(), [&](int other) {
                    return misfit(std::size_t(other)) > k_closing.open;
                })) {
                suspects.push_back(f);
            }
        }
        Chain best = chain(suspects, false, k_closing.chain);
        if (best.turns.empty()) {
            for (const int f : suspects) {
                Chain other = chain({f}, true, k_closing.local_chain);
                if (other.gain > best.gain + k_closing.least_gain) best = std::move(other);
            }
        }
        if (best.turns.empty()) return;
        for (const int f : best.turns) turn(f);
    }
}

std::vector<int> Closing::sides(std::vector<int> known) const {
    Closing here = *this;
    for (const int f : turning_) {
        if (here.change(f) > k_closing.known) known[std::size_t(f)] = up_[std::size_t(f)] ? 1 : -1;
    }
    return known;
}

}  // namespace

std::vector<int> closing_sides(const FitModel& model, std::vector<int> known, double rough) {
    Closing closing(model, known, rough);
    if (!closing.has_turning()) return known;
    closing.look();
    return closing.sides(std::move(known));
}

}  // namespace culet
