// The page's engine against the command line's renderer: same scene, same bytes.

#include "viewer/engine/viewer_engine.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "render/image/exposure.h"
#include "render/image/shown_bytes.h"
#include "render/planner/quick_picture.h"
#include "render/reference/probe.h"
#include "render/render.h"
#include "render/scene/light_presets.h"
#include "render/scene/scene_io.h"
#include "render/scene/stone_scene.h"
#include "render/scene/transform.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"
#include "viewer/engine/viewer_document.h"
#include "viewer/view_item.h"

namespace culet {
namespace {

using Json = nlohmann::ordered_json;

Stone stone_of(const std::string& cut, const std::string& material) {
    Stone stone;
    stone.name = cut;
    stone.solid = make_cut(cut);
    stone.material = catalogue_material(material);
    return stone;
}

ViewDocument document_of(const Stone& stone, const std::string& scene) {
    ViewItem item;
    item.name = stone.name;
    ViewedStone viewed;
    viewed.stone = stone;
    item.stones.push_back(viewed);
    item.scene = scene;
    ViewDocument document;
    document.title = stone.name;
    document.items.push_back(item);
    return document;
}

// `culet render --engine beams --check none` and its PNG's bytes.
std::vector<std::uint8_t> rendered(const Stone& stone, const std::string& scene_toml,
                                   std::vector<std::string> keys) {
    keys.emplace_back("render.engine=\"beams\"");
    keys.emplace_back("render.check=\"none\"");
    const TomlTable root = toml_of_text(scene_toml, "scene.toml", keys);
    Stone said = stone;
    apply_stone_keys(root, said);
    const Scene scene = scene_of(root, &said);
    const RenderResult result = render(scene);
    PngLook look = scene.film;
    const LightPreset* const preset = find_light_preset(scene.light_preset);
    if (preset != nullptr && !preset->instrument)
        look.exposure = exposure_for_stone(result.picture, look.share_over_white);
    return shown_bytes(result.picture, look, true);
}

struct Opened {
    explicit Opened(const ViewDocument& document) : engine("test") {
        answer = Json::parse(engine.answer("open", "{}", document_json(document)));
    }
    Opened(const Stone& stone, const std::string& scene) : Opened(document_of(stone, scene)) {}
    Json call(const char* name, const Json& arguments, const std::string& attached = {}) {
        return Json::parse(engine.answer(name, arguments.dump(), attached));
    }
    std::string refusal(const char* name, const Json& arguments, const std::string& attached = {}) {
        try {
            call(name, arguments, attached);
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    }

    ViewerEngine engine;
    Json answer;
};

constexpr const char* k_jeweller = "light = { preset = \"jeweller\" }\n";

Json of_size(int side) {
    return {{"width", side}, {"height", side}};
}

// Expectation: the program itself, `render()`.
TEST(ViewerEngine, DrawsTheBytesOfTheCommandLine) {
    struct Case {
        const char *cut, *material, *scene;
        std::vector<std::string> keys;
    };
    const Case cases[] = {
        {"round-brilliant", "diamond", k_jeweller, {}},
        {"round-brilliant", "diamond", k_jeweller, {"light={preset=\"aset\"}"}},
        {"step",
         "tourmaline_dravite",
         k_jeweller,
         {"render.tolerance=0.05", "render.depth=6", "film.tonemap=\"filmic\""}},
        {"oval",
         "sapphire_blue",
         "light = { preset = \"daylight\" }\n",
         {"optic_axis=[1,0,0.2]", "immersion=1.33", "render.tolerance=0.1"}},
        {"round-brilliant",
         "zircon_high",
         k_jeweller,
         {"material=\"ruby_gem\"", "render.effects=[\"absorption\"]",
          "render.wavelengths=[589.3]"}},
        {"princess",
         "garnet_almandine",
         "light = { preset = \"jeweller\", rotate = [10, 20, 30] }\n",
         {"render.tolerance=0.1"}},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(fmt::format("{} {}", one.cut, one.material));
        const Stone stone = stone_of(one.cut, one.material);
        Opened page(stone, one.scene);
        const Json set = page.call("set", {{"stone", 0}, {"settings", one.keys}});
        EXPECT_EQ(set.at("refused"), "");
        std::vector<std::string> keys = one.keys;
        keys.emplace_back("camera.size=[120,120]");
        const Json drawn = page.call("draw", of_size(120));
        EXPECT_GT(drawn.at("beams"), 100);
        EXPECT_EQ(page.engine.pixels(), rendered(stone, one.scene, keys));
    }
}

// A view from the call's camera equals that from the scene's keys.
TEST(ViewerEngine, LooksAsAScenesCameraDoes) {
    const Stone stone = stone_of("round-brilliant", "diamond");
    Opened page(stone, k_jeweller);
    Json view = of_size(90);
    view["camera"] = {
        {"position", {3, -20, 25}}, {"look_at", {0, 0, -0.5}}, {"up", {0, 0, 1}}, {"fov_deg", 15}};
    page.call("draw", view);
    const std::vector<std::uint8_t> expected =
        rendered(stone, k_jeweller,
                 {"camera.size=[90,90]", "camera.position=[3,-20,25]", "camera.look_at=[0,0,-0.5]",
                  "camera.up=[0,0,1]", "camera.fov=15"});
    EXPECT_EQ(page.engine.pixels(), expected);
    Json other = of_size(90);
    other["camera"] = {
        {"position", {0, 0, 40}}, {"look_at", {0, 0, 0}}, {"up", {0, 1, 0}}, {"width", 8}};
    other["quick"] = true;
    page.call("draw", other);
    page.call("draw", view);
    EXPECT_EQ(page.engine.pixels(), expected);
}

// A page begins where its light is seen best; a polariscope there is the command's all the same.
TEST(ViewerEngine, APolariscopeIsTheSameWhateverTheLightBefore) {
    const Stone stone = stone_of("round-brilliant", "zircon_high");
    for (const char* light : {"", "jeweller"}) {
        SCOPED_TRACE(light);
        ViewSource source;
        source.cut = CutChoice{"round-brilliant", {}};
        source.choices.material = "zircon_high";
        source.choices.light = light;
        std::vector<std::string> notes;
        ViewDocument document;
        document.items.push_back(view_item(source, notes));
        Opened page(document);
        std::vector<std::string> keys{"light={preset=\"polariscope\",polarizer=20}",
                                      "render.tolerance=0.2", "render.wavelengths=[450,540,610]"};
        page.call("set", {{"settings", keys}});
        const Json& camera = page.answer.at("camera");
        Json view = of_size(90);
        view["camera"] = camera;
        page.call("draw", view);
        keys.emplace_back("camera.size=[90,90]");
        for (const char* key : {"position", "look_at", "up"})
            keys.push_back(fmt::format("camera.{}={}", key, camera.at(key).dump()));
        const bool is_far = camera.contains("width");
        keys.push_back(fmt::format("camera.{}={}", is_far ? "orthographic_width" : "fov",
                                   camera.at(is_far ? "width" : "fov_deg").dump()));
        EXPECT_EQ(page.engine.pixels(), rendered(stone, "", keys));
    }
}

// Expectation: the polariscope of the turned view itself. The turned light is the same but for
// rounding, and few beams decide by it.
TEST(ViewerEngine, APolariscopeTurnsWithTheEye) {
    const Stone stone = stone_of("round-brilliant", "zircon_high");
    const std::vector<std::string> keys{"render.tolerance=0.2", "render.wavelengths=[450,540,610]"};
    const Vec3 middle{0, 0, -1}, back{0, -0.6, 0.8}, up{0, 0.8, 0.6};
    const std::string scene = fmt::format(
        "light = {{ preset = \"polariscope\", polarizer = 20 }}\n"
        "camera = {{ position = [0, {}, {}], look_at = [0, 0, -1], up = [0, 0.8, 0.6], "
        "orthographic_width = 9 }}\n",
        60 * back.y, 60 * back.z - 1);
    Opened page(stone, scene);
    page.call("set", {{"settings", keys}});
    const glm::dmat3 turn = rotation_of({25, -40, 70});
    Json view = of_size(120);
    std::vector<double> rows;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) rows.push_back(turn[column][row]);
    }
    view["turn"] = rows;
    const Vec3 position = middle + turn * (60.0 * back), turned_up = turn * up;
    const auto list = [](const Vec3& v) { return Json{v.x, v.y, v.z}; };
    view["camera"] = {{"position", list(position)},
                      {"look_at", list(middle)},
                      {"up", list(turned_up)},
                      {"width", 9}};
    page.call("draw", view);
    std::vector<std::string> all = keys;
    all.emplace_back("camera.size=[120,120]");
    all.push_back("camera.position=" + list(position).dump());
    all.push_back("camera.up=" + list(turned_up).dump());
    const auto expected = rendered(stone, scene, all);
    ASSERT_EQ(expected.size(), page.engine.pixels().size());
    int apart = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        apart += std::abs(expected[i] - page.engine.pixels()[i]) > 1;
    EXPECT_LE(apart, 0.001 * static_cast<double>(expected.size()));
}

// A quarter about z takes x to y: matrix rows and light.rotate agree.
TEST(ViewerEngine, TurnsLightsByRowsOfAMatrix) {
    const Stone stone = stone_of("step", "diamond");
    Opened page(stone, k_jeweller);
    page.call("draw", of_size(80));
    const std::vector<std::uint8_t> unturned = page.engine.pixels();
    Json turned = of_size(80);
    turned["turn"] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    page.call("draw", turned);
    EXPECT_NE(page.engine.pixels(), unturned);
    const auto expected =
        rendered(stone, k_jeweller, {"camera.size=[80,80]", "light.rotate=[0,0,90]"});
    // cos(90 degrees) is 6e-17 and not 0: a byte may round the other way.
    ASSERT_EQ(expected.size(), page.engine.pixels().size());
    int apart = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        apart += std::abs(expected[i] - page.engine.pixels()[i]) > 1;
    EXPECT_EQ(apart, 0);
}

// Expectation: the program's own quick picture, and its reference with one ray per pixel.
TEST(ViewerEngine, DrawsAStoneThatIsNotConvexByRays) {
    Stone heart = stone_of("heart", "diamond");
    heart.convex = false;
    Opened page(heart, k_jeweller);
    const Json set = page.call("set", {{"settings", {"render.tolerance=0.1"}}});
    EXPECT_EQ(set.at("refused"), "");
    EXPECT_EQ(set.at("engine"), "reference");
    Scene scene = scene_of(
        toml_of_text(k_jeweller, "scene.toml", {"render.tolerance=0.1", "render.samples=1"}),
        &heart);
    scene.camera.width = scene.camera.height = 24;
    scene.settings.engine = k_reference_engine;
    scene.settings.check = Check::none;
    const auto drawn = [&](const char* engine) {
        Json asked = of_size(24);
        asked.update({{"engine", engine}, {"samples", 1}, {"exposure", 1}});
        page.call("draw", asked);
        return page.engine.pixels();
    };
    EXPECT_EQ(drawn("preview"), shown_bytes(draw_quickly(scene).picture, scene.film, true));
    EXPECT_EQ(drawn("beams"), shown_bytes(render(scene).picture, scene.film, true));
}

// Expectation: conservation, as in `culet probe`: all weights and losses add up to 1.
TEST(ViewerEngine, PathsAreThoseOfProbe) {
    const Stone stone = stone_of("round-brilliant", "diamond");
    Opened page(stone, k_jeweller);
    Json place = of_size(200);
    place["x"] = 80.5;
    place["y"] = 93.5;
    const Json paths = page.call("path", place);
    double sum = paths.at("remainder").get<double>() + paths.at("absorbed").get<double>() +
                 paths.at("cut").get<double>();
    for (const Json& path : paths.at("paths")) sum += path.at("weight").get<double>();
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_EQ(paths.at("paths")[0].at("facets")[0], "T");
}

// A furnace: with light of 1 from everywhere every pixel of a stone without absorption is 1, less
// what is not followed.
TEST(ViewerEngine, APanoramaOfOneIsAFurnace) {
    Opened page(stone_of("round-brilliant", "diamond"), k_jeweller);
    std::string pfm = "PF\n8 4\n-1.0\n";
    for (int i = 0; i < 8 * 4 * 3; ++i) {
        const float one = 1;
        pfm.append(reinterpret_cast<const char*>(&one), sizeof one);
    }
    const Json taken = page.call("panorama", {{"name", "a room.pfm"}}, pfm);
    EXPECT_EQ(taken.at("setting"), "light={environment=\"a_room.pfm\"}");
    page.call("set", {{"settings", {taken.at("setting"), "render.tolerance=0.001"}}});
    page.call("radiance", of_size(60));
    double most = 0, least = 2;
    for (const float v : page.engine.radiance()) {
        most = std::max(most, double{v});
        least = std::min(least, double{v});
    }
    EXPECT_NEAR(most, 1, 1e-4);
    EXPECT_GT(least, 0.99);
}

// Expectation: the program's own reader, from a file of that name.
TEST(ViewerEngine, ReadsADroppedStoneAsTheProgramReadsItsFile) {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "it's a heart.obj";
    write_solid(make_cut("heart"), file);
    Opened page(stone_of("round-brilliant", "diamond"), k_jeweller);
    const Json read =
        page.call("stone", {{"name", file.string()}, {"material", "topaz_blue"}}, read_text(file));
    const Json& item = read.at("item");
    EXPECT_EQ(item.at("name"), file.filename().string());
    EXPECT_TRUE(item.at("command").get<std::string>().starts_with(
        "culet render 'it'\\''s a heart.obj' --material topaz_blue"));
    StoneScene choices;
    choices.material = "topaz_blue";
    const Stone expected = read_any_scene(file, {}, choices).stone;
    const ViewItem held =
        read_view_item(Json{{"schema", "culet-view-1"}, {"items", Json::array({item})}}.dump(), 0);
    const Stone& stone = held.stones.at(0).stone;
    EXPECT_EQ(stone.solid.vertices, expected.solid.vertices);
    EXPECT_EQ(stone.material.id, "topaz_blue");
    EXPECT_FALSE(stone.convex);
    // Without a choice it has the material of the stone that is shown.
    const Json own = page.call("stone", {{"name", "-.obj"}}, read_text(file));
    EXPECT_EQ(own.at("item").at("command").get<std::string>().find(
                  "culet render ./-.obj --material diamond"),
              0u);
    Stone unnamed = stone_of("round-brilliant", "diamond");
    unnamed.material.id.clear();
    Opened other(unnamed, k_jeweller);
    EXPECT_EQ(other.call("stone", {{"name", "-.obj"}}, read_text(file)).at("item").at("command"),
              "culet render ./-.obj --material MATERIAL.toml");
}

TEST(ViewerEngine, ListsEveryDensityOfTheCatalogue) {
    const Opened page(stone_of("round-brilliant", "diamond"), k_jeweller);
    int known = 0;
    for (const Json& entry : page.answer.at("materials")) {
        const auto density = catalogue_material(entry.at("name").get<std::string>()).density_g_cm3;
        ASSERT_EQ(entry.contains("density_g_cm3"), density.has_value()) << entry;
        if (!density) continue;
        EXPECT_EQ(entry.at("density_g_cm3"), *density);
        ++known;
    }
    EXPECT_GT(known, 20);
}

TEST(ViewerEngine, CutsWithOtherProportions) {
    Opened page(stone_of("round-brilliant", "diamond"), k_jeweller);
    const Json cut = page.call("cut", {{"kind", "round-brilliant"}, {"values", {{"table", 65.0}}}});
    EXPECT_EQ(cut.at("summary").at("role"), "design");
    page.call("draw", of_size(70));
    Stone expected = stone_of("round-brilliant", "diamond");
    expected.solid = make_cut("round-brilliant", {{"table", 65.0}});
    EXPECT_EQ(page.engine.pixels(), rendered(expected, k_jeweller, {"camera.size=[70,70]"}));
    EXPECT_NE(page.refusal("cut", {{"kind", "round-brilliant"}, {"values", {{"table", 650.0}}}}),
              "none");
    page.call("set", {{"stone", 0}, {"settings", Json::array()}});
}

// The page calls nothing unknown to the engine, and docs/viewer.md lists all calls in order.
// `start` is the worker's own.
TEST(ViewerEngine, HasTheCallsOfThePageAndOfItsDocumentation) {
    const auto names_in = [](const std::filesystem::path& file, const char* pattern) {
        const std::string text = read_text(std::filesystem::path(CULET_SOURCE_DIR) / file);
        const std::regex call(pattern);
        std::vector<std::string> names;
        for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at) {
            if ((*at)[1] != "start") names.push_back((*at)[1]);
        }
        return names;
    };
    const auto known = ViewerEngine::calls();
    const std::vector<std::string> all(known.begin(), known.end());
    EXPECT_EQ(names_in("docs/viewer.md", R"(\n\| `([a-z]+)` \| )"), all);
    std::size_t asked = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(CULET_SOURCE_DIR) / "viewer/page")) {
        if (entry.path().extension() != ".js") continue;
        for (const std::string& name : names_in(entry.path(), R"re(\.call\("([a-z]+)")re")) {
            EXPECT_NE(std::find(all.begin(), all.end(), name), all.end())
                << entry.path() << " asks " << name;
            ++asked;
        }
    }
    EXPECT_GT(asked, 5u);
}

TEST(ViewerEngine, SaysWhatIsWrongInOneLine) {
    Opened page(stone_of("round-brilliant", "diamond"), k_jeweller);
    page.call("draw", of_size(40));
    const std::vector<std::uint8_t> before = page.engine.pixels();
    EXPECT_NE(page.refusal("set", {{"settings", {"material=\"unobtainium\""}}}), "none");
    EXPECT_NE(page.refusal("set", {{"settings", {"render.nonsense=1"}}}), "none");
    EXPECT_NE(page.refusal("draw", of_size(0)), "none");
    EXPECT_NE(page.refusal("draw", Json::object()), "none");
    EXPECT_NE(page.refusal("juggle", Json::object()), "none");
    EXPECT_NE(page.refusal("set", {{"stone", 7}}), "none");
    for (const char* name :
         {"x.obj", "x.asc", "x.gem", "x.stl", "x.ply", "x.off", "x.glb", "x.toml"})
        EXPECT_TRUE(page.refusal("stone", {{"name", name}}, "v 1 2\n").starts_with(name)) << name;
    EXPECT_EQ(page.refusal("set", {{"settings", {"light.environment=\"/etc/passwd\""}}}).find('\n'),
              std::string::npos);
    page.call("draw", of_size(40));
    EXPECT_EQ(page.engine.pixels(), before);
    const Json set = page.call("set", {{"settings", {"immersion=3"}}});
    EXPECT_NE(set.at("refused").get<std::string>().find("denser"), std::string::npos);
    EXPECT_NE(page.refusal("draw", of_size(40)).find("denser"), std::string::npos);
}

TEST(ViewDocument, KeepsEveryMaterialToTheLastDigit) {
    for (const std::string& name : catalogue_names()) {
        Stone stone = stone_of("round-brilliant", name);
        stone.crystal.axes = {Vec3{0.6, 0, 0.8}, Vec3{0.8, 0, -0.6}, Vec3{0, 1, 0}};
        const ViewItem item = read_view_item(document_json(document_of(stone, k_jeweller)), 0);
        const Stone& read = item.stones.at(0).stone;
        ASSERT_EQ(read.solid.vertices, stone.solid.vertices);
        EXPECT_EQ(read.crystal.axes, stone.crystal.axes);
        for (int ray = 0; ray < ray_count(stone.material.optic); ++ray) {
            const auto r = static_cast<std::size_t>(ray);
            for (double nm = 370; nm < 800; nm += 7.3) {
                EXPECT_EQ(read.material.index[r].at(nm), stone.material.index[r].at(nm));
                EXPECT_EQ(read.material.absorption_per_mm[r].at(nm),
                          stone.material.absorption_per_mm[r].at(nm));
            }
        }
    }
}

TEST(ViewDocument, RefusesWhatIsNone) {
    EXPECT_THROW(read_view_item("", 0), InputError);
    EXPECT_THROW(read_view_item("{}", 0), InputError);
    EXPECT_THROW(read_view_item("{\"schema\":\"culet-view-1\",\"items\":[]}", 0), InputError);
    const std::string good = document_json(document_of(stone_of("step", "diamond"), k_jeweller));
    EXPECT_THROW(read_view_item(good, 1), InputError);
    EXPECT_THROW(read_view_item(good.substr(0, good.size() / 2), 0), InputError);
}

}  // namespace
}  // namespace culet
