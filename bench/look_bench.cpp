// How far default pictures of stones look like photographs: bench_look [FOLDER]
//
// Five statistics of the middle 85 % of a stone, in sRGB values of 0 to 1 at 400 x 400 pixels, and
// their ranges over ten photographs by a dealer (brilliants and step cuts in diamond, front light,
// white surround): root mean square contrast 0.25 to 0.34, darker than 0.2: 10 to 23 %, brighter
// than 0.9: 10 to 29 %, colourfulness (Hasler & Suesstrunk 2003, "Measuring colourfulness in
// natural images") 0.03 to 0.06, mean horizontal step of the luminance 0.037 to 0.050. The ranges
// are for colourless stones. With a folder, the pictures are written there.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>

#include "bench/bench_table.h"
#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/shown_picture.h"
#include "render/scene/stone_scene.h"
#include "stone/cuts/cuts.h"

namespace culet {
namespace {

struct Shown {
    const char* name;
    const char* cut;
    std::map<std::string, double> values;
    const char* material;
};

const std::map<std::string, double> k_round{{"girdle-segments", 6}};

const std::vector<Shown> k_diamonds{
    {"round brilliant", "round-brilliant", k_round, "diamond"},
    {"shallow brilliant",
     "round-brilliant",
     {{"crown-angle", 32}, {"pavilion-angle", 40.2}, {"girdle-segments", 6}},
     "diamond"},
    {"steep brilliant",
     "round-brilliant",
     {{"crown-angle", 36}, {"pavilion-angle", 41.4}, {"girdle-segments", 6}},
     "diamond"},
    {"oval", "oval", k_round, "diamond"},
    {"emerald", "step", {}, "diamond"},
    {"square step", "step", {{"ratio", 1}}, "diamond"},
    {"princess", "princess", {}, "diamond"},
    {"cushion", "cushion", {}, "diamond"},
    {"marquise", "marquise", {}, "diamond"},
    {"pear", "pear", {}, "diamond"},
    {"trillion", "trillion", {}, "diamond"},
    {"heart", "heart", {}, "diamond"}};

const std::vector<Shown> k_coloured{
    {"ruby oval", "oval", k_round, "ruby_gem"},
    {"blue sapphire cushion", "cushion", {}, "sapphire_blue"},
    {"emerald, step cut", "step", {}, "emerald"},
    {"peridot pear", "pear", {}, "peridot"},
    {"rhodolite brilliant", "round-brilliant", k_round, "garnet_rhodolite"},
    {"almandine trillion", "trillion", {}, "garnet_almandine"}};

struct Statistic {
    const char* name;
    double least, most;
};
constexpr std::array<Statistic, 5> k_statistics{{{"contrast", 0.25, 0.34},
                                                 {"dark", 0.10, 0.23},
                                                 {"bright", 0.10, 0.29},
                                                 {"colour", 0.03, 0.06},
                                                 {"edges", 0.037, 0.050}}};

// Mean and variance.
struct Moments {
    double count = 0, sum = 0, squares = 0;
    void add(double v) { ++count, sum += v, squares += v * v; }
    double mean() const { return sum / count; }
    double variance() const { return squares / count - mean() * mean(); }
};

// Pixels of the ellipse that spans 85 % of the stone's bounding box.
class Middle {
public:
    explicit Middle(const Picture& picture) : width_(picture.width) {
        for (std::size_t p = 0; p < picture.pixels(); ++p) {
            if (picture.coverage[p] < 0.5f) continue;
            const int x = static_cast<int>(p) % width_, y = static_cast<int>(p) / width_;
            left_ = std::min(left_, x), right_ = std::max(right_, x);
            top_ = std::min(top_, y), bottom_ = std::max(bottom_, y);
        }
    }
    bool holds(int x, int y) const {
        const double u = (2.0 * x - left_ - right_) / (0.85 * (right_ - left_)),
                     v = (2.0 * y - top_ - bottom_) / (0.85 * (bottom_ - top_));
        return u * u + v * v <= 1;
    }

private:
    int width_, left_ = 1 << 20, right_ = 0, top_ = 1 << 20, bottom_ = 0;
};

std::array<double, 5> statistics_of(const Picture& picture, const PngLook& look) {
    const std::vector<float> rgb = as_shown(picture, look);
    const auto colour = [&](int x, int y) {
        const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
        return Rgb{srgb_encoded(rgb[at]), srgb_encoded(rgb[at + 1]), srgb_encoded(rgb[at + 2])};
    };
    const Middle middle(picture);
    Moments light, red_green, yellow_blue, steps;
    double dark = 0, bright = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 1; x < picture.width; ++x) {
            if (!middle.holds(x, y)) continue;
            const Rgb c = colour(x, y);
            const double l = luminance(c);
            light.add(l);
            dark += l < 0.2;
            bright += l > 0.9;
            red_green.add(c[0] - c[1]);
            yellow_blue.add((c[0] + c[1]) / 2 - c[2]);
            if (middle.holds(x - 1, y)) steps.add(std::abs(l - luminance(colour(x - 1, y))));
        }
    }
    const double colourfulness = std::sqrt(red_green.variance() + yellow_blue.variance()) +
                                 0.3 * std::hypot(red_green.mean(), yellow_blue.mean());
    return {std::sqrt(light.variance()), dark / light.count, bright / light.count, colourfulness,
            steps.mean()};
}

// Returns how many statistics lie within the photographs' ranges.
int show(const Shown& shown, const std::filesystem::path& folder, BenchTables& tables) {
    Stone stone;
    stone.name = shown.name;
    stone.solid = make_cut(shown.cut, shown.values);
    stone.convex = cut_kind(shown.cut).convex;
    StoneScene choices;
    choices.material = shown.material;
    Scene scene = scene_around(stone, {"camera.size=[400,400]"}, choices);
    allow_usual_time(scene);
    const auto start = std::chrono::steady_clock::now();
    const RenderResult result = render(scene);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const PngLook look = look_for(scene, result.picture);
    if (!folder.empty())
        write_picture(result.picture, folder / (std::string(shown.name) + ".png"), look);
    const std::array<double, 5> found = statistics_of(result.picture, look);
    int within = 0;
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool in = found[i] >= k_statistics[i].least && found[i] <= k_statistics[i].most;
        within += in;
        cells.push_back(fmt::format("{:.3f}{}", found[i], in ? "" : " *"));
    }
    cells.push_back(fmt::format("{:.1f}", took.count()));
    tables.line(shown.name, cells);
    return within;
}

void run(const std::filesystem::path& folder) {
    BenchTables tables;
    std::vector<std::string> columns;
    for (const Statistic& s : k_statistics)
        columns.push_back(fmt::format("{} {:g}-{:g}", s.name, s.least, s.most));
    columns.emplace_back("seconds");
    tables.section("diamonds", "* outside of the photographs' range", columns);
    int whole = 0, in_range = 0;
    for (const Shown& shown : k_diamonds) {
        const int within = show(shown, folder, tables);
        in_range += within;
        whole += within == static_cast<int>(k_statistics.size());
    }
    tables.remark(fmt::format("{} of {} cuts within all ranges; {} of {} statistics", whole,
                              k_diamonds.size(), in_range, 5 * k_diamonds.size()));
    tables.section("coloured stones", "", columns);
    for (const Shown& shown : k_coloured) show(shown, folder, tables);
}

}  // namespace
}  // namespace culet

int main(int argc, char** argv) {
    culet::run(argc > 1 ? argv[1] : "");
    return 0;
}
