#include "compare/calibration/calibrate.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/calibration/chance.h"
#include "compare/calibration/facet_error.h"
#include "compare/calibration/hypotheses.h"
#include "compare/calibration/photo_blur.h"
#include "compare/registration/frame.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/score_list.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr double k_least_turn_deg = 15, k_most_turn_deg = 180;  // of the wrong light
constexpr double k_least_tilt_deg = 3, k_most_tilt_deg = 20;    // of the wrong pose
constexpr int k_neighbours = 2;

struct Job {
    World world = World::facet_error;
    std::string name;
    double facet_error_deg = 0;
    std::uint64_t seed = 0;
    int which = 0;  // of the world's kinds
};

enum Wrong {
    higher_index,
    lower_index,
    flat_index,
    more_absorption,
    turned_light,
    tilted,
    k_wrongs
};

const char* name_of(Wrong wrong) {
    switch (wrong) {
        case higher_index:
            return "index 0.02 higher";
        case lower_index:
            return "index 0.02 lower";
        case flat_index:
            return "no dispersion";
        case more_absorption:
            return "absorption 1.3 times";
        case turned_light:
            return "light turned by 5 degrees";
        case tilted:
            return "stone tilted by 0.5 degrees";
        case k_wrongs:
            break;
    }
    return "";
}

bool absorbs(const Material& material) {
    return std::any_of(material.absorption_per_mm.begin(), material.absorption_per_mm.end(),
                       [](const Spectrum& s) { return s.max() > 0; });
}

class Draws {
public:
    Draws(const Scene& model, const Photo& model_picture, const DraftRenderer& renderer,
          const CalibrateOptions& options, const std::vector<CameraModel>& cameras)
        : model_(model),
          model_picture_(model_picture),
          renderer_(renderer),
          options_(options),
          cameras_(cameras),
          middle_(centroid(model.stone.solid)) {
        for (const CameraModel& camera : cameras)
            soft_pictures_.push_back(softened(model_picture, camera.psf_px));
    }

    /// Of every world some early on, so that a budget that ends leaves a whole.
    std::vector<Job> jobs(std::vector<std::string>& notes);
    /// One for each camera.
    std::vector<CalibrationDraw> draw(const Job& job) const;

private:
    CalibrationDraw photograph(const Job& job, const Photo& stone, std::size_t camera) const;
    Scene world_of(const Job& job) const;
    glm::dmat3 wrong_light(Chance& chance) const;
    glm::dmat3 wrong_pose(Chance& chance) const;

    const Scene& model_;
    const Photo& model_picture_;
    std::vector<Photo> soft_pictures_;  // as each camera's lens shows it
    const DraftRenderer& renderer_;
    const CalibrateOptions& options_;
    const std::vector<CameraModel>& cameras_;
    Vec3 middle_;
    int turns_alike_ = 1;
    std::optional<Solid> catalogue_;
    std::vector<Material> neighbours_;
};

std::vector<Job> Draws::jobs(std::vector<std::string>& notes) {
    const Stone& stone = model_.stone;
    std::vector<Job> jobs;
    const auto add = [&](World world, std::string name, double deg, int which, int draw) {
        const auto seed = seed_of(options_.seed, static_cast<std::uint64_t>(world),
                                  static_cast<std::uint64_t>(1000 * which + draw));
        jobs.push_back({world, std::move(name), deg, seed, which});
    };
    const bool tiltable = with_facet_error(stone.solid, 1e-4, 1).has_value();
    if (!tiltable) {
        notes.push_back(
            "the stone is not convex: its facets cannot be tilted one by one, and there is no "
            "sensitivity curve");
    }
    turns_alike_ = turns_alike(stone.solid, stone.up);
    const bool one_light = same_light_from_everywhere(model_.lights);
    if (one_light) {
        notes.push_back(
            "the light is the same from everywhere: there is no wrong light to compare with");
    }
    catalogue_ = options_.start ? options_.start : symmetrised(stone.solid, stone.up);
    neighbours_ = neighbouring_materials(stone.material, k_neighbours);
    const std::vector<double> levels = facet_errors_deg();
    const int rounds = std::max(1, options_.draws);
    for (int round = 0; round < rounds; ++round) {
        if (tiltable) {
            if (round < (rounds + 1) / 2) add(World::facet_error, "0 degrees", 0, 0, round);
            for (std::size_t l = 0; l < levels.size(); ++l) {
                add(World::facet_error, fmt::format("{:g} degrees", levels[l]), levels[l],
                    static_cast<int>(l), round);
            }
        }
        const int from = options_.null_draws * round / rounds;
        const int to = options_.null_draws * (round + 1) / rounds;
        for (int k = from; k < to; ++k) {
            if (!one_light) add(World::light, "", 0, 0, k);
            add(World::pose, "", 0, 0, k);
            if (!one_light) add(World::both, "", 0, 0, k);
        }
        // After the second round: a budget that ends early ends these first.
        if (round != std::min(1, rounds - 1)) continue;
        if (catalogue_) {
            add(World::catalogue, options_.start ? "the starting mesh" : "the symmetrical stone", 0,
                0, 0);
        }
        for (std::size_t m = 0; m < neighbours_.size(); ++m) {
            add(World::material, neighbours_[m].id, 0, static_cast<int>(m), 0);
        }
        for (int w = 0; w < k_wrongs; ++w) {
            if (w == turned_light && one_light) continue;
            if (w == more_absorption && !absorbs(stone.material)) continue;
            add(World::wrong, name_of(static_cast<Wrong>(w)), 0, w, 0);
        }
    }
    return jobs;
}

glm::dmat3 Draws::wrong_light(Chance& chance) const {
    const Vec3 axis = chance.direction();
    return rotation_about(axis, radians(chance.uniform(k_least_turn_deg, k_most_turn_deg)));
}

glm::dmat3 Draws::wrong_pose(Chance& chance) const {
    // A stone of n-fold symmetry is the same stone again after 1/n of a turn: stay between.
    const double period = 2 * std::numbers::pi / turns_alike_;
    const Vec3& up = model_.stone.up;
    const double azimuth = period * chance.uniform(0.12, 0.88);
    const Vec3 away = std::abs(up.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(up, away)), v = glm::cross(up, u);
    const double towards = 2 * std::numbers::pi * chance.uniform();
    const double tilt = radians(chance.uniform(k_least_tilt_deg, k_most_tilt_deg));
    return rotation_about(std::cos(towards) * u + std::sin(towards) * v, tilt) *
           rotation_about(up, azimuth);
}

Scene Draws::world_of(const Job& job) const {
    Scene scene = model_;
    Chance chance(seed_of(job.seed, 7, 0));
    Stone& stone = scene.stone;
    switch (job.world) {
        case World::facet_error:
            if (job.facet_error_deg > 0) {
                if (auto solid = with_facet_error(model_.stone.solid, radians(job.facet_error_deg),
                                                  job.seed)) {
                    stone.solid = std::move(*solid);
                }
            }
            break;
        case World::light:
            scene.lights = turned_lights(model_.lights, wrong_light(chance), middle_);
            break;
        case World::pose:
            stone = turned_stone(model_.stone, wrong_pose(chance), middle_);
            break;
        case World::both:
            scene.lights = turned_lights(model_.lights, wrong_light(chance), middle_);
            stone = turned_stone(model_.stone, wrong_pose(chance), middle_);
            break;
        case World::catalogue:
            stone.solid = *catalogue_;
            break;
        case World::material:
            stone.material = neighbours_[static_cast<std::size_t>(job.which)];
            break;
        case World::wrong: {
            const Material& material = model_.stone.material;
            const Vec3 across = chance.direction();
            const Vec3 axis = glm::normalize(
                glm::cross(model_.stone.up, across - 0.1 * model_.stone.up) + Vec3(1e-9, 0, 0));
            switch (static_cast<Wrong>(job.which)) {
                case higher_index:
                    stone.material = with_index_changed(material, 0.02);
                    break;
                case lower_index:
                    stone.material = with_index_changed(material, -0.02);
                    break;
                case flat_index:
                    stone.material = without_dispersion(material);
                    break;
                case more_absorption:
                    stone.material = with_absorption_times(material, 1.3);
                    break;
                case turned_light:
                    scene.lights =
                        turned_lights(model_.lights, rotation_about(axis, radians(5.0)), middle_);
                    break;
                case tilted:
                    stone = turned_stone(model_.stone, rotation_about(axis, radians(0.5)), middle_);
                    break;
                case k_wrongs:
                    break;
            }
            break;
        }
    }
    return scene;
}

CalibrationDraw Draws::photograph(const Job& job, const Photo& stone, std::size_t which) const {
    CalibrationDraw result{job.world, job.name, job.facet_error_deg, {}};
    CameraModel camera = cameras_[which];
    if (job.world == World::light || job.world == World::both || job.world == World::pose) {
        // Under another light a photographer would meter again.
        const double exposure = exposure_like(stone, model_picture_);
        for (double& gain : camera.gain) gain *= exposure;
    }
    const Photo& soft_picture = soft_pictures_[which];
    const auto seed = seed_of(job.seed, 11, static_cast<std::uint64_t>(1e4 * job.facet_error_deg));
    const Photo photo = photographed(stone, camera, seed);
    result.scores = calibration_scores(photo, soft_picture, options_);
    const bool none = std::none_of(result.scores.begin(), result.scores.end(),
                                   [](const auto& s) { return s.has_value(); });
    if (none && camera.outline_from_background) {
        // Too dark at its border to be found there: told by the coverage instead.
        camera.outline_from_background = false;
        result.scores =
            calibration_scores(photographed(stone, camera, seed), soft_picture, options_);
    }
    return result;
}

std::vector<CalibrationDraw> Draws::draw(const Job& job) const {
    const Photo stone = renderer_.draw(world_of(job));
    std::vector<CalibrationDraw> result;
    for (std::size_t k = 0; k < cameras_.size(); ++k) result.push_back(photograph(job, stone, k));
    return result;
}

}  // namespace

const char* name_of(World world) {
    switch (world) {
        case World::facet_error:
            return "facet_error";
        case World::light:
            return "light";
        case World::pose:
            return "pose";
        case World::both:
            return "both";
        case World::catalogue:
            return "catalogue";
        case World::material:
            return "material";
        case World::wrong:
            return "wrong";
    }
    return "wrong";
}

std::vector<Score> scores_against(const Photo& photo, const std::vector<float>& mask,
                                  const Photo& soft_picture, const Alignment& how,
                                  const FacetTilts* tilts) {
    const Frame frame = align(photo, mask, soft_picture, how);
    if (frame.render.empty()) return {};
    const LaidPictures laid = lay_pictures(frame, photo.saturation, soft_picture.saturation);
    if (!laid.enough()) return {};
    const MatchedPictures part = part_of(laid.pictures, part_to_score(laid.pictures));
    std::vector<Score> scores = measure(part, wavelet_bank(part.mask.size(), part.diameter)).scores;
    Score of_tilts;
    of_tilts.key = k_facet_tilts;
    of_tilts.higher_is_better = false;
    if (tilts) of_tilts.value = tilts->facet_error_deg(frame, laid);
    scores.push_back(std::move(of_tilts));
    return scores;
}

std::vector<std::optional<double>> calibration_scores(const Photo& photo, const Photo& soft_picture,
                                                      const CalibrateOptions& options) {
    std::vector<std::optional<double>> values;
    for (const Score& score :
         scores_against(photo, {}, soft_picture,
                        {.largest = options.largest, .ignored = options.ignored}, options.tilts)) {
        values.push_back(score.value);
    }
    if (values.empty()) values.resize(score_kinds().size() + 1);
    return values;
}

std::vector<Calibration> calibrate(const Scene& model, const Photo& model_picture,
                                   const DraftRenderer& renderer, const CalibrateOptions& options,
                                   const std::vector<CameraModel>& cameras,
                                   const Progress& progress) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    Calibration common;
    common.seed = options.seed;
    for (const ScoreKind& kind : score_kinds()) {
        common.keys.push_back(kind.key);
        common.higher_is_better.push_back(kind.higher_is_better);
    }
    common.keys.push_back(k_facet_tilts);
    common.higher_is_better.push_back(false);
    Draws draws(model, model_picture, renderer, options, cameras);
    const std::vector<Job> jobs = draws.jobs(common.notes);
    common.planned = static_cast<int>(jobs.size());
    std::vector<std::vector<CalibrationDraw>> made(jobs.size());

    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    const auto batch = static_cast<std::size_t>(std::max(2, 2 * arena.max_concurrency()));
    std::size_t done = 0;
    Clock::duration longest{};  // of a batch
    while (done < jobs.size()) {
        const auto begun = Clock::now();
        if (begun > options.deadline - longest) break;
        const std::size_t end = std::min(jobs.size(), done + batch);
        arena.execute([&] {
            tbb::parallel_for(done, end, [&](std::size_t i) { made[i] = draws.draw(jobs[i]); });
        });
        done = end;
        longest = std::max(longest, Clock::now() - begun);
        if (progress && !progress(static_cast<double>(done) / static_cast<double>(jobs.size()))) {
            throw Interrupted();
        }
    }
    common.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (done < jobs.size()) {
        common.notes.push_back(fmt::format(
            "the budget of time ended the calibration after {} of {} draws", done, jobs.size()));
    }
    std::vector<Calibration> result(cameras.size(), common);
    for (std::size_t k = 0; k < cameras.size(); ++k) {
        CalibrateOptions own = options;
        own.camera = cameras[k];
        result[k].hash = calibration_hash(model, own);
        for (std::size_t i = 0; i < done; ++i) result[k].draws.push_back(std::move(made[i][k]));
    }
    return result;
}

Calibration calibrate(const Scene& model, const Photo& model_picture, const DraftRenderer& renderer,
                      const CalibrateOptions& options, const Progress& progress) {
    return std::move(
        calibrate(model, model_picture, renderer, options, {options.camera}, progress).front());
}

}  // namespace culet
