#pragma once
// The exact tree of light paths behind one eye ray, for stones of every optical class and shape,
// with polarisation at both ends: the judge. light_paths.h is its special case for isotropic,
// convex stones seen without a polariser.
//
// Inside the stone a node of the tree is one mode, or both modes of one K while they are coherent.
// Two modes that leave a face together meet the next one at points x0, x1 with retardation
// G = (N1 - N0).x. Beyond the coherence length of the band's light they are two nodes, each
// followed exactly. Below it they are one: their coherency gets the phase 2 pi G / wavelength and
// the factor sinc^2(pi G / coherence length), the mean over a triangular band, which falls to 0
// where they part; and they go on from the power-weighted means of their points and of their K.
// The mean is exact where the two K are one (isotropic stones, plates with parallel faces) and off
// by the order of the birefringence otherwise. A face acts on amplitudes: unitary, so that
//   leaves + remainder + absorbed + cut + gambled = 1
// for every ray.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "render/eye_coherency.h"
#include "render/path.h"
#include "render/scene.h"
#include "render/stone_body.h"

namespace culet {

// A Sink has
//   void leaf(const PathEnd&, const PathTrace&);
//   void remainder(const NodeWeights&), absorbed(const NodeWeights&), cut(const NodeWeights&);
//   void gambled(const NodeWeights&): lost to Russian roulette, less what was won: of mean 0.
//   void choice_begins(), choice_ends(bool second): two independent estimates, each of half weight,
//     of what a subtree brings; their difference tells the variance.
template <class Sink>
class CrystalPaths {
public:
    CrystalPaths(const StoneBody& body, const Band& band, const PathLimits& limits, Sink& sink)
        : body_(body), band_(band), limits_(limits), sink_(sink), random_(limits.seed) {}

    /// Follows an eye ray that enters the stone at `entry`; `x`, `y`: the eye's polarisations.
    void trace(const EyeRay& ray, const Vec3& x, const Vec3& y, const BodyHit& entry) {
        splits_ = 0;
        choosing_ = false;
        trace_.length = 0;
        Node eye;
        eye.inside = false;
        eye.at = body_.on_facet(entry.facet, ray.origin + entry.distance * ray.direction);
        eye.direction = ray.direction;
        eye.u = x;
        eye.v = y;
        eye.c = EyeCoherency::of_eye();
        eye.tau.fill(1.0);
        eye.event = 1;
        waiting_.clear();
        waiting_.clear();
        Node first, second;
        meet_from_outside(eye, entry.facet, first, second);
        const int count = after_hit(first, second);
        // The first face is never left to chance: what waits there waits for `follow` to end.
        const int length = trace_.length;
        if (count > 0) follow(first);
        trace_.length = length;
        if (count > 1) follow(second);
    }

    /// True when the last tree was larger than `most_splits`.
    bool sampled() const { return splits_ > limits_.most_splits; }
    /// Largest |sum of powers - 1| of a crystal's face before it was put right.
    double worst_imbalance() const { return worst_imbalance_; }

private:
    struct Node {
        bool inside = true;
        Vec3 at{0, 0, 0};
        int facet = -1;                                   // that it starts from
        std::array<CrystalMode, 2> modes;                 // inside
        Vec3 direction{0, 0, 0}, u{0, 0, 0}, v{0, 0, 0};  // outside
        BodyHit again;                                    // outside: where it meets the stone
        EyeCoherency c;
        NodeWeights tau{};
        int event = 0;  // that ends it
        double power() const { return c.power(); }
    };

    NodeWeights weighted(double weight, const NodeWeights& tau) const {
        NodeWeights result;  // the first band_.count are meant
        for (int i = 0; i < band_.count; ++i) result[i] = weight * tau[i];
        return result;
    }
    double largest(const Node& node) const {
        double most = 0;
        for (int i = 0; i < band_.count; ++i) most = std::max(most, node.tau[i]);
        return node.power() * most;
    }
    void push(int facet) {
        trace_.facets[trace_.length] = facet;
        trace_.modes[trace_.length] = 'i';
        ++trace_.length;
    }

    // Waves (u, v) of a ray in the face's own s and p.
    static Eigen::Matrix2d turned(const Vec3& u, const Vec3& v, const Vec3& s, const Vec3& p) {
        Eigen::Matrix2d turn;
        turn << glm::dot(s, u), glm::dot(s, v), glm::dot(p, u), glm::dot(p, v);
        return turn;
    }

    // `node` arrives at `facet` from outside, at node.at.
    void meet_from_outside(const Node& node, int facet, Node& inner, Node& outer) {
        const Vec3 n_in = -body_.normal(facet);
        const Vec3& d = node.direction;
        const double cosine = std::max(glm::dot(d, n_in), 0.0);
        const Vec3 K = band_.n_outside * (d - cosine * n_in);
        const CrystalEntry entry = enter_crystal(band_.crystal, band_.n_outside, K, n_in);
        worst_imbalance_ = std::max(worst_imbalance_, entry.imbalance);
        push(facet);
        const Vec3& s = entry.s;
        const Eigen::Matrix2d turn = turned(node.u, node.v, s, glm::cross(d, s));
        Eigen::Matrix2cd into, back;
        into << entry.into[0][0], entry.into[1][0], entry.into[0][1], entry.into[1][1];
        back << entry.back[0][0], entry.back[1][0], entry.back[0][1], entry.back[1][1];

        outer.inside = false;
        outer.at = node.at;
        outer.facet = facet;
        outer.direction = glm::normalize(d - 2 * cosine * n_in);
        outer.u = s;
        outer.v = glm::cross(outer.direction, s);
        outer.c = node.c.through(back * turn);
        outer.tau = node.tau;
        outer.event = node.event + 1;

        inner.inside = true;
        inner.at = node.at;
        inner.facet = facet;
        inner.modes = entry.modes;
        inner.c = node.c.through(into * turn);
        inner.tau = node.tau;
        inner.event = node.event + 1;
    }

    // What a face makes of the modes that arrive: a matrix column each.
    static Eigen::Vector2cd column(const std::array<Complex, 2>& a) { return {a[0], a[1]}; }

    void leave(const CrystalHit& hit, const Node& from, const Vec3& at, int facet,
               const EyeCoherency& c, Node& outer) const {
        outer.inside = false;
        outer.at = at;
        outer.facet = facet;
        outer.direction = hit.exit_direction;
        outer.u = hit.s;
        outer.v = glm::cross(hit.exit_direction, hit.s);
        outer.c = c;
        outer.tau = from.tau;
        outer.event = from.event + 1;
    }
    void stay(const CrystalHit& hit, const Node& from, const Vec3& at, int facet,
              const EyeCoherency& c, Node& inner) const {
        inner.inside = true;
        inner.at = at;
        inner.facet = facet;
        inner.modes = hit.modes;
        inner.c = c;
        inner.tau = from.tau;
        inner.event = from.event + 1;
    }

    double alpha(const CrystalMode& mode, int node) const {
        const std::array<double, 3> shares = absorption_shares(band_.crystal, mode);
        double sum = 0;
        for (int i = 0; i < 3; ++i) sum += shares[i] * band_.absorption[i][node];
        return sum;
    }

    // One mode of `node` reaches its face.
    void meet_alone(Node& node, int m, Node& inner, Node& outer) {
        const CrystalMode& mode = node.modes[m];
        const BodyHit found = body_.exit(node.at, mode.ray, node.facet);
        const Vec3 at = body_.on_facet(found.facet, node.at + found.distance * mode.ray);
        if (band_.absorbs) {
            const std::array<double, 3> shares = absorption_shares(band_.crystal, mode);
            NodeWeights lost{};
            for (int i = 0; i < band_.count; ++i) {
                double a = 0;
                for (int axis = 0; axis < 3; ++axis) a += shares[axis] * band_.absorption[axis][i];
                const double after = node.tau[i] * std::exp(-a * found.distance);
                lost[i] = node.c.power(m) * (node.tau[i] - after);
                node.tau[i] = after;
            }
            sink_.absorbed(lost);
        }
        const CrystalHit hit =
            hit_face(band_.crystal, band_.n_outside, mode, body_.normal(found.facet));
        worst_imbalance_ = std::max(worst_imbalance_, hit.imbalance);
        push(found.facet);
        leave(hit, node, at, found.facet, node.c.through_one(m, hit.out[0], hit.out[1]), outer);
        stay(hit, node, at, found.facet, node.c.through_one(m, hit.amplitude[0], hit.amplitude[1]),
             inner);
    }

    // Both modes of `node` as one, when they are coherent enough at the face where both arrive;
    // false when not.
    bool meet_together(Node& node, Node& inner, Node& outer) {
        const bool isotropic = band_.crystal.isotropic();
        if (!isotropic && !(band_.coherence_length > 0)) return false;
        const BodyHit first = body_.exit(node.at, node.modes[0].ray, node.facet);
        const BodyHit second =
            isotropic ? first : body_.exit(node.at, node.modes[1].ray, node.facet);
        if (first.facet != second.facet) return false;
        const int facet = first.facet;
        const Vec3& n = body_.normal(facet);
        const std::array<double, 2> power{node.c.power(0), node.c.power(1)};
        const double share = power[1] / (power[0] + power[1]);
        const std::array<double, 2> length{first.distance, second.distance};
        const Vec3 step =
            (1 - share) * length[0] * node.modes[0].ray + share * length[1] * node.modes[1].ray;
        const Vec3 at = body_.on_facet(facet, node.at + step);
        const double retardation =
            isotropic ? 0 : glm::dot(node.modes[1].wave - node.modes[0].wave, at - node.at);
        if (!isotropic && !(std::abs(retardation) < band_.coherence_length)) return false;

        const Vec3 N = (1 - share) * node.modes[0].wave + share * node.modes[1].wave;
        const Vec3 K = N - glm::dot(N, n) * n;
        const std::array<CrystalMode, 2> arriving = modes_towards(band_.crystal, K, n);
        for (const CrystalMode& mode : arriving) {
            if (!mode.propagates || !(glm::dot(mode.ray, n) > 0)) return false;
        }
        absorb_together(node, length);
        if (retardation != 0) {
            const double x = std::numbers::pi * retardation / band_.coherence_length;
            const double sinc = x != 0 ? std::sin(x) / x : 1;
            // E_0 conj(E_1) turns by N0 - N1.
            const Complex turn =
                std::polar(sinc * sinc, -2 * std::numbers::pi * retardation / band_.wavelength);
            for (Eigen::Matrix2cd* block : {&node.c.xx, &node.c.yy, &node.c.xy}) {
                (*block)(0, 1) *= turn;
                (*block)(1, 0) *= std::conj(turn);
            }
        }
        // From the modes that left to the modes of the mean K: the same waves, or near an optic
        // axis, where a mode's vibration is arbitrary, the rotation between them.
        Eigen::Matrix2d overlap;
        for (int a = 0; a < 2; ++a) {
            for (int b = 0; b < 2; ++b)
                overlap(a, b) = glm::dot(magnetic(arriving[a]), magnetic(node.modes[b]));
        }
        node.c = node.c.through(nearest_rotation(overlap));
        const CrystalHit hit0 = hit_face(band_.crystal, band_.n_outside, arriving[0], K, n);
        const CrystalHit hit1 = hit_face(band_.crystal, band_.n_outside, arriving[1], K, n);
        worst_imbalance_ = std::max({worst_imbalance_, hit0.imbalance, hit1.imbalance});
        Eigen::Matrix2cd out, reflected;
        out << column(hit0.out), column(hit1.out);
        reflected << column(hit0.amplitude), column(hit1.amplitude);
        push(facet);
        EyeCoherency leaving = node.c.through(out), staying = node.c.through(reflected);
        // Unitary to rounding only, and the mean K makes the two columns no more than that: put
        // the balance right.
        const double before = node.c.power(), after = leaving.power() + staying.power();
        if (after > 0) {
            leaving.scale(before / after);
            staying.scale(before / after);
        }
        leave(hit0, node, at, facet, leaving, outer);
        stay(hit0, node, at, facet, staying, inner);
        return true;
    }

    // Unit vector along H of a travelling wave, which is real and normal to N.
    static Vec3 magnetic(const CrystalMode& mode) {
        return glm::normalize(Vec3(mode.H.x.real(), mode.H.y.real(), mode.H.z.real()));
    }
    // The orthogonal matrix next to a 2x2 one (its polar factor).
    static Eigen::Matrix2d nearest_rotation(const Eigen::Matrix2d& m) {
        Eigen::Matrix2d nearest;
        if (m(0, 0) * m(1, 1) >= m(0, 1) * m(1, 0)) {
            const double c = m(0, 0) + m(1, 1), s = m(1, 0) - m(0, 1), r = std::hypot(c, s);
            nearest << c / r, -s / r, s / r, c / r;
        } else {
            const double c = m(0, 0) - m(1, 1), s = m(1, 0) + m(0, 1), r = std::hypot(c, s);
            nearest << c / r, s / r, s / r, -c / r;
        }
        return nearest;
    }

    // Both modes at once: a common factor on tau where all are absorbed alike (isotropic stones),
    // else on the coherency, of the band's one wavelength.
    void absorb_together(Node& node, const std::array<double, 2>& length) {
        if (!band_.absorbs) return;
        NodeWeights lost{};
        if (band_.crystal.isotropic()) {
            for (int i = 0; i < band_.count; ++i) {
                const double after = node.tau[i] * std::exp(-band_.absorption[0][i] * length[0]);
                lost[i] = node.power() * (node.tau[i] - after);
                node.tau[i] = after;
            }
        } else {
            const double before = node.power();
            Eigen::Matrix2cd fade = Eigen::Matrix2cd::Zero();
            for (int m = 0; m < 2; ++m)
                fade(m, m) = std::exp(-0.5 * alpha(node.modes[m], 0) * length[m]);
            node.c = node.c.through(fade);
            lost[0] = (before - node.power()) * node.tau[0];
        }
        sink_.absorbed(lost);
    }

    // What leaves for good is a leaf; what stays, or meets the stone again, goes on. Returns how
    // many go on; a single one is left in `inner`.
    int after_hit(Node& inner, Node& outer) {
        bool meets = false;
        if (outer.power() > 0) {
            const auto again = body_.reentry(outer.at, outer.direction, outer.facet);
            meets = again.has_value();
            if (again) {
                outer.again = *again;
            } else {
                sink_.leaf({outer.at, outer.direction, outer.u, outer.v, outer.c, outer.tau},
                           trace_);
            }
        }
        const bool stays = inner.power() > 0;
        if (meets && !stays) inner = outer;
        return stays + meets;
    }

    // One event, or the parting of two modes that are no longer coherent.
    int step(Node& node, Node& first, Node& second) {
        char& mode = trace_.modes[trace_.length - 1];
        if (!node.inside) {
            mode = 'a';
            node.at =
                body_.on_facet(node.again.facet, node.at + node.again.distance * node.direction);
            meet_from_outside(node, node.again.facet, first, second);
        } else if (node.c.power(0) > 0 && node.c.power(1) > 0) {
            mode = band_.crystal.isotropic() ? 'i' : 'c';
            if (!meet_together(node, first, second)) {
                first = second = node;
                keep_only(0, first.c);
                keep_only(1, second.c);
                return 2;
            }
        } else {
            const int m = node.c.power(0) > 0 ? 0 : 1;
            mode = static_cast<char>(node.modes[m].kind);
            meet_alone(node, m, first, second);
        }
        return after_hit(first, second);
    }
    static void keep_only(int m, EyeCoherency& c) {
        for (Eigen::Matrix2cd* block : {&c.xx, &c.yy, &c.xy}) {
            block->row(1 - m).setZero();
            block->col(1 - m).setZero();
        }
    }

    // The tree that hangs on a node, depth first; `node` is used up. What waits is on a list,
    // because a tree may be as deep as a path is long.
    void follow(Node& node) {
        const std::size_t others = waiting_.size();
        Node first, second;
        for (;;) {
            int count = stops(node) ? 0 : step(node, first, second);
            if (count == 2) count = branch(first, second);
            if (count > 0) {
                node = first;
            } else {
                if (waiting_.size() == others) return;
                node = waiting_.back().node;
                trace_.length = waiting_.back().length;
                waiting_.pop_back();
            }
        }
    }

    // Two go on: the second waits, or one is chosen, or both are seen to by two estimates. Returns
    // whether `first` goes on.
    int branch(Node& first, Node& second) {
        if (choosing_) {
            choose(first, second);
            return 1;
        }
        if (limits_.split_weight <= largest(first) + largest(second) &&
            ++splits_ <= limits_.most_splits) {
            waiting_.push_back({second, trace_.length});
            return 1;
        }
        twice([&] {
            Node chosen = first, other = second;
            choose(chosen, other);
            chosen.c.scale(0.5);
            follow(chosen);
        });
        return 0;
    }

    // One of two, by power, with the weight of both; in `first`.
    void choose(Node& first, Node& second) {
        const double power_first = first.power(), power_second = second.power();
        const double whole = power_first + power_second;
        const bool stay = uniform() * whole < power_first;
        if (!stay) first = second;
        first.c.scale(whole / (stay ? power_first : power_second));
    }

    // Two independent estimates of half weight, from here to the end of what hangs on it. From then
    // on branches are chosen, so that nothing waits.
    template <class Estimate>
    void twice(Estimate&& estimate) {
        const int length = trace_.length;
        choosing_ = true;
        for (const bool second : {false, true}) {
            trace_.length = length;
            sink_.choice_begins();
            estimate();
            sink_.choice_ends(second);
        }
        choosing_ = false;
    }

    // The depth limit, the weight cut and the roulette.
    bool stops(Node& node) {
        if (node.event > limits_.depth) {
            sink_.remainder(weighted(node.power(), node.tau));
            return true;
        }
        const double weight = largest(node);
        if (!(weight < limits_.cut_weight)) return false;
        if (!limits_.roulette) {
            sink_.cut(weighted(node.power(), node.tau));
            return true;
        }
        if (!choosing_) {
            node.c.scale(0.5);
            twice([&] {
                Node half = node;
                follow(half);
            });
            return true;
        }
        // Survives with the probability weight / cut_weight, and then weighs cut_weight.
        if (uniform() * limits_.cut_weight >= weight) {
            sink_.gambled(weighted(node.power(), node.tau));
            return true;
        }
        const double gain = limits_.cut_weight / weight;
        sink_.gambled(weighted(node.power() * (1 - gain), node.tau));
        node.c.scale(gain);
        return false;
    }

    // SplitMix64 (Steele, Lea & Flood 2014): a stream fixed by the seed.
    double uniform() {
        random_ += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = random_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

    const StoneBody& body_;
    const Band& band_;
    PathLimits limits_;
    Sink& sink_;
    std::uint64_t random_;
    PathTrace trace_;
    struct Waiting {
        Node node;
        int length;  // of the trace where it starts
    };
    std::vector<Waiting> waiting_;
    int splits_ = 0;
    bool choosing_ = false;
    double worst_imbalance_ = 0;
};

}  // namespace culet
