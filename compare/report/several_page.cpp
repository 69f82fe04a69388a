#include "compare/report/several_page.h"

#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

std::string degrees_of(const EquivalentError& error) {
    return error.deg ? significant(error.deg, 2) + "°" : std::string("–");
}

std::string score_cell(const Comparison& comparison, const char* key, int places) {
    for (const Score& score : comparison.scores) {
        if (score.key == key) return decimals(score.value, places);
    }
    return "–";
}

}  // namespace

std::string several_page(const SeveralPhotographs& several, const std::vector<PhotographRow>& rows,
                         const std::string& title, const std::string& version,
                         const std::string& command) {
    const VerdictShown shown = verdict_shown(several.verdict);
    std::vector<View> cells;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Comparison& c = rows[i].comparison;
        const EquivalentError* error = equivalent_of(rows[i]);
        const Photo& photo = c.pictures.photo;
        cells.push_back({{"uri", photo.rgb.empty() ? "" : picture_uri(photo, c.pictures.white)},
                         {"page", rows[i].page},
                         {"name", rows[i].name},
                         {"trouble", c.usable() ? "" : c.reason},
                         {"verdict", verdict_shown(c.verdict).word},
                         {"error", error != nullptr ? degrees_of(*error) : "–"},
                         {"zncc", score_cell(c, "zncc", 3)},
                         {"colour", score_cell(c, "deltaE00_mean", 1)},
                         {"matched", std::to_string(c.reflexes.matched)},
                         {"in_photo", std::to_string(c.reflexes.in_photo)},
                         {"others", degrees_of(several.without[i])}});
    }
    const std::string body = filled(
        templates::photographs, {{"title", title},
                                 {"verdict_html", verdict_card(shown.style, shown.symbol,
                                                               shown.word, several.reason + ".")},
                                 {"tall", is_tall(cells)},
                                 {"rows", cells},
                                 {"version", version},
                                 {"command", command}});
    return html_page(title, body, several_json(several, rows));
}

}  // namespace culet
