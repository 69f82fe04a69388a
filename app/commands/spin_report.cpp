#include "app/commands/spin_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/input/cut_symmetry.h"
#include "page/html.h"
#include "page/spin_page.h"
#include "render/image/codecs/codecs.h"
#include "stone/numbers/units.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_drawn = 64;

struct Words {
    const char *name, *words, *unit;
    int decimals;
};
constexpr Words k_words[] = {{"width", "width", "", 3},
                             {"length_to_width", "length to width", "", 3},
                             {"table_pct", "table", " %", 1},
                             {"depth_pct", "depth", " %", 1},
                             {"crown_height_pct", "crown height", " %", 1},
                             {"girdle_pct", "girdle", " %", 1},
                             {"pavilion_depth_pct", "pavilion depth", " %", 1},
                             {"crown_angle_deg", "crown angle", "\u00b0", 1},
                             {"pavilion_angle_deg", "pavilion angle", "\u00b0", 1}};

std::vector<SpinPage::Row> rows_of(const SpinResult& found, double width_mm) {
    std::vector<SpinPage::Row> rows;
    for (const Words& words : k_words) {
        const SpinProportion* p = proportion(found.proportions, words.name);
        if (!p) continue;
        const bool is_width = p == &found.proportions.front();
        const double scale = is_width && width_mm > 0 ? width_mm / p->value : 1;
        const std::string unit = !is_width ? words.unit : width_mm > 0 ? " mm" : " px";
        const auto shown = [&](double value) {
            return decimals(value * scale, is_width && width_mm == 0 ? 1 : words.decimals) + unit;
        };
        SpinPage::Row row{words.words, shown(p->value), shown(p->sigma), "", p->read};
        for (const auto& [name, difference] : found.halves.proportions) {
            if (name == p->name) row.halves = shown(std::abs(difference));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<std::string> facts_of(const SpinResult& found) {
    const auto used = std::count_if(found.frames.begin(), found.frames.end(),
                                    [](const SpinFrameResult& f) { return f.used; });
    std::vector<std::string> facts{
        fmt::format("{} frames were used; the camera stands {:.2f} degrees above the turntable.",
                    used, degrees(found.camera.elevation)),
        fmt::format("The edges in the pictures lie about the stone's outlines within {:.2f} px.",
                    found.scatter_px),
        fmt::format("Halves of the frames tell {} facets of 2 mm\u00b2 and more (if the stone were "
                    "7 mm wide) within {:.2f} degrees (median), and {} of 0.25 mm\u00b2 and more "
                    "within {:.2f}.",
                    found.halves.large_facets.count, degrees(found.halves.large_facets.tilt),
                    found.halves.facets.count, degrees(found.halves.facets.tilt))};
    if (found.edges == 0)
        facts.emplace_back(
            "No edges of a table were found: nothing shows the planes that close the stone above.");
    std::vector<std::string> unseen;
    for (const int f : found.unseen) {
        if (std::count(found.copies.begin(), found.copies.end(), f) == 0)
            unseen.push_back(found.solid.facets[std::size_t(f)].name);
    }
    if (found.symmetry)
        facts.push_back(fmt::format(
            "Facets repeat {}: {} are alike within {:.2f} degrees. No frame shows {} of the "
            "facets: they are copies from where the stone repeats them.",
            words_of(found.tried), found.symmetry->pairs, degrees(found.symmetry->tilt_sigma),
            found.copies.size()));
    if (!unseen.empty())
        facts.push_back(
            fmt::format("The tilt of these facets is a guess: {}.", fmt::join(unseen, ", ")));
    return facts;
}

// The file as it is, if browsers know its format.
std::string uri_of(const SpinFrame& frame) {
    std::string uri = picture_uri(read_text(frame.name));
    if (!uri.empty()) return uri;
    const LevelPicture& picture = frame.picture;
    return png_uri(encode_png(picture.width, picture.height, 3, picture.rgb));
}

}  // namespace

void write_spin_report(const fs::path& folder, const std::vector<SpinFrame>& frames,
                       const SpinResult& found, const SeriesLight& light, double width_mm) {
    SpinPage page;
    page.version = CULET_VERSION;
    page.title = "A stone from its photographs";
    if (!found.trouble.empty()) page.verdict = found.trouble + ". " + found.remedy + ".";
    page.solid = found.solid;
    page.seen.assign(found.solid.facets.size(), true);
    for (const int f : found.unseen) page.seen[std::size_t(f)] = false;
    page.width = frames.front().picture.width;
    page.height = frames.front().picture.height;
    const std::size_t every = (frames.size() + k_most_drawn - 1) / k_most_drawn;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const SpinFrameResult& frame = found.frames[f];
        if (!frame.turn || (f % every != 0 && !frames[f].held_out)) continue;
        page.frames.push_back({fs::path(frames[f].name).filename().string(), uri_of(frames[f]),
                               frames[f].held_out, frame.median_px, frame.projection});
    }
    page.proportions = rows_of(found, width_mm);
    page.facts = facts_of(found);
    if (!light.beside.empty()) page.beside_uri = png_uri(light.beside);
    if (!light.verdict.empty()) page.facts.push_back(as_sentence(light.verdict));
    fs::create_directories(folder);
    write_text(folder / "report.html", spin_page(page));
}

}  // namespace culet
