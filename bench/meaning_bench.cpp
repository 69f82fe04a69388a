// How well the calibrated comparison tells right stones from wrong ones, and how accurate the
// equivalent facet error is. It uses simulated photographs of stones with known facet error.
//
// The model is a fit: an irregular stone (a standard cut with 0.6 degrees of facet error). The
// photographs show that stone with further errors, the same stone under another light or in another
// pose, the standard cut that it comes from, and another stone of the same class.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "compare/calibration/calibrate.h"
#include "compare/calibration/calibrated_verdict.h"
#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/facet_error.h"
#include "compare/calibration/hypotheses.h"
#include "compare/calibration/photo_blur.h"
#include "compare/calibration/photo_noise.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/chance.h"
#include "compare/scores/score_list.h"
#include "render/scene/turned_lights.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"

namespace {

using namespace culet;

struct Case {
    std::string name, cut, material;
    std::map<std::string, double> own, other;  // proportions: the model's class, the other stone
    bool windows = true;
};

Scene scene_of(const Case& one, int pixels) {
    Scene scene;
    scene.stone.solid = make_cut(one.cut, one.own);
    scene.stone.material = catalogue_material(one.material);
    scene.camera.position = {0, 0, 200};
    scene.camera.up = {0, 1, 0};
    scene.camera.orthographic_width = 10;
    scene.camera.width = scene.camera.height = 400;
    const Vec3 tilt = {0.05, -0.03, 0};
    scene.camera.position += 200.0 * tilt;
    scene.lights.constant = 0.05;
    scene.lights.sources.push_back(DiscLight{Vec3{0, 0, 1}, radians(12), radians(40), {0.7}});
    scene.lights.sources.push_back(
        DiscLight{glm::normalize(Vec3{1, 0.3, 0.6}), 0, radians(18), {3.0}});
    scene.lights.sources.push_back(
        DiscLight{glm::normalize(Vec3{-0.6, 1, 0.9}), 0, radians(10), {2.0}});
    scene.lights.sources.push_back(HemisphereLight{Vec3{0, 0, 1}, {0.12}});
    if (!one.windows) {
        // Smooth: a bright ceiling and coloured walls.
        std::erase_if(scene.lights.sources,
                      [](const Light& light) { return std::holds_alternative<DiscLight>(light); });
        scene.lights.sources.push_back(
            CosinePowerLight{Vec3{0.2, 0.1, 1}, 6, {Rgb{1.5, 1.4, 1.2}}});
        scene.lights.sources.push_back(
            CosinePowerLight{Vec3{1, 0.2, 0.4}, 20, {Rgb{2.5, 2.4, 2.6}}});
        scene.lights.sources.push_back(
            CosinePowerLight{Vec3{-0.5, 0.9, 0.3}, 12, {Rgb{0.9, 0.8, 0.5}}});
    }
    scene.camera = cropped_to_stone(scene.camera, scene.stone.solid, pixels, 0.18);
    return scene;
}

struct Trial {
    std::string kind;
    double sigma = 0;  // of the distribution of its facets' tilts, degrees
    double own = 0;    // their rms
    bool right = false;
    Photo photo;
    CameraModel seen, camera;  // as estimated from the photograph; as it was
    CalibratedVerdict verdict;
    std::map<std::string, double> scores;

    void judge(const Calibration& calibration, const std::vector<std::optional<double>>& values) {
        std::vector<Score> of_photo;
        for (std::size_t k = 0; k < values.size(); ++k) {
            Score score;
            score.key = calibration.keys[k];
            score.value = values[k];
            const ScoreKind& row = score_kinds()[k];
            score.higher_is_better = row.higher_is_better();
            score.is_correlation = row.scale == ScoreScale::correlation;
            if (score.value) scores[score.key] = *score.value * (score.higher_is_better ? 1 : -1);
            of_photo.push_back(std::move(score));
        }
        verdict = calibrated_verdict(of_photo, calibration);
    }
};

auto alike_to(const CameraModel& camera) {
    return [camera](const CameraModel& other) {
        return camera.psf_px == other.psf_px && camera.electrons == other.electrons;
    };
}

void print_cameras(const std::vector<Trial>& trials) {
    double blur = 0, blur_squares = 0, noise = 0, noise_squares = 0, n = 0;
    for (const Trial& t : trials) {
        if (!t.right) continue;
        const double off = t.seen.psf_px - t.camera.psf_px,
                     ratio = std::log(t.seen.electrons / t.camera.electrons) / -2;
        blur += off;
        blur_squares += off * off;
        noise += ratio;
        noise_squares += ratio * ratio;
        ++n;
    }
    fmt::print(
        "  right stones' blur seen {:+.2f} pixels off, rms {:.2f}; logarithm of the noise {:+.2f}, "
        "rms {:.2f}\n",
        blur / n, std::sqrt(blur_squares / n), noise / n, std::sqrt(noise_squares / n));
}

double area_under(const std::vector<double>& right, const std::vector<double>& wrong) {
    double wins = 0;
    for (const double r : right) {
        for (const double w : wrong) wins += r > w ? 1 : r == w ? 0.5 : 0;
    }
    return wins / (static_cast<double>(right.size()) * static_cast<double>(wrong.size()));
}

// For `count` normal random angles of standard deviation 1.
double root_mean_square(std::size_t count, std::uint64_t seed) {
    Chance chance(seed);
    double squares = 0;
    for (std::size_t k = 0; k < count; ++k) squares += std::pow(chance.normal(), 2);
    return std::sqrt(squares / static_cast<double>(count));
}

double since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The equivalent error of right stones, relative to a true one.
void print_ratios(const std::vector<Trial>& trials, const char* over, double Trial::*truth) {
    std::map<double, std::vector<double>> ratios;
    for (const Trial& t : trials) {
        if (!t.right || t.sigma < 0.05 || !t.verdict.equivalent.deg) continue;
        ratios[t.sigma].push_back(*t.verdict.equivalent.deg / (t.*truth));
    }
    int within = 0, of = 0;
    double squares = 0;
    fmt::print("  over {}:\n", over);
    for (auto& [sigma, r] : ratios) {
        std::sort(r.begin(), r.end());
        for (const double x : r) {
            within += x >= 1 / 1.5 && x <= 1.5;
            squares += std::log(x) * std::log(x);
            ++of;
        }
        fmt::print("    {:5.2f} deg: ratio {:.2f} {:.2f} {:.2f}\n", sigma, r.front(),
                   r[r.size() / 2], r.back());
    }
    fmt::print("    within 1.5: {} of {}; rms of the ratio's logarithm {:.3f}\n", within, of,
               std::sqrt(squares / std::max(1, of)));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("meaning bench");
    int pixels = 256, each = 6, draws = 8, exact = 0, threads = 0;
    std::uint64_t seed = 1;
    std::string only;
    bool list = false, right_only = false;
    std::array<double, 2> blur_px{0.5, 1.0};
    app.add_option("--pixels", pixels);
    app.add_option("--each", each);
    app.add_option("--draws", draws);
    app.add_option("--exact", exact, "rays a pixel of photographs by the reference; 0: drafts");
    app.add_option("--threads", threads);
    app.add_option("--seed", seed);
    app.add_option("--only", only);
    app.add_option("--blur", blur_px, "of the photographs, in pixels: from, to");
    app.add_flag("--list", list);
    app.add_flag("--right", right_only, "right stones only, and no nulls");
    CLI11_PARSE(app, argc, argv);

    const std::vector<Case> cases{{"brilliant",
                                   "round-brilliant",
                                   "cubic_zirconia",
                                   {},
                                   {{"pavilion-angle", 41.6}, {"crown-angle", 33.0}},
                                   true},
                                  {"step", "step", "tourmaline_dravite", {}, {}, true},
                                  {"smooth", "oval", "corundum", {}, {}, false}};
    std::vector<Trial> all;
    for (const Case& one : cases) {
        if (!only.empty() && one.name != only) continue;
        Scene model = scene_of(one, pixels);
        const Solid ideal = model.stone.solid;
        model.stone.solid = with_facet_error(ideal, radians(0.6), seed_of(seed, 99, 0)).value();
        auto start = std::chrono::steady_clock::now();
        const DraftRenderer renderer(model, 0.03);
        model.settings = renderer.settings();
        const Photo picture = renderer.picture();
        fmt::print("{}: {} x {}, engine {}, {} wavelengths, plan and picture {:.2f} s\n", one.name,
                   picture.width, picture.height, renderer.settings().engine,
                   renderer.settings().wavelengths_nm.size(), since(start));
        CalibrateOptions options;
        options.draws = draws;
        options.null_draws = right_only ? 0 : 3 * draws;
        options.seed = seed;
        options.threads = threads;
        options.largest = pixels;
        // Choose the exposure so that about two per cent are clipped.
        double level = 0;
        {
            std::vector<float> greens;
            for (std::size_t i = 0; i < picture.coverage.size(); ++i) {
                if (picture.coverage[i] > 0.5f) greens.push_back(picture.rgb[3 * i + 1]);
            }
            std::sort(greens.begin(), greens.end());
            level = static_cast<double>(greens[greens.size() * 98 / 100]);
        }
        options.camera.gain.fill(1 / level);
        options.camera.ground = {0.01f, 0.01f, 0.012f};
        start = std::chrono::steady_clock::now();
        const FacetTilts tilts(model, renderer, options.camera, threads);
        options.tilts = &tilts;
        fmt::print("  facets' tilts: {:.1f} s\n", since(start));
        std::vector<Trial> trials;
        const auto photograph = [&](const std::string& kind, double sigma, double own,
                                    const Scene& scene, std::uint64_t draw) {
            Chance chance(seed_of(seed, 555, draw));
            CameraModel camera = options.camera;
            // Lenses from sharp to slightly out of focus, and two and a half stops of light.
            camera.psf_px = chance.uniform(blur_px[0], blur_px[1]);
            camera.electrons *= std::exp(chance.uniform(-1, 1) * std::log(2.5));
            for (double& g : camera.gain) g *= chance.uniform(0.97, 1.03);
            const Photo stone =
                exact > 0 ? renderer.draw_exactly(scene, exact) : renderer.draw(scene);
            if (kind != "right") {
                const double factor = exposure_like(stone, picture);
                for (double& g : camera.gain) g *= factor;
            }
            const Photo photo = photographed(stone, camera, seed_of(seed, 556, draw));
            CameraModel seen = options.camera;
            const AlignedPair pair = aligned(photo, picture, options.largest);
            if (pair.enough()) set_blur_and_noise(seen, pair.pictures);
            trials.push_back({kind, sigma, own, kind == "right", photo, seen, camera, {}, {}});
        };
        std::uint64_t draw = 1;
        for (const double sigma : {0.0, 0.05, 0.07, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0}) {
            for (int k = 0; k < each; ++k, ++draw) {
                Scene scene = model;
                const double own = sigma * root_mean_square(model.stone.solid.facets.size(),
                                                            seed_of(seed, 322, draw));
                if (sigma > 0) {
                    scene.stone.solid =
                        with_facet_error(model.stone.solid, radians(own), seed_of(seed, 321, draw))
                            .value();
                }
                photograph("right", sigma, own, scene, draw);
            }
        }
        const Vec3 middle = centroid(model.stone.solid);
        for (int k = 0; k < (right_only ? 0 : 2 * each); ++k) {
            Chance chance(seed_of(seed, 777, draw));
            Scene light = model;
            light.lights = turned_lights(
                model.lights, rotation_about(chance.direction(), radians(chance.uniform(15, 180))),
                middle);
            photograph("light", 0, 0, light, draw++);
            Scene pose = model;
            const double period = 2 * M_PI / turns_alike(model.stone.solid, model.stone.up);
            const double towards = chance.uniform(0, 2 * M_PI);
            pose.stone =
                turned_stone(model.stone,
                             rotation_about({std::cos(towards), std::sin(towards), 0},
                                            radians(chance.uniform(3, 20))) *
                                 rotation_about(model.stone.up, period * chance.uniform(0.1, 0.9)),
                             middle);
            photograph("pose", 0, 0, pose, draw++);
            Scene catalogue = model;
            catalogue.stone.solid = ideal;
            photograph("catalogue", 0, 0, catalogue, draw++);
            Scene other = model;
            std::map<std::string, double> proportions = one.other;
            other.stone.solid = with_facet_error(make_cut(one.cut, proportions), radians(0.6),
                                                 seed_of(seed, 888, draw))
                                    .value();
            photograph("other", 0, 0, other, draw++);
        }
        std::vector<double> off;
        // As in the program: calibrated for each photograph's own blur and noise.
        std::vector<CameraModel> cameras;
        for (const Trial& t : trials) {
            if (std::none_of(cameras.begin(), cameras.end(), alike_to(t.seen)))
                cameras.push_back(t.seen);
        }
        print_cameras(trials);
        start = std::chrono::steady_clock::now();
        const auto calibrations = calibrate(model, picture, renderer, options, cameras);
        fmt::print("  calibrations for {} cameras: {} draws in {:.1f} s\n", cameras.size(),
                   calibrations.front().draws.size(), since(start));
        for (const std::string& note : calibrations.front().notes) fmt::print("  {}\n", note);
        for (Trial& t : trials) {
            const auto own = std::find_if(cameras.begin(), cameras.end(), alike_to(t.seen));
            t.judge(calibrations[static_cast<std::size_t>(own - cameras.begin())],
                    calibration_scores(t.photo, softened(picture, t.seen.psf_px), options));
        }
        print_ratios(trials, "their stone's own facet error", &Trial::own);
        print_ratios(trials, "what its tilts were drawn with", &Trial::sigma);
        if (right_only) {
            all.insert(all.end(), trials.begin(), trials.end());
            continue;
        }
        std::map<std::string, std::map<std::string, int>> verdicts;
        for (const Trial& t : trials) {
            ++verdicts[t.right ? fmt::format("right {:.2f}", t.sigma) : t.kind]
                      [name_of(t.verdict.verdict)];
            if (list) {
                fmt::print(
                    "    {:10} {:.2f}: evidence {:.2f} equivalent {:.3f} zncc {:.3f} z {:.1f} {}\n",
                    t.kind, t.sigma, t.verdict.evidence, t.verdict.equivalent.deg.value_or(-1),
                    t.scores.at("zncc"), t.verdict.nulls.empty() ? 0 : t.verdict.nulls.front().z,
                    name_of(t.verdict.verdict));
            }
        }
        for (const auto& [kind, counts] : verdicts) {
            fmt::print("  {:12}", kind);
            for (const auto& [verdict, count] : counts) fmt::print(" {} {}", count, verdict);
            fmt::print("\n");
        }
        const auto roc = [&](const char* name, auto value) {
            for (const double limit : {0.5, 1.0}) {
                std::vector<double> right;
                std::map<std::string, std::vector<double>> wrong;
                for (const Trial& t : trials) {
                    if (t.right && t.sigma <= limit) right.push_back(value(t));
                    if (!t.right) {
                        wrong[t.kind].push_back(value(t));
                        wrong["all"].push_back(value(t));
                    }
                }
                fmt::print("  ROC {:14} up to {:.1f}:", name, limit);
                for (const auto& [kind, values] : wrong) {
                    fmt::print(" {} {:.4f}", kind, area_under(right, values));
                }
                fmt::print("\n");
            }
        };
        roc("evidence", [](const Trial& t) { return t.verdict.evidence; });
        roc("equivalent", [](const Trial& t) { return -t.verdict.equivalent.deg.value_or(10); });
        for (const char* key : {"zncc", "zncc_1pct", "reflex_area_f1", "cw_ssim", "psnr",
                                "flip_mean", "nmi", "ssim", "deltaE00_mean"}) {
            roc(key, [&](const Trial& t) {
                const auto at = t.scores.find(key);
                return at == t.scores.end() ? -1e9 : at->second;
            });
        }
        all.insert(all.end(), trials.begin(), trials.end());
    }
    fmt::print("{} trials\n", all.size());
    return 0;
}
