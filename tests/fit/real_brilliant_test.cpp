// The main proof: a real polished diamond. Its readings (to 0.1 degree and 0.01 mm) are fitted from
// the catalogue's round brilliant, and the result is held against the planes of the scan that the
// readings were taken from: polyhedron.dat of stone "1_GIA" in
// ilya-palachev/polyhedra-correction-library. Areas never enter the fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fit/fit.h"
#include "stone/checks.h"
#include "stone/stone_io.h"

namespace culet {
namespace {

const std::filesystem::path k_sample = CULET_SOURCE_DIR "/samples/real-brilliant/stone.toml";
const std::filesystem::path k_data = CULET_SHARED_DATA;

// The scan, table up and level, as `stones/real_round_brilliant_readings.json` describes it.
struct Scan {
    std::vector<Vec3> vertices;
    std::vector<Facet> facets;
};

Scan read_scan() {
    std::ifstream file(k_data / "scans/1_GIA/polyhedron.dat");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first != std::string::npos && line[first] != '#') lines.push_back(line);
    }
    Scan scan;
    std::size_t vertex_count = 0, facet_count = 0, at = 0;
    std::istringstream(lines.at(at++)) >> vertex_count >> facet_count;
    // The scanner holds the stone table down: half a turn about x puts it up.
    for (std::size_t i = 0; i < vertex_count; ++i) {
        int index = 0;
        Vec3 v(0);
        std::istringstream(lines.at(at++)) >> index >> v.x >> v.y >> v.z;
        scan.vertices.push_back({v.x, -v.y, -v.z});
    }
    for (std::size_t i = 0; i < facet_count; ++i) {
        int index = 0, sides = 0;
        double a = 0, b = 0, c = 0, d = 0;
        std::istringstream(lines.at(at++)) >> index >> sides >> a >> b >> c >> d;
        Facet facet;
        facet.plane = {{a, -b, -c}, -d};
        std::istringstream corners(lines.at(at++));
        for (int k = 0; k < sides; ++k) {
            int corner = 0;
            corners >> corner;
            facet.corners.push_back(corner);
        }
        scan.facets.push_back(std::move(facet));
    }
    const Vec3 up = scan.facets.at(56).plane.normal;
    // The shortest turn that levels the table (Rodrigues).
    const Vec3 axis = glm::cross(up, Vec3{0, 0, 1});
    const auto level = [&](const Vec3& v) {
        return v * up.z + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + up.z));
    };
    for (Vec3& v : scan.vertices) v = level(v);
    for (Facet& f : scan.facets) f.plane.normal = level(f.plane.normal);
    return scan;
}

double area_of(const Scan& scan, const Facet& facet) {
    return area(Solid{scan.vertices, {}}, facet);
}

double degrees_apart(double a, double b) {
    return std::abs(degrees(std::remainder(a - b, 2 * std::numbers::pi)));
}

class RealBrilliant : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        if (!std::filesystem::exists(k_data / "scans/1_GIA/polyhedron.dat")) return;
        stone_ = new StoneFile(read_stone(k_sample));
        readings_ = new std::vector<Reading>(bind_readings(read_readings(k_sample), stone_->stone));
        result_ = new FitResult(fit_stone(stone_->stone, *readings_, read_fit_options(k_sample)));
        scan_ = new Scan(read_scan());
    }
    static void TearDownTestSuite() {
        delete stone_;
        delete readings_;
        delete result_;
        delete scan_;
        stone_ = nullptr;
        readings_ = nullptr;
        result_ = nullptr;
        scan_ = nullptr;
    }
    void SetUp() override {
        if (result_ == nullptr)
            GTEST_SKIP() << "no scan in " << k_data << "; nothing to hold it to";
    }

    // The scan's plane nearest in direction among its first 57, which are the polished facets.
    const Facet& scanned(const FittedFacet& facet) const {
        const double a = facet.azimuth - result_->azimuth_zero;
        const double z = facet.plane.normal.z;
        const Vec3 n{std::sin(facet.inclination) * std::cos(a),
                     std::sin(facet.inclination) * std::sin(a), z};
        std::size_t best = 0;
        for (std::size_t i = 1; i < 57; ++i) {
            if (glm::dot(n, scan_->facets[i].plane.normal) >
                glm::dot(n, scan_->facets[best].plane.normal)) {
                best = i;
            }
        }
        return scan_->facets[best];
    }
    std::vector<FittedFacet> polished() const {
        std::vector<FittedFacet> facets;
        for (const FittedFacet& f : result_->facets) {
            if (f.name[0] != 'G') facets.push_back(f);
        }
        return facets;
    }

    void expect_is_a_stone_that_could_be_cut() const;
    void expect_angles_are_the_scans() const;
    void expect_lengths_are_the_scans() const;
    void expect_areas_are_as_good_as_the_report_says() const;
    void expect_estimates_how_meets_miss() const;

    static StoneFile* stone_;
    static std::vector<Reading>* readings_;
    static FitResult* result_;
    static Scan* scan_;
};
StoneFile* RealBrilliant::stone_ = nullptr;
std::vector<Reading>* RealBrilliant::readings_ = nullptr;
FitResult* RealBrilliant::result_ = nullptr;
Scan* RealBrilliant::scan_ = nullptr;

void RealBrilliant::expect_is_a_stone_that_could_be_cut() const {
    EXPECT_EQ(result_->status, FitStatus::converged) << result_->message;
    EXPECT_TRUE(result_->checks.closed);
    EXPECT_TRUE(result_->checks.convex);
    EXPECT_LT(result_->checks.planarity_max, 1e-9 * diameter(result_->solid));
    EXPECT_EQ(result_->solid.facets.size(), stone_->stone.solid.facets.size());
    EXPECT_THAT(result_->checks.missing_facets, ::testing::IsEmpty());
    EXPECT_THAT(find_faults(result_->solid), ::testing::IsEmpty());
    EXPECT_EQ(polished().size(), 57u);
}

void RealBrilliant::expect_angles_are_the_scans() const {
    for (const FittedFacet& f : polished()) {
        const Vec3 n = scanned(f).plane.normal;
        EXPECT_LT(degrees_apart(f.inclination, inclination(n, {0, 0, 1})), 0.15) << f.name;
        if (f.name == "T") continue;
        EXPECT_LT(degrees_apart(f.azimuth - result_->azimuth_zero, azimuth(n)), 0.15) << f.name;
    }
}

// Of the solid that is written, not of the fit's own account of it.
void RealBrilliant::expect_lengths_are_the_scans() const {
    const Solid scanned_solid{scan_->vertices, {}};
    EXPECT_NEAR(width_along(result_->solid, {0, 0, 1}), width_along(scanned_solid, {0, 0, 1}),
                0.02);
    for (int k = 0; k < 12; ++k) {
        const double a = radians(15.0 * k), b = a + result_->azimuth_zero;
        EXPECT_NEAR(width_along(result_->solid, {std::cos(b), std::sin(b), 0}),
                    width_along(scanned_solid, {std::cos(a), std::sin(a), 0}), 0.02)
            << 15 * k;
    }
}

// What the readings can say of areas is limited by how facets miss their meets, not by the
// instrument: with the scan's unrounded angles the same errors remain. Each facet is allowed three
// of the standard uncertainties that the report gives it, and together they must be as large as
// reported and no larger. Measured: 49 of 57 within 10 %, the worst (a pavilion main of 0.52 mm2,
// whose area is reported with 22 %) off by 25 %.
void RealBrilliant::expect_areas_are_as_good_as_the_report_says() const {
    double squares = 0;
    int within = 0, count = 0;
    for (const FittedFacet& f : polished()) {
        const double truth = area_of(*scan_, scanned(f));
        const double z = (f.area - truth) / f.sigma_area;
        EXPECT_LT(std::abs(z), 3.5) << f.name;
        squares += z * z;
        ++count;
        const double off = std::abs(f.area / truth - 1);
        if (off < 0.10) ++within;
        EXPECT_LT(off, 0.30) << f.name;
        RecordProperty("area_error_percent_" + f.name, std::to_string(100 * (f.area / truth - 1)));
    }
    EXPECT_GE(within, 48) << "of " << count;
    EXPECT_LT(std::sqrt(squares / count), 1.3);
    EXPECT_GT(std::sqrt(squares / count), 0.5);
}

// The scan's own planes miss the common points of table corners by 4.0 um, of star tips by 2.3, of
// the culet by 1.2 and of the lower halves' tips by 1.3 (root of squares over redundancy).
void RealBrilliant::expect_estimates_how_meets_miss() const {
    EXPECT_TRUE(result_->statistics.meets.estimated);
    EXPECT_GT(result_->statistics.meets.sigma, 0.0012);
    EXPECT_LT(result_->statistics.meets.sigma, 0.0045);
}

TEST_F(RealBrilliant, ContradictsExactMeets) {
    FitOptions exact = read_fit_options(k_sample);
    exact.meets = MeetTreatment::exact;
    const FitResult result = fit_stone(stone_->stone, *readings_, exact);
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_GT(result.statistics.chi2, 5 * result.statistics.chi2_limit);
    EXPECT_FALSE(result.findings.suspects.empty());
    EXPECT_LT(result.checks.planarity_max, 1e-12 * diameter(result.solid));
}

// One test, because the fit behind it takes seconds.
TEST_F(RealBrilliant, IsTheScannedStone) {
    expect_is_a_stone_that_could_be_cut();
    expect_angles_are_the_scans();
    expect_lengths_are_the_scans();
    expect_areas_are_as_good_as_the_report_says();
    expect_estimates_how_meets_miss();
}

}  // namespace
}  // namespace culet
