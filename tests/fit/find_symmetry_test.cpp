// Symmetry that is found in readings: which group, how sure, and how far the stone is from it.
#include "fit/find_symmetry.h"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "fit/variance_component.h"
#include "stone/cuts/cuts.h"
#include "stone/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

std::vector<Reading> readings_of(const Solid& truth, double sigma_deg, double sigma) {
    std::vector<Reading> readings = all_angles(truth, radians(sigma_deg), "T");
    for (const Reading& r : all_edges(truth, sigma)) readings.push_back(r);
    readings.push_back(depth(truth, sigma));
    return readings;
}

const GroupTest& group(const SymmetryReport& report, const std::string& name) {
    for (const GroupTest& g : report.groups) {
        if (g.group == name) return g;
    }
    throw std::runtime_error("no group " + name);
}

void show(const SymmetryReport& r) {
    fmt::print("{} -> {}: {}\n", r.form, r.proposed, r.message);
    for (const auto& g : r.groups) {
        fmt::print("  {} {:.1f} cond {} tested {} chi2 {:.1f} p {:.3g}\n", g.group,
                   degrees(g.mirror_azimuth), g.conditions, g.tested, g.chi2, g.p);
    }
    for (const auto& t : r.tiers) {
        fmt::print("  {} dev {:.4f} sigma {:.4f} +- {:.4f} < {:.4f} p {:.2g} {} {:.3f}\n", t.tier,
                   degrees(t.deviation), degrees(t.sigma), degrees(t.sigma_sigma),
                   degrees(t.at_most), t.p, t.worst, degrees(t.worst_off));
    }
}

TEST(FindSymmetry, OfRoundBrilliantsIsThatOfTheirMains) {
    for (const int mains : {3, 5, 6, 8}) {
        const Solid truth = make_cut("round-brilliant", {{"mains", double(mains)}});
        const SymmetryReport report =
            find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.01), 5));
        show(report);
        EXPECT_EQ(report.form, fmt::format("C{}v", mains));
        EXPECT_EQ(report.proposed, report.form) << report.message;
    }
}

TEST(FindSymmetry, OfAStepCut) {
    const Solid truth = make_cut("step");
    const SymmetryReport report =
        find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.01), 5));
    show(report);
    EXPECT_EQ(report.proposed, "C2v") << report.message;
}

TEST(FindSymmetry, PValuesAreUniform) {
    const Solid truth = brilliant();
    std::vector<double> p;
    for (unsigned seed = 1; seed <= 16; ++seed) {
        const SymmetryReport report =
            find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.01), seed));
        p.push_back(group(report, "C8v").p);
    }
    fmt::print("{}\n", p);
}

}  // namespace
}  // namespace culet
