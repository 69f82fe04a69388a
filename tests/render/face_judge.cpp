#include "tests/render/face_judge.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "render/optics/complex_vector.h"

namespace culet {

using oracle::Answer;
using oracle::Face;
using oracle::Matrix2;
using oracle::Wave;

namespace {

// Two N that differ by less are equal in doubles.
constexpr double k_one_wave = 4 * 2.220446049250313e-16;

bool together(const std::array<Wave, 2>& pair, double gap) {
    return pair[0].propagates && pair[1].propagates &&
           gap < k_one_wave * std::sqrt(squared_length(pair[0].N));
}

// Coefficient [k][j]: the oracle's wave k in culet's mode j, both of unit normal flux.
Matrix2 turn_of_pair(const std::array<CrystalMode, 2>& modes, const std::array<Wave, 2>& waves,
                     double gap, const Vec3& n) {
    Matrix2 turn{{{1, 0}, {0, 1}}};
    if (together(waves, gap) && modes[0].propagates && modes[1].propagates) {
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) {
                const Wave& w = waves[k];
                const ComplexVec3 E{std::conj(w.E.x), std::conj(w.E.y), std::conj(w.E.z)};
                const ComplexVec3 H{std::conj(w.H.x), std::conj(w.H.y), std::conj(w.H.z)};
                const Complex flow = 0.5 * dot(n, cross(modes[j].E, H) + cross(E, modes[j].H));
                const double flux = modes[j].flux * std::abs(glm::dot(modes[j].ray, n));
                turn[k][j] = (w.flux_along_normal < 0 ? -1.0 : 1.0) * flow / std::sqrt(flux);
            }
        return turn;
    }
    for (int j = 0; j < 2; ++j) {
        const ComplexVec3 &c = modes[j].E, &o = waves[j].E;
        const Complex overlap = c.x * std::conj(o.x) + c.y * std::conj(o.y) + c.z * std::conj(o.z);
        if (std::abs(overlap) > 0) turn[j][j] = overlap / std::abs(overlap);
    }
    return turn;
}

std::array<Complex, 2> operator*(const Matrix2& m, const std::array<Complex, 2>& v) {
    return {m[0][0] * v[0] + m[0][1] * v[1], m[1][0] * v[0] + m[1][1] * v[1]};
}

Matrix2 adjoint(const Matrix2& m) {
    return {{{std::conj(m[0][0]), std::conj(m[1][0])}, {std::conj(m[0][1]), std::conj(m[1][1])}}};
}

// Numbers of culet beside those of the oracle.
struct Figures {
    std::vector<Complex> amplitudes;
    std::vector<double> powers, waves, rays;
};

struct Deviation {
    double amplitude = 0, power = 0, wave = 0, ray = 0;
    double largest() const { return std::max({amplitude, power, wave, ray}); }
};

template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = std::abs(a[i] - b[i]);
        worst = std::isnan(d) ? 1e300 : std::max(worst, d);
    }
    return worst;
}

Deviation between(const Figures& a, const Figures& b) {
    return {distance(a.amplitudes, b.amplitudes), distance(a.powers, b.powers),
            distance(a.waves, b.waves), distance(a.rays, b.rays)};
}

}  // namespace

// One incident wave, or the waves themselves: culet's figures, and an answer of the oracle in
// culet's pairs of waves.
struct FaceJudge::Column {
    std::string name;
    Answer answer;
    Figures culets;
    std::function<Figures(const Answer&)> oracles;
    double imbalance = 0, imbalance_allowed = 0;
};

namespace {

// The problem as given decides which answers are comparable number by number.
struct Resolved {
    bool towards, away;
};

Figures figures(const std::array<Complex, 2>& inside, const std::array<Complex, 2>& outside,
                bool resolved) {
    Figures f;
    f.amplitudes = {inside[0], inside[1], outside[0], outside[1]};
    const double a = std::norm(inside[0]), b = std::norm(inside[1]);
    if (resolved) f.powers = {a, b};
    f.powers.push_back(a + b);
    f.powers.push_back(std::norm(outside[0]) + std::norm(outside[1]));
    return f;
}

void add(Figures& f, const Vec3& N, const Vec3& ray, bool with_ray) {
    for (int i = 0; i < 3; ++i) f.waves.push_back(N[i]);
    for (int i = 0; i < 3 && with_ray; ++i) f.rays.push_back(ray[i]);
}

}  // namespace

void FaceJudge::compare(const Face& given) {
    Face face = given;
    ++faces_;
    const Vec3 n = face.normal;
    const Crystal crystal(face.axes, face.n);
    const std::array<CrystalMode, 2> towards = modes_towards(crystal, face.K, n),
                                     away = modes_towards(crystal, face.K, -n);
    const bool lit = glm::length(face.K) <= face.n_outside;
    CrystalEntry entry;
    if (lit) {
        entry = enter_crystal(crystal, face.n_outside, face.K, n);
        face.s = entry.s;
    }
    const Answer answer = oracle::solve(face);
    EXPECT_LT(answer.imbalance, 1e-20) << "the oracle itself\n" << described(face);
    const Resolved resolved{!together(answer.towards, answer.gap_towards),
                            !together(answer.away, answer.gap_away)};

    Column waves{"waves", answer, {}, {}};
    const auto both = [&](int m, bool forward) {
        return forward ? towards[m].propagates && answer.towards[m].propagates
                       : away[m].propagates && answer.away[m].propagates;
    };
    for (int m = 0; m < 2; ++m) {
        if (both(m, true)) add(waves.culets, towards[m].wave, towards[m].ray, resolved.towards);
        if (both(m, false)) add(waves.culets, away[m].wave, away[m].ray, resolved.away);
    }
    waves.oracles = [&](const Answer& a) {
        Figures f;
        for (int m = 0; m < 2; ++m) {
            if (both(m, true)) {
                add(f, real_part(a.towards[m].N), a.towards[m].ray, resolved.towards);
            }
            if (both(m, false)) add(f, real_part(a.away[m].N), a.away[m].ray, resolved.away);
        }
        return f;
    };
    nudged_.clear();
    judge(face, waves);

    // For a wave at c from grazing (c = ray.n) the root q has a relative rounding error of 2^-52/c,
    // and its normal flux and the powers normalised by it one of 2^-52/c^2.
    double most_grazing = 1;
    for (const auto& pair : {towards, away})
        for (const CrystalMode& mode : pair)
            if (mode.propagates) {
                most_grazing = std::min(most_grazing, std::abs(glm::dot(mode.ray, n)));
            }
    const double imbalance_allowed =
        std::max(tolerance_, 64 * 2.220446049250313e-16 / (most_grazing * most_grazing));

    for (int i = 0; lit && i < 2; ++i) {
        Column column{
            i == 0 ? "s enters" : "p enters", answer, {}, {}, entry.imbalance, imbalance_allowed};
        column.culets = figures(entry.into[i], entry.back[i], resolved.towards);
        column.culets.powers.back() = entry.reflected[i];
        if (resolved.towards) {
            column.culets.powers[0] = entry.power[i][0];
            column.culets.powers[1] = entry.power[i][1];
        }
        column.oracles = [&, i](const Answer& a) {
            if (!a.enters) {  // |K| = n_outside: a mirror
                std::array<Complex, 2> back{};
                back[i] = -1;
                return figures({}, back, resolved.towards);
            }
            const Matrix2 turn = turn_of_pair(entry.modes, a.towards, a.gap_towards, n);
            return figures(adjoint(turn) * a.into[i], a.back[i], resolved.towards);
        };
        judge(face, column);
    }

    for (int m = 0; m < 2; ++m) {
        if (!towards[m].propagates || !answer.towards[m].propagates) {
            // Where only one of the two says that it propagates, it nearly grazes.
            if (towards[m].propagates) {
                EXPECT_LT(glm::dot(towards[m].ray, n), 1e-7) << described(face);
            }
            if (answer.towards[m].propagates) {
                EXPECT_LT(answer.towards[m].flux_along_normal, 1e-7) << described(face);
            }
            continue;
        }
        const CrystalHit hit = hit_face(crystal, face.n_outside, towards[m], face.K, n);
        Column column{m == 0 ? "wave 0 hits" : "wave 1 hits",
                      answer,
                      {},
                      {},
                      hit.imbalance,
                      imbalance_allowed};
        column.culets = figures(hit.amplitude, hit.out, resolved.away);
        column.culets.powers.back() = hit.transmitted;
        if (resolved.away) {
            column.culets.powers[0] = hit.power[0];
            column.culets.powers[1] = hit.power[1];
        }
        column.oracles = [&, m](const Answer& a) {
            const Matrix2 turn = turn_of_pair(towards, a.towards, a.gap_towards, n);
            std::array<Complex, 2> inside{}, outside{};
            for (int k = 0; k < 2; ++k)
                for (int j = 0; j < 2; ++j) {
                    inside[j] += turn[k][m] * a.reflected[k][j];
                    outside[j] += turn[k][m] * a.out[k][j];
                }
            const Matrix2 reflected = turn_of_pair(hit.modes, a.away, a.gap_away, n);
            return figures(adjoint(reflected) * inside, outside, resolved.away);
        };
        judge(face, column);
    }
}

void FaceJudge::judge(const Face& face, const Column& column) {
    ++columns_;
    const Figures truth = column.oracles(column.answer);
    const Deviation found = between(column.culets, truth);
    amplitude_ = std::max(amplitude_, found.amplitude);
    power_ = std::max(power_, found.power);
    wave_ = std::max(wave_, found.wave);
    ray_ = std::max(ray_, found.ray);
    imbalance_ = std::max(imbalance_, column.imbalance);
    EXPECT_LE(column.imbalance, column.imbalance_allowed + tolerance_) << column.name << '\n'
                                                                       << described(face);
    const double worst = found.largest();
    if (worst <= tolerance_) return;
    ++excused_;
    if (nudged_.empty()) {
        const double h = 2.220446049250313e-16;
        const int signs[6][5] = {{1, 1, 1, 1, 1},   {-1, 1, -1, 1, -1}, {1, -1, -1, -1, 1},
                                 {-1, -1, 1, 1, 1}, {1, 1, -1, -1, -1}, {-1, 1, 1, -1, 1}};
        for (const auto& sign : signs) {
            nudged_.push_back(oracle::solve(
                face, {sign[0] * h, sign[1] * h, {sign[2] * h, sign[3] * h, sign[4] * h}}));
        }
    }
    double sensitivity = 0;
    for (const Answer& nudged : nudged_)
        sensitivity = std::max(sensitivity, between(column.oracles(nudged), truth).largest());
    sensitivity_ = std::max(sensitivity_, sensitivity);
    const double allowance = std::max(tolerance_, 8 * sensitivity);
    of_tolerance_ = std::max(of_tolerance_, worst / allowance);
    EXPECT_LE(worst, allowance) << fmt::format(
        "{}: amplitude {:.2g}, power {:.2g}, wave normal {:.2g}, ray {:.2g}, imbalance {:.2g}; "
        "sensitivity {:.2g}; gaps {:.2g} {:.2g}\n{}",
        column.name, found.amplitude, found.power, found.wave, found.ray, column.imbalance,
        sensitivity, column.answer.gap_towards, column.answer.gap_away, described(face));
}

FaceJudge::~FaceJudge() {
    const auto record = [](const char* name, double value) {
        testing::Test::RecordProperty(name, fmt::format("{:.1e}", value));
    };
    testing::Test::RecordProperty("faces", faces_);
    testing::Test::RecordProperty("columns", columns_);
    testing::Test::RecordProperty("excused", excused_);
    record("amplitude", amplitude_);
    record("power", power_);
    record("wave", wave_);
    record("ray", ray_);
    record("imbalance", imbalance_);
    record("of_allowance", of_tolerance_);
}

std::string described(const Face& face) {
    const auto triple = [](const Vec3& v) {
        return fmt::format("{{{:.17g}, {:.17g}, {:.17g}}}", v.x, v.y, v.z);
    };
    return fmt::format(
        "Crystal({{{{{}, {}, {}}}}}, {{{:.17g}, {:.17g}, {:.17g}}}), n_outside {:.17g}, K {}, n {}",
        triple(face.axes[0]), triple(face.axes[1]), triple(face.axes[2]), face.n[0], face.n[1],
        face.n[2], face.n_outside, triple(face.K), triple(face.normal));
}

}  // namespace culet
