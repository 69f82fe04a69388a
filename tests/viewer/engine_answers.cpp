// The native engine's answers for wasm_engine_test.js: one JSON object on stdout.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "page/html.h"
#include "stone/cuts/cuts.h"
#include "viewer/engine/viewer_document.h"
#include "viewer/engine/viewer_engine.h"

int main() {
    using namespace culet;
    using Json = nlohmann::ordered_json;
    struct Case {
        const char *cut, *material, *settings;
    };
    const Case cases[] = {
        {"round-brilliant", "diamond",
         R"(["light={preset=\"jeweller\"}", "render.wavelengths=[589.3]", "render.depth=8"])"},
        {"round-brilliant", "diamond",
         R"(["light={preset=\"jeweller\"}", "render.tolerance=0.2", "render.wavelengths=[450,540,610]"])"},
        {"step", "tourmaline_dravite",
         R"(["light={preset=\"daylight\"}", "film.tonemap=\"filmic\"", "render.depth=6", "render.tolerance=0.2", "render.wavelengths=[450,540,610]"])"},
        {"oval", "sapphire_blue",
         R"(["light={preset=\"lightbox\"}", "optic_axis=[1,0,0.2]", "render.tolerance=0.2", "render.wavelengths=[450,540,610]"])"},
        {"princess", "peridot",
         R"(["light={preset=\"aset\"}", "immersion=1.33", "render.depth=8", "render.tolerance=0.2", "render.wavelengths=[450,540,610]"])"},
        {"round-brilliant", "zircon_high",
         R"(["preset=\"polariscope\"", "render.tolerance=0.2", "render.wavelengths=[450,540,610]"])"},
    };
    Json all = Json::array();
    for (const Case& one : cases) {
        ViewDocument document;
        document.title = one.cut;
        document.items.emplace_back();
        ViewItem& item = document.items.back();
        item.name = one.cut;
        item.scene = "light = { preset = \"jeweller\" }\n";
        item.stones.emplace_back();
        Stone& stone = item.stones.back().stone;
        stone.name = one.cut;
        stone.solid = make_cut(one.cut);
        stone.material = catalogue_material(one.material);
        ViewerEngine engine("test");
        const std::string text = document_json(document);
        engine.answer("open", "{}", text);
        const Json set{{"settings", Json::parse(one.settings)}};
        engine.answer("set", set.dump());
        for (const char* kind : {"beams", "preview"}) {
            const Json draw{{"width", 200},
                            {"height", 160},
                            {"engine", kind},
                            {"turn", {1, 0, 0, 0, 0.6, -0.8, 0, 0.8, 0.6}},
                            {"camera",
                             {{"position", {6, -12, 30}},
                              {"look_at", {0, 0, -0.5}},
                              {"up", {0, 1, 0}},
                              {"width", 9}}}};
            const Json answer = Json::parse(engine.answer("draw", draw.dump()));
            const auto& pixels = engine.pixels();
            all.push_back(
                {{"what", fmt::format("{} {} {} {}", one.cut, one.material, one.settings, kind)},
                 {"document", Json::parse(text)},
                 {"set", set},
                 {"draw", draw},
                 {"answer", answer},
                 {"pixels",
                  base64({reinterpret_cast<const char*>(pixels.data()), pixels.size()})}});
        }
    }
    fmt::print("{}\n", all.dump());
    return 0;
}
