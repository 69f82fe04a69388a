#include "fit/solve/caliper_turn.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "fit/model/orbits.h"
#include "fit/solve/constants.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// One side of a caliper, and the corners that it may touch.
struct Jaw {
    Vec3 out;
    std::vector<Vec3> corners;

    // `back`: the rotation from the jaws' frame to the stone's.
    double farthest(const glm::dmat3& back) const {
        const Vec3 along = back * out;
        double most = -std::numeric_limits<double>::infinity();
        for (const Vec3& p : corners) most = std::max(most, glm::dot(along, p));
        return most;
    }
    // Appends the turns within the range at which two outermost corners are level.
    void add_changes(double range, std::vector<double>& to) const {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                const Vec3 between = corners[i] - corners[k];
                const double turn =
                    std::remainder(std::atan2(out.y, out.x) - std::atan2(between.y, between.x) +
                                       std::numbers::pi / 2,
                                   std::numbers::pi);
                if (!(std::abs(turn) < range)) continue;
                const glm::dmat3 back = turn_about_z(-turn);
                if (glm::dot(back * out, corners[i]) > farthest(back) - k_jaws.level)
                    to.push_back(turn);
            }
        }
    }
};

Jaw jaw_at(const Vec3& out, const std::vector<int>& corners, const Shape& shape) {
    Jaw jaw{out, {}};
    for (const int p : corners) jaw.corners.push_back(shape.points[std::size_t(p)]);
    const double least = jaw.farthest(glm::dmat3(1.0)) - k_jaws.out_of_reach;
    std::erase_if(jaw.corners, [&](const Vec3& p) { return glm::dot(out, p) < least; });
    return jaw;
}

}  // namespace

Shape turned_to_calipers(const Relaxation& relaxation, const Shape& shape) {
    const std::vector<Relaxation::Caliper> calipers = relaxation.calipers_that_tell_the_turn();
    if (calipers.size() < 2) return shape;
    std::vector<std::array<Jaw, 2>> jaws;
    for (const Relaxation::Caliper& c : calipers) {
        jaws.push_back(
            {jaw_at(c.direction, *c.corners, shape), jaw_at(-c.direction, *c.corners, shape)});
    }
    const auto misfit = [&](double turn) {
        const glm::dmat3 back = turn_about_z(-turn);
        double sum = 0;
        for (std::size_t i = 0; i < calipers.size(); ++i) {
            const double width = jaws[i][0].farthest(back) + jaws[i][1].farthest(back);
            sum += std::pow((width - calipers[i].value) / calipers[i].sigma, 2);
        }
        return sum;
    };
    // The misfit is smooth between turns at which a jaw changes corners, and its minimum is often
    // at one.
    const double range = radians(k_jaws.turn_range_deg);
    std::vector<double> turns{-range, 0, range};
    for (const std::array<Jaw, 2>& both : jaws) {
        for (const Jaw& jaw : both) jaw.add_changes(range, turns);
    }
    std::sort(turns.begin(), turns.end());
    std::pair<double, double> best{0, misfit(0)};
    const auto try_turn = [&](const std::pair<double, double>& there) {
        if (there.second < best.second) best = there;
    };
    for (std::size_t i = 0; i < turns.size(); ++i) {
        try_turn({turns[i], misfit(turns[i])});
        if (i == 0) continue;
        try_turn(boost::math::tools::brent_find_minima(misfit, turns[i - 1], turns[i],
                                                       std::numeric_limits<double>::digits / 2));
    }
    return turned_about_z(shape, best.first);
}

}  // namespace culet
