// Scenes made for a stone without a scene file: framing, size, lights and exposure.

#include "render/scene/stone_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/image/exposure.h"
#include "render/planner/quick_picture.h"
#include "render/render.h"
#include "render/scene/framing.h"
#include "render/scene/ground_shadow.h"
#include "render/scene/light_presets.h"
#include "render/scene/scene_io.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

class StoneSceneTest : public test::FolderTest {
protected:
    std::string mesh(const std::string& name, const Solid& solid) const {
        write_solid(solid, file(name));
        return file(name);
    }
    static std::string refusal(const std::string& file, const StoneScene& choices) {
        try {
            read_any_scene(file, {}, choices);
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    }
};

StoneScene of(const std::string& material, const std::string& light = {}) {
    StoneScene choices;
    choices.material = material;
    choices.light = light;
    return choices;
}

// The columns and rows that the stone covers, as shares of the picture's.
std::array<double, 2> spans(const Picture& picture) {
    int left = picture.width, right = -1, top = picture.height, bottom = -1;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto pixel = static_cast<std::size_t>(y * picture.width + x);
            if (!(picture.coverage[pixel] > 0.5f)) continue;
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
    }
    return {double(right - left + 1) / picture.width, double(bottom - top + 1) / picture.height};
}

// The coverage is measured in the picture; the 85 % is from the command's specification.
TEST_F(StoneSceneTest, TheStoneSpans85PercentOfTheTighterSide) {
    struct Case {
        const char *name, *cut, *size;
        int tight;  // 0: across, 1: down
    };
    for (const Case& c :
         {Case{"round", "round-brilliant", "[200,200]", 0}, Case{"oval", "oval", "[200,200]", 0},
          Case{"wide", "round-brilliant", "[300,200]", 1}, Case{"tall", "oval", "[120,200]", 0}}) {
        const std::string stone = mesh(std::string(c.name) + ".obj", make_cut(c.cut));
        for (const char* light : {"jeweller", "hearts", "photograph"}) {
            const Scene scene =
                read_any_scene(stone, {std::string("camera.size=") + c.size}, of("diamond", light));
            const std::array<double, 2> found = spans(draw_quickly(scene).picture);
            const std::size_t tight = static_cast<std::size_t>(c.tight);
            // A perspective view makes the near half larger, by up to 4 %.
            const double least = light == std::string("photograph") ? 0.82 : 0.838;
            EXPECT_GE(found[tight], least) << c.name << " " << light;
            EXPECT_LE(found[tight], 0.862) << c.name << " " << light;
            EXPECT_LE(found[1 - tight], 0.862) << c.name << " " << light;
        }
    }
}

TEST_F(StoneSceneTest, OffCentreMeshesAreFramedToo) {
    Solid solid = make_cut("step");
    for (Vec3& v : solid.vertices) v += Vec3{12, -7, 30};
    for (Facet& facet : solid.facets)
        facet.plane.offset += glm::dot(facet.plane.normal, Vec3{12, -7, 30});
    const Scene scene = read_any_scene(mesh("moved.obj", solid), {"camera.size=[200,200]"},
                                       of("emerald", "daylight"));
    const std::array<double, 2> found = spans(draw_quickly(scene).picture);
    EXPECT_NEAR(std::max(found[0], found[1]), 0.85, 0.012);
}

TEST_F(StoneSceneTest, ASceneWithoutACameraIsFramedAndOneWithACameraIsNot) {
    mesh("stone.obj", make_cut("round-brilliant"));
    const std::string head = "mesh = \"stone.obj\"\nmaterial = \"spinel\"\n";
    const std::string light = "[light]\npreset = \"jeweller\"\n";
    const Scene without = read_scene(write("without.toml", head + light));
    EXPECT_NEAR(spans(draw_quickly(without).picture)[0], 0.85, 0.012);
    const Scene size_alone =
        read_scene(write("size.toml", head + light + "[camera]\nsize = [150, 100]\n"));
    EXPECT_NEAR(spans(draw_quickly(size_alone).picture)[1], 0.85, 0.012);
    const Scene with =
        read_scene(write("with.toml", head + light + "[camera]\nposition = [0, 0, 30]\n"));
    EXPECT_EQ(with.camera.position.z, 30);
    EXPECT_FALSE(with.camera.orthographic_width.has_value());
}

// A photograph's stone is seen in perspective from 12 degrees beside the axis, through a film's
// curve, on a ground; what the scene's [film] says goes before.
TEST_F(StoneSceneTest, AStoneAloneIsShownAsInAPhotograph) {
    const std::string stone = mesh("stone.obj", make_cut("round-brilliant"));
    const Scene scene = read_any_scene(stone, {}, of("diamond"));
    const Vec3 to_eye = glm::normalize(scene.camera.position - scene.camera.look_at);
    EXPECT_NEAR(to_eye.z, std::cos(12 * std::numbers::pi / 180), 1e-12);
    EXPECT_LT(to_eye.y, 0);
    EXPECT_FALSE(scene.camera.orthographic_width.has_value());
    EXPECT_EQ(scene.film.tone_map, ToneMap::filmic);
    EXPECT_GT(scene.film.ground, 0);
    const Scene plain =
        read_any_scene(stone, {"film.tonemap=\"none\"", "film.ground=false"}, of("diamond"));
    EXPECT_EQ(plain.film.tone_map, ToneMap::none);
    EXPECT_EQ(plain.film.ground, 0);
    EXPECT_EQ(plain.film.share_over_white, scene.film.share_over_white) << "as the light has it";
    EXPECT_EQ(read_any_scene(stone, {}, of("diamond", "jeweller")).film.ground, 0);
}

// However it is named.
TEST_F(StoneSceneTest, AViewOfAStoneAloneHasNoOtherLight) {
    const std::string stone = mesh("stone.obj", make_cut("round-brilliant"));
    for (const char* view : {"polariscope", "dichroscope"}) {
        const Scene by_key = read_any_scene(stone, {fmt::format("preset=\"{}\"", view)},
                                            of("sapphire_blue")),
                    by_choice = read_any_scene(stone, {}, of("sapphire_blue", view));
        EXPECT_EQ(by_key.lights.sources.size(), 1u) << view;
        EXPECT_EQ(by_key.camera.orthographic_width, by_choice.camera.orthographic_width) << view;
        EXPECT_EQ(by_key.camera.position, by_choice.camera.position) << view;
    }
}

// Expectation: the part of a cosine-weighted hemisphere that the half spaces of a convex stone
// hide, summed over 90 x 360 directions (its error is below 1 %); the shadow's depth is
// proportional.
TEST(GroundShadow, IsWhatTheStoneHidesOfAnEvenSky) {
    const Solid solid = make_cut("step");
    double lowest = 0;
    for (const Vec3& v : solid.vertices) lowest = std::min(lowest, v.z);
    const auto hidden = [&](const Vec3& place) {
        double sum = 0;
        for (int i = 0; i < 90; ++i) {
            for (int j = 0; j < 360; ++j) {
                const double sine = std::sqrt((i + 0.5) / 90),
                             azimuth = (j + 0.5) * std::numbers::pi / 180;
                const Vec3 d{sine * std::cos(azimuth), sine * std::sin(azimuth),
                             std::sqrt(1 - sine * sine)};
                double from = 0, to = 1e9;
                for (const Facet& facet : solid.facets) {
                    const double speed = glm::dot(facet.plane.normal, d),
                                 gap = facet.plane.offset - glm::dot(facet.plane.normal, place);
                    if (speed < 0) from = std::max(from, gap / speed);
                    if (speed > 0) to = std::min(to, gap / speed);
                }
                sum += from < to;
            }
        }
        return sum / (90 * 360);
    };
    Camera camera;  // from above; the computed points are 8 pixels, half a length, apart
    camera.width = camera.height = 320;
    camera.orthographic_width = 20;
    const std::vector<float> lit = ground_lit(solid, camera);
    const auto shadow = [&](int x, int y) {  // at a computed point: the mean of four pixels
        const auto at = [&](int u, int v) {
            return double(lit[std::size_t(v) * 320 + std::size_t(u)]);
        };
        return 1 - (at(x, y) + at(x - 1, y) + at(x, y - 1) + at(x - 1, y - 1)) / 4;
    };
    const double unit = shadow(160, 80) / hidden({0, 5, lowest});
    EXPECT_GT(unit, 0.5);
    EXPECT_LE(unit, 1);
    for (const auto& [x, y] : {std::pair{224, 160}, {240, 240}, {304, 160}, {96, 120}}) {
        const Vec3 place{(x - 160) / 16.0, (160 - y) / 16.0, lowest};
        EXPECT_NEAR(shadow(x, y), unit * hidden(place), 0.02 * unit) << x << " " << y;
    }
    EXPECT_GT(shadow(200, 160), shadow(304, 160));
}

TEST_F(StoneSceneTest, HeartsAreSeenFromBelowAndAllElseFromAbove) {
    const std::string stone = mesh("stone.obj", make_cut("round-brilliant"));
    for (const LightPreset& preset : light_presets()) {
        const Scene scene = read_any_scene(stone, {}, of("diamond", preset.name));
        const double height = scene.camera.position.z - scene.camera.look_at.z;
        if (std::string(preset.name) == "hearts") {
            EXPECT_LT(height, 0);
        } else {
            EXPECT_GT(height, 0) << preset.name;
        }
        EXPECT_EQ(scene.light_preset, preset.name);
    }
}

TEST_F(StoneSceneTest, HeartsDoNotMoveACameraThatIsNamed) {
    mesh("stone.obj", make_cut("round-brilliant"));
    const Scene scene = read_scene(
        write("scene.toml",
              "mesh = \"stone.obj\"\nmaterial = \"diamond\"\n[camera]\nposition = [0, 0, 50]\n"
              "[light]\npreset = \"hearts\"\n"));
    EXPECT_EQ(scene.camera.position.z, 50);
}

TEST_F(StoneSceneTest, DesignsWithoutASizeAreDrawn6Point5MmWideAndItIsSaid) {
    Solid unit = make_cut("oval");
    const double width = width_along(unit, {0, 1, 0});
    ASSERT_LT(width, width_along(unit, {1, 0, 0})) << "the narrower side is along y";
    for (Vec3& v : unit.vertices) v /= width;
    for (Facet& facet : unit.facets) facet.plane.offset /= width;
    for (const char* name : {"unit.obj", "unit.asc"}) {
        const std::string stone = mesh(name, unit);
        const Scene usual = read_any_scene(stone, {}, of("ruby_pale"));
        EXPECT_NEAR(width_along(usual.stone.solid, {0, 1, 0}), 6.5, 1e-9) << name;
        EXPECT_EQ(usual.stone.unit, LengthUnit::mm);
        ASSERT_EQ(usual.notes.empty(), false);
        EXPECT_NE(usual.notes.front().find("6.5 mm wide"), std::string::npos)
            << usual.notes.front();
        StoneScene choices = of("ruby_pale");
        choices.width_mm = 11;
        const Scene wide = read_any_scene(stone, {}, choices);
        EXPECT_NEAR(width_along(wide.stone.solid, {0, 1, 0}), 11, 1e-9) << name;
        for (const Facet& facet : wide.stone.solid.facets) {
            for (int corner : facet.corners)
                EXPECT_NEAR(
                    height_above(facet.plane,
                                 wide.stone.solid.vertices[static_cast<std::size_t>(corner)]),
                    0, 0.005);
        }
    }
    // A mesh of some millimetres keeps its size.
    const Scene real = read_any_scene(mesh("real.obj", make_cut("oval")), {}, of("ruby_pale"));
    EXPECT_NEAR(width_along(real.stone.solid, {0, 1, 0}), width, 1e-9);
}

TEST_F(StoneSceneTest, AMeshInMetresIsDoubtedUnlessAWidthIsNamed) {
    Solid metres = make_cut("step");
    for (Vec3& v : metres.vertices) v *= 1e-3;
    for (Facet& facet : metres.facets) facet.plane.offset *= 1e-3;
    mesh("metres.obj", metres);
    const std::string file =
        write("metres.toml", "[stone]\nmesh = \"metres.obj\"\nmaterial = \"diamond\"\n");
    const auto doubts = [](const Scene& scene) {
        return std::count_if(scene.notes.begin(), scene.notes.end(), [](const std::string& note) {
            return note.find("name the unit") != std::string::npos;
        });
    };
    StoneScene choices = of("diamond");
    EXPECT_EQ(doubts(read_any_scene(file, {}, choices)), 1);
    choices.width_mm = 5;
    EXPECT_EQ(doubts(read_any_scene(file, {}, choices)), 0);
}

TEST_F(StoneSceneTest, StoneFilesKeepTheirSizeAndMaterial) {
    mesh("stone.obj", make_cut("step"));
    const std::string stone = write(
        "stone.toml", "[stone]\nmesh = \"stone.obj\"\nunit = \"cm\"\nmaterial = \"emerald\"\n");
    const Scene own = read_any_scene(stone, {}, {});
    EXPECT_EQ(own.stone.unit, LengthUnit::cm);
    EXPECT_EQ(own.light_preset, "photograph");
    const Scene other = read_any_scene(stone, {}, of("diamond"));
    EXPECT_EQ(other.stone.material.id, "diamond");
}

TEST_F(StoneSceneTest, RefusalsAreOneLineThatSaysWhatToDo) {
    const std::string stone = mesh("stone.obj", make_cut("step"));
    const auto one_line = [](const std::string& text) {
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << text;
        return text;
    };
    EXPECT_NE(one_line(refusal(stone, {})).find("--material"), std::string::npos);
    const std::string bare = write("bare.toml", "[stone]\nmesh = \"stone.obj\"\n");
    EXPECT_NE(one_line(refusal(bare, {})).find("--material"), std::string::npos);
    EXPECT_NE(one_line(refusal(stone, of("diamond", "jeweler"))).find("\"jeweller\""),
              std::string::npos);
    EXPECT_NE(one_line(refusal(stone, of("diamond", "idealscop"))).find("\"idealscope\""),
              std::string::npos);
    EXPECT_NE(one_line(refusal(file("stone.txt"), of("diamond"))).find(".obj"), std::string::npos);
    const std::string job = write("job.toml", "[fit]\nstone = \"stone.toml\"\n[render]\n");
    EXPECT_NE(one_line(refusal(job, of("diamond"))).find("culet run"), std::string::npos);
    StoneScene choices = of("diamond");
    choices.width_mm = -2;
    EXPECT_NE(one_line(refusal(stone, choices)).find("--width"), std::string::npos);
}

// The design states the index it was drawn for, 1.54: quartz's.
TEST_F(StoneSceneTest, ADesignThatSaysItsIndexIsOfferedMaterialsOfIt) {
    const std::string quartz =
        refusal(CULET_SOURCE_DIR "/tests/stone/designs/srb_class_angles.asc", {});
    EXPECT_NE(quartz.find("1.54"), std::string::npos) << quartz;
    EXPECT_NE(quartz.find("amethyst"), std::string::npos) << quartz;
}

// Work is counted, not timed: a crystal that exhausts its work limit comes out the same on any
// number of threads.
TEST_F(StoneSceneTest, WhatWorkAllowsDoesNotHangOnThreads) {
    Scene scene = read_any_scene(mesh("stone.obj", make_cut("step")), {"camera.size=[20,20]"},
                                 of("zircon_high"));
    scene.settings.allowed_ns = 3e8;
    scene.settings.threads = 1;
    const RenderResult one = render(scene);
    scene.settings.threads = 3;
    const RenderResult three = render(scene);
    EXPECT_EQ(one.picture.rgb, three.picture.rgb);
    EXPECT_EQ(one.stats.allowed_tolerance, three.stats.allowed_tolerance);
}

// Every preset consists of ordinary lights, which every engine takes. Beams are drawn to 2 % of the
// mean. With 64 rays per pixel, 130 000 on the stone, at least 4 % see a light of one: the mean is
// known to 1.4 % (binomial), three times which is 4 %. Previews give each beam one colour, so they
// need only exist.
TEST_F(StoneSceneTest, PresetsAreDrawnByAllEnginesAndAgree) {
    const std::string stone = mesh("stone.obj", make_cut("step"));
    for (const LightPreset& preset : light_presets()) {
        double reference = 0;
        for (const char* engine : {"reference", "beams", "preview"}) {
            Scene scene = read_any_scene(
                stone,
                {std::string("render.engine=\"") + engine + "\"", "camera.size=[60,60]",
                 "render.wavelengths=[550]", "render.effects=\"none\"", "render.tolerance=0.02",
                 "render.samples=64"},
                of("spinel", preset.name));
            const double mean = render(scene).stats.mean_radiance;
            if (std::string(engine) == "reference") reference = mean;
            EXPECT_GT(mean, 0) << preset.name << " " << engine;
            if (std::string(engine) == "preview") continue;
            EXPECT_NEAR(mean, reference, 0.06 * reference) << preset.name << " " << engine;
        }
    }
}

// Of 1000 pixels of the stone 30 are bright; the brighter light beside the stone does not count.
TEST(Exposure, IsThatOfTheStone) {
    Picture picture;
    picture.width = 1100;
    picture.height = 1;
    picture.rgb.assign(3300, 0.1f);
    picture.coverage.assign(1100, 1.0f);
    for (std::size_t p = 0; p < 30; ++p) picture.rgb[3 * p + 1] = 0.5f;
    for (std::size_t p = 1000; p < 1100; ++p) {
        picture.coverage[p] = 0;
        picture.rgb[3 * p] = 100;
    }
    EXPECT_NEAR(exposure_for_stone(picture), 2, 1e-6) << "3 % are at 0.5: one in fifty is above";
    for (std::size_t p = 0; p < 15; ++p) picture.rgb[3 * p + 1] = 0.1f;
    EXPECT_NEAR(exposure_for_stone(picture), 10, 1e-5) << "now 1.5 % are: let them burn out";
    picture.rgb.assign(3300, 0);
    EXPECT_EQ(exposure_for_stone(picture), 1) << "nothing to expose to";
}

// Expectation: the definition, by sorting.
TEST(Exposure, LeavesAShareOfPixelsOverWhite) {
    Picture picture;
    picture.width = 61;
    picture.height = 47;
    std::vector<double> brightest;
    double value = 0.37;
    for (std::size_t i = 0; i < 3 * picture.pixels(); ++i) {
        value = std::fmod(value * 1.6180339887 + 0.1234567, 1.0);
        picture.rgb.push_back(static_cast<float>(std::exp(30 * value - 15)) *
                              (i % 11 == 0 ? -1.0f : 1.0f));
    }
    picture.rgb[30] = INFINITY;
    picture.coverage.assign(picture.pixels(), 1);
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        const float* rgb = picture.rgb.data() + 3 * p;
        const float most = std::max({rgb[0], rgb[1], rgb[2]});
        if (std::isfinite(most)) brightest.push_back(most);
    }
    std::sort(brightest.begin(), brightest.end());
    for (const double share : {0.02, 0.1}) {
        const auto at =
            static_cast<std::size_t>((1 - share) * static_cast<double>(brightest.size() - 1));
        EXPECT_EQ(exposure_for_stone(picture, share), 1 / brightest[at]);
    }
    EXPECT_EQ(exposure_for_stone(picture), exposure_for_stone(picture, 0.02));
}

}  // namespace
}  // namespace culet
