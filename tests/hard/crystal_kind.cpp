// Cases of kind "crystal": one face of a crystal. Expectations: the oracle of tests/render, another
// derivation in 100 digits, for the same doubles as culet's.
//
// [crystal]: principal indices n + spread * pattern; `outside`, the surrounding index (1).
//   lies = random | axis_along_normal | axis_in_facet; `off`: then turned by so many radians. The
//   axis is the first principal axis.
//   wave = random | normal | optic_axis | outside | inside: how the light arrives. random: with any
//   K; normal: with none; optic_axis: `past` radians from an optic axis; outside: with |K| of the
//   index outside (critical from within, grazing from without) times 1 + past; inside: with |K| of
//   the smallest index inside times 1 - past.
//   draws, seed: the number of faces, and the seed of the draws.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "render/optics/complex_vector.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/textbook.h"
#include "tests/random_attitudes.h"
#include "tests/render/face_judge.h"

namespace culet::hard {

namespace {

// v turned by an angle towards the perpendicular direction `across`.
Vec3 leaning(const Vec3& v, const Vec3& across, double angle) {
    return std::cos(angle) * v + std::sin(angle) * across;
}

std::array<Vec3, 3> frame_about(const Vec3& axis, RandomAttitudes& random) {
    const Vec3 b = random.across(axis, 1);
    return {axis, b, glm::cross(axis, b)};
}

// The axis of a uniaxial crystal, a binormal of a biaxial one (Born & Wolf 15.3).
Vec3 optic_axis(const oracle::Face& face) {
    std::array<int, 3> rising{0, 1, 2};
    std::sort(rising.begin(), rising.end(), [&](int a, int b) { return face.n[a] < face.n[b]; });
    const double n1 = face.n[rising[0]], n2 = face.n[rising[1]], n3 = face.n[rising[2]];
    const double across = n3 * std::sqrt((n2 - n1) * (n2 + n1)),
                 along = n1 * std::sqrt((n3 - n2) * (n3 + n2));
    const Vec3 v = across * face.axes[rising[0]] + along * face.axes[rising[2]];
    return glm::length(v) > 0 ? glm::normalize(v) : face.axes[0];
}

std::vector<oracle::Face> make_faces(const TomlTable& t) {
    t.refuse_unknown(
        {"n", "spread", "pattern", "outside", "lies", "off", "wave", "past", "draws", "seed"});
    RandomAttitudes random(static_cast<unsigned>(t.integer("seed").value_or(1)));
    const double n = t.number("n").value_or(1.7), spread = t.number("spread").value_or(0);
    const Vec3 pattern = t.vector("pattern").value_or(Vec3{1, 0, 0});
    const double past = t.number("past").value_or(0), off = t.number("off").value_or(0);
    const std::string lies = t.text("lies").value_or("random"),
                      wave = t.text("wave").value_or("random");
    std::vector<oracle::Face> faces;
    for (int draw = 0; draw < t.integer("draws").value_or(6); ++draw) {
        oracle::Face face;
        for (int k = 0; k < 3; ++k) face.n[k] = n + spread * pattern[k];
        face.n_outside = t.number("outside").value_or(1);
        face.normal = random.direction();
        if (lies == "random") {
            face.axes = random.frame();
        } else if (lies == "axis_along_normal" || lies == "axis_in_facet") {
            const Vec3 across = random.across(face.normal, 1);
            face.axes = frame_about(lies == "axis_in_facet" ? leaning(across, face.normal, off)
                                                            : leaning(face.normal, across, off),
                                    random);
        } else {
            t.fail("lies", "is none of random, axis_along_normal, axis_in_facet");
        }
        const Vec3 along = random.across(face.normal, 1);
        const double smallest = std::min({face.n[0], face.n[1], face.n[2]});
        if (wave == "random") {
            face.K = random.between(0, 1) * face.n_outside * along;
        } else if (wave == "normal") {
            face.K = Vec3(0);
            face.s = along;
        } else if (wave == "outside") {
            face.K = face.n_outside * (1 + past) * along;
        } else if (wave == "inside") {
            face.K = smallest * (1 - past) * along;
        } else if (wave == "optic_axis") {
            Vec3 axis = optic_axis(face);
            // Keeps the face lit from outside too where possible: the normal leans from the axis by
            // up to half a radian.
            face.normal = leaning(axis, random.across(axis, 1), random.between(0.05, 0.5));
            axis = leaning(axis, random.across(axis, 1), past);
            std::array<double, 3> sorted = face.n;
            std::sort(sorted.begin(), sorted.end());
            const Vec3 N = sorted[1] * axis;
            face.K = N - glm::dot(N, face.normal) * face.normal;
        } else {
            t.fail("wave", "is none of random, normal, optic_axis, outside, inside");
        }
        faces.push_back(face);
    }
    return faces;
}

struct Case {
    std::vector<oracle::Face> faces;
    FaceJudge::Worst worst;
    double textbook_wave = 0, textbook_field = 0;
};

// Compares the oracle's two waves with the textbook's four roots, each with the nearest.
void judge_textbook(Case& c) {
    for (const oracle::Face& face : c.faces) {
        const oracle::Answer truth = oracle::solve(face);
        const auto waves = textbook_waves(face.axes, face.n, face.K, face.normal);
        for (const oracle::Wave& w : truth.towards) {
            if (!w.propagates) continue;
            double nearest = 1e300, field = 1;
            const ComplexVec3 unit =
                (1 / std::sqrt(std::norm(w.E.x) + std::norm(w.E.y) + std::norm(w.E.z))) * w.E;
            for (const TextbookWave& t : waves) {
                nearest = std::min(nearest, std::abs(t.q - w.q));
                const Complex along = t.E.x * std::conj(unit.x) + t.E.y * std::conj(unit.y) +
                                      t.E.z * std::conj(unit.z);
                field = std::min(field, std::sqrt(std::norm(t.E.x - along * unit.x) +
                                                  std::norm(t.E.y - along * unit.y) +
                                                  std::norm(t.E.z - along * unit.z)));
            }
            c.textbook_wave = std::max(c.textbook_wave, nearest);
            c.textbook_field = std::max(c.textbook_field, field);
        }
    }
}

}  // namespace

Subject crystal_subject(const HardCase&, const HardPoint&, const TomlTable& parameters) {
    const auto c = std::make_shared<Case>();
    c->faces = make_faces(parameters.table("crystal").value());
    FaceJudge judge(1e-14);
    for (const oracle::Face& face : c->faces) judge.compare(face);
    c->worst = judge.worst();
    judge_textbook(*c);
    Subject subject;
    auto& is = subject.invariants;
    const double condition = c->worst.sensitivity / 2.220446049250313e-16;
    const auto figure = [&](const char* name, double FaceJudge::Worst::*which) {
        is[name] = [c, which, condition] {
            return Measured{c->worst.*which, condition, described(c->faces.front())};
        };
    };
    figure("amplitudes", &FaceJudge::Worst::amplitude);
    figure("powers", &FaceJudge::Worst::power);
    figure("wave_normals", &FaceJudge::Worst::wave);
    figure("rays", &FaceJudge::Worst::ray);
    figure("energy", &FaceJudge::Worst::imbalance);
    // The same calls, with floating-point flags checked and without NaN results.
    is["finite"] = [c] {
        int bad = 0;
        for (const oracle::Face& face : c->faces) {
            const Crystal crystal(face.axes, face.n);
            if (glm::length(face.K) <= face.n_outside) {
                const CrystalEntry e = enter_crystal(crystal, face.n_outside, face.K, face.normal);
                for (int i = 0; i < 2; ++i) {
                    bad += !std::isfinite(e.power[i][0] + e.power[i][1] + e.reflected[i]);
                }
            }
            for (const CrystalMode& mode : modes_towards(crystal, face.K, face.normal)) {
                if (!mode.propagates) continue;
                const CrystalHit h = hit_face(crystal, face.n_outside, mode, face.K, face.normal);
                bad += !std::isfinite(h.power[0] + h.power[1] + h.transmitted + mode.ray.x);
                for (const double share : absorption_shares(crystal, mode)) {
                    bad += !std::isfinite(share);
                }
            }
        }
        return Measured{static_cast<double>(bad), std::nan(""), ""};
    };
    subject.contrasts.push_back({"wave_normals", "expanded quartic: wave normals", [c] {
                                     return Measured{c->textbook_wave, std::nan(""), ""};
                                 }});
    subject.contrasts.push_back({"amplitudes", "expanded quartic: vibrations", [c] {
                                     return Measured{c->textbook_field, std::nan(""), ""};
                                 }});
    return subject;
}

}  // namespace culet::hard
