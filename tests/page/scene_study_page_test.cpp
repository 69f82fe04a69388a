#include "page/scene_study_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "tests/page/kept_pages.h"
#include "tests/page/xml.h"

namespace culet {
namespace {

using test::xml_fault;
using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json scene_study() {
    return nlohmann::json::parse(R"({"schema": 1, "kind": "scene", "name": "Stone & <co>",
        "usable": true, "size": [64, 48], "scene_size": [640, 480],
        "reference": {"samples": 7, "rough_samples": 99, "wavelengths": 57, "cpu_seconds": 12,
          "ended": "enough", "error_bound": 0.0002, "noise": {"error": 0.002, "rmse": 0.004},
          "effects": [{"name": "dispersion", "on": true, "why": "index changes"}]},
        "settings": [
          {"id": 0, "sweep": "automatic", "setting": "tolerance 0.01", "automatic": true,
           "words": "beams, 8 wavelengths", "engine": "beams", "tolerance": 0.01, "error": 0.008,
           "claimed_error": 0.008, "at_noise": false, "rmse": 0.02, "psnr": 40, "runs": 5,
           "deltaE00_mean": 0.5, "deltaE00_p95": 2, "flip_mean": 0.01, "cpu_seconds": 0.13,
           "cpu_least": 0.12, "cpu_most": 0.15, "wall_seconds": 0.1, "front": false,
           "effects": [{"name": "dispersion", "on": true}, {"name": "absorption", "on": false}],
           "plan": {"engine": "beams", "engine_why": "quicker", "items": [{"name": "depth",
             "on": true, "fidelity": "8 faces", "why": "<enough>", "error_bound": 0.001}]}},
          {"id": 1, "sweep": "search", "setting": "x", "words": "preview, 3 wavelengths",
           "engine": "preview", "claimed_error": 0.009, "cpu_seconds": 0.12, "front": true},
          {"id": 2, "sweep": "samples", "setting": "64", "words": "reference, 64 rays a pixel",
           "engine": "reference", "claimed_error": 0.002, "at_noise": true, "cpu_seconds": 9,
           "front": true}],
        "front": [1, 2],
        "recommendations": [{"tolerance": 0.01, "cheapest": 1, "automatic": 0,
          "automatic_meets": true, "automatic_over_cheapest": 1.083,
          "words": "for tolerance 0.01 take preview"}],
        "left_out": ["depth 4: took over 9 s"], "notes": [], "options": {"budget": 120}})");
}

TEST(SceneStudyPage, ShowsAdviceFrontAndSettings) {
    const std::string page =
        scene_study_page({scene_study().dump(),
                          "",
                          "1.2",
                          "culet study s",
                          {{-1, "data:,r", "", 0}, {1, "data:,p", "data:,d", 0.3}}});
    EXPECT_THAT(page, HasSubstr("<h1>Stone &amp; &lt;co&gt;</h1>"));
    test::keep_page("scene-study", scene_study_page({scene_study().dump(),
                                                     test::hostile_name(),
                                                     "1.2",
                                                     test::hostile_name(),
                                                     {{1, "data:,p", "data:,d", 0.3}}}));
    EXPECT_THAT(page, HasSubstr("64 × 48"));
    EXPECT_THAT(page, HasSubstr("640 × 480"));
    EXPECT_THAT(page, HasSubstr("for tolerance 0.01 take preview"));
    EXPECT_THAT(page, HasSubstr("1.08×"));
    EXPECT_THAT(page, HasSubstr("src=\"data:,d\""));
    EXPECT_THAT(page, HasSubstr("≤ 0.0020"));
    EXPECT_THAT(page, HasSubstr("on: dispersion; off: absorption"));
    EXPECT_THAT(page, HasSubstr("8 faces; &lt;enough&gt;"));
    EXPECT_THAT(page, HasSubstr("depth 4: took over 9 s"));
    EXPECT_THAT(page, HasSubstr("culet study s"));
    EXPECT_EQ(xml_fault(scene_study_chart(scene_study().dump())), "");
}

TEST(SceneStudyPage, ChartHasEnginesFrontAndNoise) {
    const std::string svg = scene_study_chart(scene_study().dump());
    for (const char* name : {">front<", ">preview<", ">reference<", ">automatic<", ">noise<"})
        EXPECT_THAT(svg, HasSubstr(name));
    EXPECT_THAT(svg, Not(HasSubstr(">beams<"))) << "none but the automatic one";
}

TEST(SceneStudyPage, WritesAPlainTable) {
    const std::string text = scene_study_table(scene_study().dump());
    EXPECT_THAT(text, HasSubstr("preview, 3 wavelengths"));
    EXPECT_THAT(text, HasSubstr("<=0.0020"));
    for (const char c : text) EXPECT_GT(c, 0) << text;  // ASCII only
}

TEST(SceneStudyPage, SurvivesJsonOfUnexpectedShape) {
    const char* odd =
        R"({"settings": [1, {"engine": 3, "cpu_seconds": "x"}, null], "front": [[], 7],
                          "size": [1], "scene_size": {"a": 1}, "recommendations": [3, {}],
                          "reference": [], "left_out": [4], "notes": 1, "name": []})";
    EXPECT_NO_THROW(scene_study_page({odd}));
    EXPECT_NO_THROW(scene_study_table(odd));
    EXPECT_EQ(scene_study_chart("{}"), "");
    EXPECT_THROW(scene_study_page({"{"}), InputError);
}

}  // namespace
}  // namespace culet
