// culet refine on a stone with wrong readings, with a photograph drawn by culet, against the true
// planes.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "compare/calibration/facet_error.h"
#include "stone/numbers/units.h"
#include "stone/stone_io.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;

Solid step_cut() {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.9}}};
    for (int k = 0; k < 4; ++k) {
        const double a = radians(90 * k + 7.0 * (k % 2));
        const Vec3 side{std::cos(a), std::sin(a), 0}, up{0, 0, 1};
        const auto put = [&](const char* tier, double deg, double offset) {
            planes.push_back(
                {fmt::format("{}{}", tier, k + 1),
                 {std::sin(radians(deg)) * side + std::cos(radians(deg)) * up, offset}});
        };
        put("C", 38 + k, 2);
        put("G", 90, 2.4);
        put("P", 137 - k, 1.9);
    }
    return intersect_half_spaces(planes).solid;
}

std::string scene_of(const std::string& stone) {
    return "stone = \"" + stone +
           "\"\n[camera]\nposition = [3, -2, 60]\nup = [0, 1, 0]\northographic_width = 7.5\n"
           "size = [300, 300]\n[light]\nconstant = 0.1\n"
           "[[light.lobe]]\ndirection = [0.3, 0.1, 1]\nexponent = 8\nradiance = 0.5\n"
           "[[light.lobe]]\ndirection = [1, 0.3, 0.5]\nexponent = 30\nradiance = 0.9\n"
           "[[light.lobe]]\ndirection = [-0.5, 0.9, 0.4]\nexponent = 20\nradiance = 0.6\n"
           "[render]\ntolerance = 0.02\n";
}

// Root mean square angle in degrees between facets of the same name, after the best common turn:
// photographs do not determine the stone's orientation.
double rms_deg(const Solid& solid, const Solid& truth) {
    glm::dmat3 sum(0.0);
    Vec3 turned(0);
    const auto normal_in = [](const Solid& stone, const std::string& name) {
        return stone.facets[std::size_t(find_facet(stone, name))].plane.normal;
    };
    for (const Facet& facet : truth.facets) {
        const Vec3& n = facet.plane.normal;
        sum += glm::dmat3(1.0) - glm::outerProduct(n, n);
        turned += glm::cross(n, normal_in(solid, facet.name));
    }
    const Vec3 turn = glm::inverse(sum) * turned;
    double squares = 0;
    for (const Facet& facet : truth.facets) {
        const Vec3& n = facet.plane.normal;
        const Vec3 off = normal_in(solid, facet.name) - n - glm::cross(turn, n);
        squares += std::pow(degrees(glm::length(off)), 2);
    }
    return std::sqrt(squares / double(truth.facets.size()));
}

class RefineCommand : public test::ProgramTest {
protected:
    void SetUp() override {
        truth_ = *with_facet_error(step_cut(), radians(0.3), 5);
        read_ = *with_facet_error(truth_, radians(0.3), 2);
        write_stone();
        write_solid(truth_, folder_ / "true.obj");
        write("true.toml",
              "[stone]\nmesh = \"true.obj\"\nunit = \"mm\"\nup = [0, 0, 1]\n"
              "material = \"glass_bk7\"\n");
        write("true-scene.toml", scene_of("true.toml"));
        write("scene.toml", scene_of("stone.toml"));
    }
    // Inclinations and azimuths with errors of 0.3 degrees.
    void write_stone() const {
        write_solid(read_, folder_ / "read.obj");
        std::string csv = "kind,of,value,sigma\n";
        for (const Facet& facet : read_.facets) {
            const Vec3& n = facet.plane.normal;
            const double across = std::hypot(n.x, n.y);
            csv += fmt::format("inclination,{},{:.3f},0.21\n", facet.name,
                               degrees(std::atan2(across, std::abs(n.z))));
            if (across > 0.1) {
                csv += fmt::format("azimuth,{},{:.3f},{:.3f}\n", facet.name,
                                   degrees(std::atan2(n.y, n.x)), 0.21 / across);
            }
        }
        csv += fmt::format("depth,,{:.4f},0.005\n", width_along(read_, {0, 0, 1}));
        write("readings.csv", csv);
        write("stone.toml",
              "[stone]\nname = \"step cut\"\nmesh = \"read.obj\"\nunit = \"mm\"\nup = [0, 0, 1]\n"
              "readings = \"readings.csv\"\nmaterial = \"glass_bk7\"\n"
              "[fit]\nmeets = \"released\"\n");
    }

    Solid truth_, read_;
};

// Off by 0.3 degrees before; the command's aim is 0.1.
TEST_F(RefineCommand, FindsFacetsThatReadingsHaveWrong) {
    const ProgramRun drawn =
        run_culet({"render", file("true-scene.toml"), "-o", file("photo.exr")});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const ProgramRun run =
        run_culet({"refine", file("stone.toml"), file("photo.exr"), file("scene.toml"), "-o",
                   file("refined.obj"), "--report", file("fit.json"), "--keep-pose"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr("photo.exr"));
    EXPECT_GT(rms_deg(read_, truth_), 0.2);
    EXPECT_LT(rms_deg(read_solid(folder_ / "refined.obj").solid, truth_), 0.1);

    const auto report = json("fit.json");
    const auto& reading = report["readings"].back();
    EXPECT_EQ(reading["id"], "photo.exr");
    EXPECT_EQ(reading["kind"], "photograph");
    EXPECT_LT(reading["rms"].get<double>(), 0.3 * reading["rms_before"].get<double>());
}

TEST_F(RefineCommand, SaysWhatIsMissing) {
    const auto refused = [&](const char* stone, const char* photo, const char* scene) {
        return refusal({"refine", file(stone), file(photo), file(scene), "-o", file("r.obj")});
    };
    EXPECT_THAT(refusal({"refine", file("stone.toml"), file("scene.toml"), "-o", file("r.obj")}),
                testing::HasSubstr("PHOTO"));
    refused("scene.toml", "photo.exr", "stone.toml");
    EXPECT_THAT(refused("stone.toml", "none.png", "scene.toml"), testing::HasSubstr("none.png"));
    EXPECT_FALSE(fs::exists(folder_ / "r.obj"));
}

}  // namespace
}  // namespace culet
