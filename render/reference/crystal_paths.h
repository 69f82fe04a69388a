#pragma once
// The exact tree of light paths behind one eye ray, for stones of every optical class and shape,
// with polarisation at both ends: the reference. light_paths.h is its special case for isotropic,
// convex stones seen without a polariser.
//
// A face is a unitary matrix on amplitudes, so for every ray
//   exits + remainder + absorbed + cut + roulette = 1

#include <algorithm>
#include <vector>

#include "render/optics/random.h"
#include "render/reference/crystal_node.h"
#include "render/scene/scene.h"

namespace culet {

// A Sink has
//   void path_exits(const PathEnd&, const PathTrace&);
//   void remainder(const NodeWeights&), absorbed(const NodeWeights&), cut(const NodeWeights&);
//   void roulette(const NodeWeights&): Russian roulette's losses minus its gains, of mean 0.
//   void choice_begins(), choice_ends(bool second): enclose two independent estimates of a subtree,
//     each of half weight; their difference gives the variance.
template <class Sink>
class CrystalPaths {
public:
    CrystalPaths(const StoneBody& body, const Band& band, const PathLimits& limits, Sink& sink)
        : body_(body),
          band_(band),
          limits_(limits),
          sink_(sink),
          random_(limits.seed),
          steps_(body, band) {}

    /// Follows an eye ray that enters the stone at `entry`; `x`, `y`: the eye's polarisations.
    void trace(const EyeRay& ray, const Vec3& x, const Vec3& y, const BodyHit& entry) {
        splits_ = 0;
        choosing_ = false;
        trace_.length = 0;
        CrystalNode eye;
        eye.inside = false;
        eye.at = body_.on_facet(entry.facet, ray.origin + entry.distance * ray.direction);
        eye.direction = ray.direction;
        eye.u = x;
        eye.v = y;
        eye.c = EyeCoherency::of_eye();
        eye.tau.fill(1.0);
        eye.event = 1;
        waiting_.clear();
        CrystalNode first, second;
        steps_.meet_from_outside(eye, entry.facet, first, second);
        push(entry.facet);
        const int count = after_hit(first, second);
        // The first face is never left to chance: its other branch waits for `follow` to end.
        const int length = trace_.length;
        if (count > 0) follow(first);
        trace_.length = length;
        if (count > 1) follow(second);
    }

    /// True when the last tree was larger than `most_splits`.
    bool sampled() const { return splits_ > limits_.most_splits; }
    /// Faces hit so far, on all branches of all trees.
    long long events() const { return events_; }
    /// Largest |sum of powers - 1| at a crystal's face, which is then normalised.
    double worst_imbalance() const { return steps_.worst_imbalance(); }

private:
    NodeWeights weighted(double weight, const NodeWeights& tau) const {
        NodeWeights result;  // only the first band_.count are set
        for (int i = 0; i < band_.count; ++i) result[i] = weight * tau[i];
        return result;
    }
    double largest(const CrystalNode& node) const {
        double most = 0;
        for (int i = 0; i < band_.count; ++i) most = std::max(most, node.tau[i]);
        return node.power() * most;
    }
    void push(int facet) {
        trace_.facets[trace_.length] = facet;
        trace_.modes[trace_.length] = 'i';
        ++trace_.length;
    }

    // Reports an exit for what exits for good. Returns how many nodes go on (inside, or to meet
    // the stone again); a single one is left in `inner`.
    int after_hit(CrystalNode& inner, CrystalNode& outer) {
        bool meets = false;
        if (outer.power() > 0) {
            auto again = body_.reentry(outer.at, outer.direction, outer.facet);
            if (again && limits_.obstacles != nullptr &&
                limits_.obstacles->nearest_distance(outer.at, outer.direction) < again->distance)
                again.reset();
            meets = again.has_value();
            if (again) {
                outer.again = *again;
            } else {
                sink_.path_exits({outer.at, outer.direction, outer.u, outer.v, outer.c, outer.tau},
                                 trace_);
            }
        }
        const bool stays = inner.power() > 0;
        if (meets && !stays) inner = outer;
        return stays + meets;
    }

    // One event, or the split of two modes that are no longer coherent.
    int step(CrystalNode& node, CrystalNode& first, CrystalNode& second) {
        char& mode = trace_.modes[trace_.length - 1];
        NodeWeights absorbed;
        ++events_;
        if (!node.inside) {
            mode = 'a';
            node.at =
                body_.on_facet(node.again.facet, node.at + node.again.distance * node.direction);
            steps_.meet_from_outside(node, node.again.facet, first, second);
        } else if (node.c.power(0) > 0 && node.c.power(1) > 0) {
            mode = band_.crystal.isotropic() ? 'i' : 'c';
            if (!steps_.meet_together(node, first, second, absorbed)) {
                first = second = node;
                keep_only(0, first.c);
                keep_only(1, second.c);
                return 2;
            }
        } else {
            const int m = node.c.power(0) > 0 ? 0 : 1;
            mode = static_cast<char>(node.modes[m].kind);
            steps_.meet_alone(node, m, first, second, absorbed);
        }
        if (band_.absorbs && node.inside) sink_.absorbed(absorbed);
        push(first.facet);
        return after_hit(first, second);
    }
    static void keep_only(int m, EyeCoherency& c) {
        for (Eigen::Matrix2cd* block : {&c.xx, &c.yy, &c.xy}) {
            block->row(1 - m).setZero();
            block->col(1 - m).setZero();
        }
    }

    // The tree below a node, depth first; overwrites `node`. Waiting nodes are on a list, not the
    // call stack, because trees may be very deep.
    void follow(CrystalNode& node) {
        const std::size_t others = waiting_.size();
        CrystalNode first, second;
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

    // Of two nodes, `second` waits, or one is chosen, or two estimates are made. Returns 1 if
    // `first` goes on, else 0.
    int branch(CrystalNode& first, CrystalNode& second) {
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
            CrystalNode chosen = first, other = second;
            choose(chosen, other);
            chosen.c.scale(0.5);
            follow(chosen);
        });
        return 0;
    }

    // Chooses one by power; `first` gets it, with the weight of both.
    void choose(CrystalNode& first, CrystalNode& second) {
        const double power_first = first.power(), power_second = second.power();
        const double whole = power_first + power_second;
        const bool stay = random_.uniform() * whole < power_first;
        if (!stay) first = second;
        first.c.scale(whole / (stay ? power_first : power_second));
    }

    // Makes two independent estimates of half weight, each to the end of its subtree. Below this,
    // branches are chosen, so nothing waits.
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

    // Applies the depth limit, the weight cut and Russian roulette.
    bool stops(CrystalNode& node) {
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
                CrystalNode half = node;
                follow(half);
            });
            return true;
        }
        // It survives with probability weight / cut_weight, and then has weight cut_weight.
        if (random_.uniform() * limits_.cut_weight >= weight) {
            sink_.roulette(weighted(node.power(), node.tau));
            return true;
        }
        const double gain = limits_.cut_weight / weight;
        sink_.roulette(weighted(node.power() * (1 - gain), node.tau));
        node.c.scale(gain);
        return false;
    }

    const StoneBody& body_;
    const Band& band_;
    PathLimits limits_;
    Sink& sink_;
    Random random_;
    CrystalSteps steps_;
    PathTrace trace_;
    struct Waiting {
        CrystalNode node;
        int length;  // of the trace at its start
    };
    std::vector<Waiting> waiting_;
    int splits_ = 0;
    long long events_ = 0;
    bool choosing_ = false;
};

}  // namespace culet
