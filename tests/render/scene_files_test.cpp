// What a scene file may say about its stone and lights. Expectations: docs/rendering.md, closed
// forms of where a light is seen.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

#include "render/image/image_io.h"
#include "render/reference/light_field.h"
#include "render/scene/light_presets.h"
#include "render/scene/scene_io.h"
#include "render/setup/scene_checks.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace {

using namespace culet;

const char* const k_tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class SceneStones : public test::FolderTest {
protected:
    void SetUp() override {
        write("mesh.obj", k_tetrahedron);
        write("stone.toml",
              "[stone]\nname = \"Red\"\nmesh = \"mesh.obj\"\nunit = \"cm\"\n"
              "material = \"corundum\"\noptic_axis = [1, 0, 0]\n");
    }
    void write(const char* name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    Scene read(const std::string& text) const {
        write("scene.toml", text);
        return read_scene(folder_ / "scene.toml");
    }
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    Picture map(int width, int height, float value) const {
        Picture picture;
        picture.width = width;
        picture.height = height;
        picture.rgb.assign(3 * picture.pixels(), value);
        return picture;
    }
};

const std::string k_light = "[light]\nconstant = 1\n";

TEST_F(SceneStones, AStoneFileBringsItsMaterialAxisAndUnit) {
    const Stone stone = read("stone = \"stone.toml\"\n" + k_light).stone;
    EXPECT_EQ(stone.name, "Red");
    EXPECT_EQ(stone.material.id, "corundum");
    EXPECT_EQ(stone.unit, LengthUnit::cm);
    EXPECT_EQ(stone.crystal.axes[0], (Vec3{1, 0, 0}));
}

TEST_F(SceneStones, TheSceneMayShowTheSameStoneInAnotherMaterial) {
    const Stone named =
        read("stone = \"stone.toml\"\nmaterial = \"diamond\"\nname = \"White\"\n" + k_light).stone;
    EXPECT_EQ(named.material.id, "diamond");
    EXPECT_EQ(named.name, "White");
    EXPECT_EQ(named.unit, LengthUnit::cm);
    const Stone own = read("stone = \"stone.toml\"\n" + k_light +
                           "[material]\noptic = \"isotropic\"\nindex = 1.75\n")
                          .stone;
    EXPECT_EQ(own.material.index[0].at(550), 1.75);
    const Stone turned = read("stone = \"stone.toml\"\noptic_axis = [0, 3, 0]\n" + k_light).stone;
    EXPECT_EQ(turned.crystal.axes[0], (Vec3{0, 1, 0}));
    EXPECT_EQ(turned.material.id, "corundum");
}

TEST_F(SceneStones, AMeshTakesAMaterialTableUnitAndName) {
    const Stone stone = read("mesh = \"mesh.obj\"\nunit = \"in\"\nname = \"Own\"\n" + k_light +
                             "[material]\noptic = \"isotropic\"\nindex = 1.5\n")
                            .stone;
    EXPECT_EQ(stone.name, "Own");
    EXPECT_EQ(stone.unit, LengthUnit::inch);
    EXPECT_EQ(stone.material.index[0].at(550), 1.5);
}

TEST_F(SceneStones, ASceneMayScaleWhatTheMaterialAbsorbs) {
    const std::string stone = "stone = \"stone.toml\"\nmaterial = \"sapphire_blue\"\n";
    const auto absorption = [&](const std::string& scale) {
        return read(stone + scale + k_light).stone.material.absorption_per_mm[0].at(580);
    };
    const double whole = absorption("");
    EXPECT_GT(whole, 0);
    EXPECT_EQ(absorption("absorption_scale = 2.5\n"), 2.5 * whole);
    EXPECT_EQ(absorption("absorption_scale = 0\n"), 0);
    EXPECT_NE(refusal(stone + "absorption_scale = -1\n" + k_light).find(":3:"), std::string::npos);
}

TEST_F(SceneStones, KeysThatWouldBeIgnoredAreRefused) {
    EXPECT_NE(refusal("stone = \"stone.toml\"\nunit = \"mm\"\n" + k_light).find(":2:"),
              std::string::npos);
    EXPECT_NE(refusal("stone = \"stone.toml\"\nconvex = false\n" + k_light).find(":2:"),
              std::string::npos);
    EXPECT_NE(refusal("stone = \"stone.toml\"\nmesh = \"mesh.obj\"\n" + k_light), "");
}

TEST_F(SceneStones, NotesOfTheMeshReachTheReader) {
    std::string inside_out = k_tetrahedron;  // turn every face
    for (const auto& [from, to] :
         {std::pair{"f 1 3 2", "f 1 2 3"}, std::pair{"f 1 2 4", "f 1 4 2"},
          std::pair{"f 1 4 3", "f 1 3 4"}, std::pair{"f 2 3 4", "f 2 4 3"}})
        inside_out.replace(inside_out.find(from), 7, to);
    write("mesh.obj", inside_out);
    const std::size_t from_mesh = read_solid(folder_ / "mesh.obj").notes.size();
    EXPECT_EQ(read("mesh = \"mesh.obj\"\nmaterial = \"diamond\"\n" + k_light).notes.size(),
              from_mesh);
    EXPECT_EQ(read("stone = \"stone.toml\"\n" + k_light).notes.size(), from_mesh);
}

TEST_F(SceneStones, TooMuchIsRefusedBeforeItIsBegun) {
    const std::string head = "stone = \"stone.toml\"\n" + k_light;
    EXPECT_NE(refusal(head + "[camera]\nsize = [32768, 32768]\n").find("2^28"), std::string::npos);
    std::string list = "[render]\nwavelengths = [300";
    for (int i = 1; i <= 1000; ++i) list += ", " + std::to_string(300 + i);
    EXPECT_NE(refusal(head + list + "]\n").find("1001"), std::string::npos);
    EXPECT_NE(refusal(head + "[render]\nengine = \"referense\"\n").find("\"reference\""),
              std::string::npos);
}

// A float ends at 3.4e38 and loses digits below 1.2e-38.
TEST_F(SceneStones, RadiancesThatNoPictureCanHoldAreRefused) {
    const std::string head = "stone = \"stone.toml\"\n[light]\n";
    for (const char* fits : {"0", "1e-35", "1e35"}) {
        EXPECT_EQ(read(head + "constant = " + fits + "\n").lights.constant, std::stod(fits));
    }
    for (const char* beyond : {"1e-300", "1e-37", "1e37", "1e300"}) {
        const std::string said = refusal(head + "constant = " + beyond + "\n");
        EXPECT_NE(said.find(":3:"), std::string::npos) << said;
        EXPECT_NE(said.find("scale all lights"), std::string::npos) << said;
        EXPECT_NE(refusal(head + "[[light.lobe]]\ndirection = [0, 0, 1]\nradiance = [1, " + beyond +
                          ", 1]\n"),
                  "");
    }
}

TEST_F(SceneStones, AFlatStoneIsRefused) {
    std::string flat = k_tetrahedron;
    const std::size_t apex = flat.rfind("v ");
    flat.replace(apex, flat.find('\n', apex) - apex, "v 0.3 0.3 0");
    write("flat.obj", flat);
    const Scene scene = read("mesh = \"flat.obj\"\nmaterial = \"diamond\"\n" + k_light);
    EXPECT_THROW(require_renderable(scene), InputError);
}

TEST_F(SceneStones, EnvironmentsOfEveryKind) {
    const std::string scene = "stone = \"stone.toml\"\n[light]\nenvironment = \"map.exr\"\n";
    write_picture(map(8, 4, 0.5f), folder_ / "map.exr");
    EXPECT_EQ(read(scene).lights.environment->width, 8);

    Picture bad = map(8, 4, 0.5f);
    bad.rgb[3 * (2 * 8 + 5) + 1] = std::numeric_limits<float>::infinity();
    write_picture(bad, folder_ / "map.exr");
    EXPECT_NE(refusal(scene).find("5,2"), std::string::npos) << "names the pixel";
    EXPECT_NE(refusal(scene).find(":3:"), std::string::npos);

    Picture negative = map(8, 4, 0.5f);
    negative.rgb[7] = -1;
    write_picture(negative, folder_ / "map.exr");
    const Scene clamped = read(scene);
    EXPECT_EQ(clamped.lights.environment->rgb[7], 0.0f);
    ASSERT_EQ(clamped.notes.size(), 1u);

    write_picture(map(6, 1, 1.0f), folder_ / "map.exr");
    EXPECT_NE(refusal(scene).find("cube map"), std::string::npos);
    write_picture(map(7, 4, 1.0f), folder_ / "map.exr");
    EXPECT_NE(refusal(scene).find("twice as wide"), std::string::npos);

    write_picture(map(8, 4, 1.0f), folder_ / "map.png");
    const Scene encoded = read("stone = \"stone.toml\"\n[light]\nenvironment = \"map.png\"\n");
    EXPECT_EQ(encoded.notes.size(), 1u) << "a picture of 8 bits holds no bright lights";

    // Radiance's filefmts: pixels have been multiplied by EXPOSURE; 128 with exponent 129 is 1.
    write("map.hdr", "#?RADIANCE\nEXPOSURE=4\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81");
    const Scene exposed = read("stone = \"stone.toml\"\n[light]\nenvironment = \"map.hdr\"\n");
    EXPECT_EQ(exposed.lights.environment->rgb[0], 0.25f);
    ASSERT_EQ(exposed.notes.size(), 1u);
    EXPECT_EQ(exposed.notes[0].find("map.hdr: it names no FORMAT"), 0u);
}

// A quarter turn about z takes x to y, and near lights turn about the stone's middle.
TEST_F(SceneStones, LightsAreRotatedAboutTheStonesMiddle) {
    const Scene scene = read(
        "stone = \"stone.toml\"\n[light]\nrotate = [0, 0, 90]\n[[light.lobe]]\ndirection = [1, 0, "
        "0]\n[[light.sphere]]\ncenter = [5, 0, 0]\nradius = 1\n");
    const Vec3 direction = nth_light<CosinePowerLight>(scene.lights, 0).direction;
    EXPECT_NEAR(glm::length(direction - Vec3{0, 1, 0}), 0, 1e-15);
    const Vec3 middle = centroid(scene.stone.solid), from = Vec3{5, 0, 0} - middle;
    const Vec3 center = nth_light<SphereLight>(scene.lights, 0).center;
    EXPECT_NEAR(glm::length(center - (middle + Vec3{-from.y, from.x, from.z})), 0, 1e-14);
    EXPECT_NE(refusal("stone = \"stone.toml\"\n[light]\nconstant = 1\nrotate = 3\n"), "");
}

TEST_F(SceneStones, ASceneMayHoldItsFilesItself) {
    write_picture(map(8, 4, 0.5f), folder_ / "map.exr");
    std::ifstream stream(folder_ / "map.exr", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    const TomlTable root =
        toml_of_text("[light]\nenvironment = \"held.exr\"\n", "page", {}, {{"held.exr", bytes}});
    EXPECT_EQ(scene_of(root, &stone).lights.environment->width, 8);
    const TomlTable without = toml_of_text("[light]\nenvironment = \"held.exr\"\n", "page");
    EXPECT_THROW(scene_of(without, &stone), InputError);
}

TEST_F(SceneStones, HalfExtentsLieInTheirPlane) {
    const std::string head = "stone = \"stone.toml\"\n" + k_light +
                             "[[light.plane]]\npoint = [0, 0, 9]\nnormal = [0, 0, -1]\n";
    EXPECT_NE(refusal(head + "u = [1, 0, 1]\nv = [0, 1, 0]\n").find(":7:"), std::string::npos);
    EXPECT_NE(refusal(head + "u = [1, 0, 0]\nv = [2, 0, 0]\n").find("span"), std::string::npos);
    EXPECT_NE(refusal(head + "u = [1, 0, 0]\n").find("both"), std::string::npos);
    const Lights lights = read(head + "u = [2, 0, 0.001]\nv = [0, 1, 0]\n").lights;
    EXPECT_EQ(*nth_light<PlaneLight>(lights, 0).u, (Vec3{2, 0, 0}));
}

TEST(Lights, ADomeShinesOnWhatStandsInside) {
    Lights lights;
    lights.constant = 0.1;
    lights.sources.push_back(SphereLight{{0, 0, 0}, 10, {2.0}});
    lights.sources.push_back(SphereLight{{0, 0, 5}, 1, {3.0}});
    const LightField field(lights, WavelengthSet({550}));
    const auto seen = [&](const Vec3& origin, const Vec3& direction) {
        double radiance = 0;
        field.add_radiance(origin, direction, 1, 0, 1, &radiance);
        return radiance;
    };
    EXPECT_EQ(seen({0, 0, 0}, {1, 0, 0}), 2);
    EXPECT_EQ(seen({0, 0, 0}, {0, 0, 1}), 3) << "the lamp inside the dome is nearer";
    EXPECT_EQ(seen({0, 0, 20}, {0, 0, -1}), 2) << "from outside, the dome is a ball";
    EXPECT_EQ(seen({0, 0, 20}, {0, 0, 1}), 0.1) << "behind the eye";
    EXPECT_EQ(field.name_at({0, 0, 0}, {0, 0, 1}), "sphere 1");
}

TEST(Lights, NoRayIsBrighterThanTheBound) {
    // Fixed directions over the sphere; coloured lights and few nodes, with spectra above 1.
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 8;
    map->height = 4;
    for (int i = 0; i < 96; ++i) map->rgb.push_back(static_cast<float>((i * 37) % 19) / 19.0f);
    Lights lights;
    lights.environment = map;
    lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 2, {Rgb{1, 0, 0.2}}});
    lights.sources.push_back(HemisphereLight{{1, 0, 0}, {std::string("A")}});
    for (const int count : {1, 2, 3, 5, 15}) {
        std::vector<double> nm;
        for (int i = 0; i < count; ++i) nm.push_back(430 + 60.0 * i / std::max(1, count - 1) * 4);
        const LightField field(lights, WavelengthSet(nm));
        for (int k = 0; k < 500; ++k) {
            const double z = -1 + 2 * (k + 0.5) / 500, a = 2.399963 * k, r = std::sqrt(1 - z * z);
            std::vector<double> radiance(nm.size(), 0.0);
            field.add_radiance({0, 0, 0}, {r * std::cos(a), r * std::sin(a), z}, 1, 0, count,
                               radiance.data());
            for (double v : radiance) ASSERT_LE(v, field.max_radiance() * (1 + 1e-12)) << count;
        }
    }
}

TEST(Lights, AsetHasTheZonesOfTheAgs) {
    // AGS Laboratories, Angular Spectrum Evaluation Tool: by elevation, green to 45 degrees, red to
    // 75, blue above.
    const LightField field(*light_preset("aset"), WavelengthSet({450, 540, 620}));
    const auto name = [&](double elevation_deg) {
        return field.name_at(
            {0, 0, 0}, {std::cos(radians(elevation_deg)), 0, std::sin(radians(elevation_deg))});
    };
    EXPECT_EQ(name(90), "cap 0");
    EXPECT_EQ(name(75.1), "cap 0");
    EXPECT_EQ(name(74.9), "cap 1");
    EXPECT_EQ(name(45.1), "cap 1");
    EXPECT_EQ(name(44.9), "cap 2");
    EXPECT_EQ(name(0.1), "cap 2");
    EXPECT_EQ(name(-0.1), "dark");
    for (const LightPreset& preset : light_presets())
        EXPECT_TRUE(light_preset(preset.name).has_value()) << preset.name;
    EXPECT_FALSE(light_preset("disco").has_value());
}

TEST(Environment, ABrightTexelIsSeenWhereTheContractPutsIt) {
    // One texel of an asymmetric map: column 6 of 8, row 1 of 4. Its middle lies at 6.5/8 of the
    // width, 5/16 of a turn right of +x, azimuth -112.5 degrees, and 3/8 of the way down, 67.5
    // degrees from +z.
    EnvironmentMap map;
    map.width = 8;
    map.height = 4;
    map.rgb.assign(96, 0.0f);
    map.rgb[3 * (8 + 6)] = 1;
    const double azimuth = radians(-112.5), polar = radians(67.5);
    const Vec3 centre{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                      std::cos(polar)};
    EXPECT_NEAR(map.at(centre)[0], 1, 1e-12);
    EXPECT_NEAR(map.at({centre.x, -centre.y, centre.z})[0], 0, 1e-12) << "not its mirror image";
    EXPECT_NEAR(map.at({centre.x, centre.y, -centre.z})[0], 0, 1e-12);
}

}  // namespace
