// Light from two simulated photographs of a mirror ball: its error by the ball's size, and whether
// the stated uncertainty of the turn between the cameras is right.
//
//   build/bench_light --seeds 20 --radius 110
//   build/bench_light --seeds 1 --radius 400 --panorama studio.exr --width 256 -v

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <random>

#include "compare/light_probe/light_probe.h"
#include "stone/numbers/quantile.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "tests/compare/light_probe/light_agreement.h"

namespace {

using namespace culet;

double part(const std::vector<double>& values, double share) {
    return values.empty() ? NAN : quantile(values, share);
}

}  // namespace

int main(int argc, char** argv) {
    int seeds = 10, first = 1;
    double radius = 110, electrons = 20000, given_error = -1;
    std::string file;
    int width = 256;
    bool quick = false, know_turn = false, know_distance = false, all = false;
    CLI::App app("light from two photographs of a ball");
    app.add_option("--seeds", seeds);
    app.add_option("--first", first);
    app.add_option("--radius", radius, "of the ball, pixels");
    app.add_option("--electrons", electrons, "at the clipping level");
    app.add_option("--given", given_error,
                   "the ball is given, wrong by so many pixels (one sigma); else it is found");
    app.add_option("--panorama", file, "of a real place, instead of random rooms");
    app.add_option("--width", width, "of that panorama's and of the light's map");
    app.add_flag("--know-turn", know_turn,
                 "to some degrees: the search over all turns is left out");
    app.add_flag("--know-distance", know_distance);
    app.add_flag("--quick", quick, "a coarse map, not sharpened: for the turn alone");
    app.add_flag("-v", all);
    CLI11_PARSE(app, argc, argv);

    EnvironmentMap map;
    if (!file.empty()) map = simulated::coarse_panorama(file, width);
    std::vector<double> turn_off, pulls, mean_stops, worst_stops, energy, ball_off;
    int refused = 0, doubted = 0;
    for (int seed = first; seed < first + seeds; ++seed) {
        std::mt19937_64 random(static_cast<std::uint64_t>(seed) * 7919);
        const auto uniform = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        std::normal_distribution<double> normal;
        const auto panorama = file.empty() ? simulated::room(static_cast<unsigned>(seed))
                                           : simulated::panorama_of(map);
        std::vector<ProbeView> views;
        std::vector<simulated::Taken> taken;
        glm::dmat3 turned(1.0);
        double turn = 0;
        for (int v = 0; v < 2; ++v) {
            simulated::BallShot shot;
            shot.radius = radius * uniform(0.97, 1.03);
            shot.width = static_cast<int>(3 * radius);
            shot.height = static_cast<int>(2.4 * radius);
            shot.centre_x = radius * uniform(1.3, 1.7);
            shot.centre_y = radius * uniform(1.15, 1.25);
            shot.distance = 25;
            shot.samples = 4;
            turn = v == 0 ? 0 : uniform(1.2, 1.9);
            shot.world_from_camera = simulated::camera_at(turn, v == 0 ? 0 : uniform(-0.1, 0.1));
            if (v == 1) turned = shot.world_from_camera;
            taken.push_back(simulated::take(shot, panorama));
            // For a real place's lamps and shadows one exposure is not enough: merge several.
            if (file.empty())
                simulated::expose(taken.back().photo, 4, electrons,
                                  static_cast<unsigned>(2 * seed + v));
            ProbeView view;
            view.name = fmt::format("room {} view {}", seed, v);
            view.photo = taken.back().photo;
            if (given_error >= 0) {
                const double e = given_error;
                view.ball = BallCircle{taken.back().x + e * normal(random),
                                       taken.back().y + e * normal(random),
                                       taken.back().radius + e * normal(random)};
            }
            views.push_back(std::move(view));
        }
        ProbeOptions options;
        options.reflectance = {0.6, 0.6, 0.6};
        if (!file.empty()) options.width = width;
        if (know_turn) options.turned = turn + 0.02;
        if (know_distance) options.distance = 25;
        if (quick) {
            options.passes = 0;
            options.width = 128;
        }
        try {
            const LightProbe probe = light_probe(views, options);
            if (!probe.usable()) ++doubted;
            const double off = simulated::angle_apart(probe.views[1].world_from_camera, turned);
            const double sigma = probe.alignments.front().sigma;
            const simulated::Agreement agreement =
                simulated::agreement_of(probe.light.map, panorama);
            double ball = 0;
            for (std::size_t v = 0; v < 2; ++v) {
                const BallCircle& c = probe.views[v].circle;
                ball = std::max({ball, std::hypot(c.x - taken[v].x, c.y - taken[v].y),
                                 std::abs(c.radius - taken[v].radius)});
            }
            if (probe.usable()) {
                turn_off.push_back(degrees(off));
                pulls.push_back(off / (std::sqrt(3.0) * sigma));
                mean_stops.push_back(agreement.mean_stops);
                worst_stops.push_back(agreement.worst_percent_stops);
                energy.push_back(std::abs(agreement.energy_ratio - 1));
                ball_off.push_back(ball);
            }
            if (all) {
                fmt::print(
                    "{:3d}: turn off {:.3f} deg, sigma {:.3f}; ball off {:.2f} px; light off "
                    "{:.3f} stops, worst 1 % {:.2f}, energy {:.4f} {}\n",
                    seed, degrees(off), degrees(sigma), ball, agreement.mean_stops,
                    agreement.worst_percent_stops, agreement.energy_ratio, probe.doubt);
            }
        } catch (const InputError& error) {
            ++refused;
            if (all) fmt::print("{:3d}: refused: {}\n", seed, error.what());
        }
    }
    double squares = 0;
    for (const double pull : pulls) squares += pull * pull;
    const auto share = [&](double within) {
        return static_cast<double>(std::count_if(pulls.begin(), pulls.end(),
                                                 [&](double p) { return p < within; })) /
               std::max<double>(1, static_cast<double>(pulls.size()));
    };
    fmt::print("radius {:g} px: {} rooms, {} refused, {} doubted\n", radius, seeds, refused,
               doubted);
    fmt::print("  ball off {:.2f} px (median), {:.2f} (worst)\n", part(ball_off, 0.5),
               part(ball_off, 1));
    fmt::print("  turn off {:.3f} degrees (median), {:.3f} (worst); over its sigma {:.2f} (rms)\n",
               part(turn_off, 0.5), part(turn_off, 1),
               std::sqrt(squares / std::max<double>(1, static_cast<double>(pulls.size()))));
    // Three normal errors of one sigma each: half are within 1.54, 95 % within 2.80.
    fmt::print("  within the half's bound {:.2f}, within that of 95 %: {:.2f}\n",
               share(1.538 / std::sqrt(3.0)), share(2.795 / std::sqrt(3.0)));
    fmt::print("  light off {:.3f} stops (median of means), {:.2f} (worst 1 %), energy {:.4f}\n",
               part(mean_stops, 0.5), part(worst_stops, 0.5), part(energy, 0.5));
    return 0;
}
