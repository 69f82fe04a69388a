#include "compare/calibration/alternatives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/calibration/facet_error.h"
#include "compare/calibration/hypotheses.h"
#include "compare/calibration/sensitivity.h"
#include "compare/pose/stone_view.h"
#include "render/scene/turned_lights.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_least_turn_deg = 15, k_most_turn_deg = 180;  // of the wrong light
constexpr double k_least_tilt_deg = 3, k_most_tilt_deg = 20;    // of the wrong pose
constexpr int k_neighbours = 2;

enum Wrong {
    higher_index,
    lower_index,
    flat_index,
    more_absorption,
    turned_light,
    tilted_stone,
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
        case tilted_stone:
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

glm::dmat3 wrong_light(Chance& chance) {
    const Vec3 axis = chance.direction();
    return rotation_about(axis, radians(chance.uniform(k_least_turn_deg, k_most_turn_deg)));
}

}  // namespace

Alternatives::Alternatives(const Scene& model, const AlternativeOptions& asked,
                           std::vector<std::string>& notes)
    : model_(model),
      middle_(centroid(model.stone.solid)),
      view_sigma_(asked.view_sigma),
      turns_alike_(turns_alike(model.stone.solid, model.stone.up)),
      catalogue_(asked.start ? asked.start : symmetrised(model.stone.solid, model.stone.up)),
      neighbours_(neighbouring_materials(model.stone.material, k_neighbours)) {
    const Stone& stone = model_.stone;
    const auto add = [&](Alternative alternative, std::string name, double deg, int which,
                         int draw) {
        const auto seed = seed_of(asked.seed, static_cast<std::uint64_t>(alternative),
                                  static_cast<std::uint64_t>(1000 * which + draw));
        draws_.push_back({alternative, std::move(name), deg, seed, which});
    };
    const bool tiltable = with_facet_error(stone.solid, 1e-4, 1).has_value();
    if (!tiltable) {
        notes.push_back(
            "the stone is not convex: its facets cannot be tilted one by one, and there is no "
            "sensitivity curve");
    }
    const bool one_light = same_light_from_everywhere(model_.lights);
    if (one_light) {
        notes.push_back(
            "the light is the same from everywhere: there is no wrong light to compare with");
    }
    const std::vector<double> levels = facet_errors_deg();
    const int rounds = std::max(1, asked.draws);
    for (int round = 0; round < rounds; ++round) {
        if (tiltable) {
            if (round < (rounds + 1) / 2) add(Alternative::facet_error, "0 degrees", 0, 0, round);
            for (std::size_t l = 0; l < levels.size(); ++l) {
                add(Alternative::facet_error, fmt::format("{:g} degrees", levels[l]), levels[l],
                    static_cast<int>(l), round);
            }
        }
        const int from = asked.null_draws * round / rounds;
        const int to = asked.null_draws * (round + 1) / rounds;
        for (int k = from; k < to; ++k) {
            if (!one_light) add(Alternative::light, "", 0, 0, k);
            add(Alternative::pose, "", 0, 0, k);
            if (!one_light) add(Alternative::both, "", 0, 0, k);
        }
        // After the second round, because a budget that runs out drops the last draws first.
        if (round != std::min(1, rounds - 1)) continue;
        if (catalogue_) {
            add(Alternative::catalogue, asked.start ? "the starting mesh" : "the symmetrical stone",
                0, 0, 0);
        }
        for (std::size_t m = 0; m < neighbours_.size(); ++m) {
            add(Alternative::material, neighbours_[m].id, 0, static_cast<int>(m), 0);
        }
        for (int w = 0; w < k_wrongs; ++w) {
            if (w == turned_light && one_light) continue;
            if (w == more_absorption && !absorbs(stone.material)) continue;
            add(Alternative::wrong, name_of(static_cast<Wrong>(w)), 0, w, 0);
        }
    }
}

glm::dmat3 Alternatives::wrong_pose(Chance& chance) const {
    // A stone of n-fold symmetry looks the same after 1/n of a turn: stay in between.
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

glm::dmat3 Alternatives::unsure_view(Chance& chance) const {
    const EyePlace eye = eye_of(stone_view(model_.camera, middle_));
    const Vec3 sight = glm::normalize(eye.parallel ? eye.place : eye.place - middle_);
    const Vec3 away = std::abs(sight.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(sight, away)), v = glm::cross(sight, u);
    const double a = view_sigma_ * chance.normal(), b = view_sigma_ * chance.normal();
    return rotation_by(a * u + b * v);
}

void Alternatives::make_wrong(Scene& scene, int which, Chance& chance) const {
    Stone& stone = scene.stone;

    const Material& material = model_.stone.material;
    const Vec3 across = chance.direction();
    const Vec3 axis = glm::normalize(glm::cross(model_.stone.up, across - 0.1 * model_.stone.up) +
                                     Vec3(1e-9, 0, 0));
    switch (static_cast<Wrong>(which)) {
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
        case tilted_stone:
            stone = turned_stone(model_.stone, rotation_about(axis, radians(0.5)), middle_);
            break;
        case k_wrongs:
            break;
    }
}

Scene Alternatives::scene_of(const AlternativeDraw& job) const {
    Scene scene = model_;
    Chance chance(seed_of(job.seed, 7, 0));
    Stone& stone = scene.stone;
    switch (job.alternative) {
        case Alternative::facet_error:
            if (job.facet_error_deg > 0) {
                if (auto solid = with_facet_error(model_.stone.solid, radians(job.facet_error_deg),
                                                  job.seed)) {
                    stone.solid = std::move(*solid);
                }
            }
            break;
        case Alternative::light:
            scene.lights = turned_lights(model_.lights, wrong_light(chance), middle_);
            break;
        case Alternative::pose:
            stone = turned_stone(model_.stone, wrong_pose(chance), middle_);
            break;
        case Alternative::both:
            scene.lights = turned_lights(model_.lights, wrong_light(chance), middle_);
            stone = turned_stone(model_.stone, wrong_pose(chance), middle_);
            break;
        case Alternative::catalogue:
            stone.solid = *catalogue_;
            break;
        case Alternative::material:
            stone.material = neighbours_[static_cast<std::size_t>(job.which)];
            break;
        case Alternative::wrong:
            make_wrong(scene, job.which, chance);
            break;
    }
    if (view_sigma_ > 0 && job.alternative != Alternative::pose &&
        job.alternative != Alternative::both) {
        Chance view(seed_of(job.seed, 8, static_cast<std::uint64_t>(1e4 * job.facet_error_deg)));
        stone = turned_stone(stone, unsure_view(view), middle_);
    }
    return scene;
}

}  // namespace culet
