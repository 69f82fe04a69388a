// Expectations: oracle/ray_trees.json, whole trees of light paths from an independent tracer in
// 50-digit arithmetic (oracle/ray_trees.py describes its method).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "render/reference/probe.h"

namespace {

using namespace culet;
using Json = nlohmann::json;

Vec3 vector_of(const Json& list) {
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

Solid solid_of(const Json& planes) {
    std::vector<NamedPlane> named;
    for (const Json& plane : planes) {
        const Vec3 normal = vector_of(plane["normal"]);
        const double length = glm::length(normal);
        named.push_back({"f" + std::to_string(named.size()),
                         {normal / length, plane["offset"].get<double>() / length}});
    }
    return intersect_half_spaces(named).solid;
}

TEST(RayTrees, RadianceAndRemainderEqualFiftyDigitArithmetic) {
    std::ifstream file(CULET_SOURCE_DIR "/tests/render/oracle/ray_trees.json");
    ASSERT_TRUE(file.is_open());
    const Json oracle = Json::parse(file);
    double worst = 0;
    int compared = 0;
    for (const Json& item : oracle["cases"]) {
        Scene scene;
        scene.stone.solid = solid_of(oracle["stones"][item["stone"].get<std::string>()]);
        for (int axis = 0; axis < 3; ++axis)
            scene.stone.crystal.axes[axis] = vector_of(item["axes"][axis]);
        const Json& n = item["n"];
        const bool uniaxial = n[1] == n[2];
        Material& material = scene.stone.material;
        material.optic = uniaxial ? OpticCharacter::uniaxial : OpticCharacter::biaxial;
        // The catalogue's order: o, e; alpha, beta, gamma.
        for (int ray = 0; ray < 3; ++ray) material.index[ray].n = n[ray].get<double>();
        if (uniaxial) {
            material.index[0].n = n[1].get<double>();
            material.index[1].n = n[0].get<double>();
        }
        scene.lights.constant = oracle["constant"].get<double>();
        CosinePowerLight lobe;
        lobe.direction = glm::normalize(vector_of(oracle["lobe"]["direction"]));
        lobe.exponent = oracle["lobe"]["exponent"].get<double>();
        lobe.radiance.value = oracle["lobe"]["radiance"].get<double>();
        scene.lights.sources.push_back(lobe);
        HemisphereLight half;
        half.direction = glm::normalize(vector_of(oracle["hemisphere"]["direction"]));
        half.radiance.value = oracle["hemisphere"]["radiance"].get<double>();
        scene.lights.sources.push_back(half);
        scene.settings.tolerance = 0;
        scene.settings.depth = item["depth"].get<int>();
        scene.settings.wavelengths_nm = {589.3};
        const ProbeResult result =
            probe(scene, {vector_of(item["origin"]), glm::normalize(vector_of(item["direction"]))});
        ASSERT_TRUE(result.hit);
        const double radiance = std::stod(item["radiance"].get<std::string>());
        const double remainder = std::stod(item["remainder"].get<std::string>());
        const double error = std::max(std::abs(result.radiance[0] - radiance),
                                      std::abs(result.remainder[0] - remainder));
        // Required is 1e-10; measured 1.3e-15. A few units in the last place for each of 6 hits
        // stay under 1e-13 with any compiler.
        EXPECT_LT(error, 1e-13) << item["stone"] << " " << item["material"];
        worst = std::max(worst, error);
        ++compared;
    }
    EXPECT_GE(compared, 40);
    RecordProperty("worst", fmt::format("{:.2g}", worst));
}

}  // namespace
