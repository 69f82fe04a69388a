#pragma once
// The pictures that measure the viewer's speed: a round brilliant of 73 facets in diamond, 800 x
// 800, depth 8, from views a degree apart.

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stone/cuts/cuts.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

struct ViewerBenchCase {
    std::string name, document, set;
    std::function<std::string(int)> draw;  ///< arguments of the n-th picture
};

inline std::vector<ViewerBenchCase> viewer_bench_cases() {
    using Json = nlohmann::ordered_json;
    ViewDocument document;
    document.title = "bench";
    document.items.emplace_back();
    ViewItem& item = document.items.back();
    item.name = "bench";
    item.scene = "light = { preset = \"jeweller\" }\n";
    item.stones.emplace_back();
    Stone& stone = item.stones.back().stone;
    stone.name = "brilliant";
    stone.solid = make_cut("round-brilliant");
    stone.material = catalogue_material("diamond");
    const std::string text = document_json(document);
    const auto view = [](const char* engine, bool lights_turn) {
        return [engine, lights_turn](int n) {
            const double angle = 0.0174532925199433 * n;
            const double c = std::cos(angle), s = std::sin(angle);
            Json draw{{"width", 800},
                      {"height", 800},
                      {"engine", engine},
                      {"camera",
                       {{"position", {30 * s, 3, 30 * c}},
                        {"look_at", {0, 0, -0.5}},
                        {"up", {0, 1, 0}},
                        {"fov_deg", 14}}}};
            if (lights_turn) draw["turn"] = {c, 0, s, 0, 1, 0, -s, 0, c};
            return draw.dump();
        };
    };
    const std::string one = R"({"settings": ["render.wavelengths=[589.3]", "render.depth=8"]})",
                      three =
                          R"({"settings": ["render.wavelengths=[465,545,610]", "render.depth=8"]})",
                      open = R"({"settings": ["render.depth=8"]})";
    return {{"one wavelength", text, one, view("beams", false)},
            {"three wavelengths", text, three, view("beams", false)},
            {"all that the scene calls for", text, open, view("beams", false)},
            {"preview", text, one, view("preview", false)},
            {"preview, all wavelengths, lights turning", text, open, view("preview", true)}};
}

}  // namespace culet
