#include "tests/hard/stability_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "page/chart.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/study_sections.h"
#include "tests/hard/templates.h"

namespace culet::hard {

namespace {

using Json = nlohmann::ordered_json;

// Zero errors are drawn here, below one rounding unit.
constexpr double k_floor = 1e-17;

// The worst point of an invariant over a case's sweep.
struct Worst {
    double error = 0, limit = 0, condition = std::nan("");
    double margin = std::numeric_limits<double>::infinity();  // limit over error, the smallest
    std::string at;
    int points = 0, failed = 0;
};

std::map<std::string, Worst> worst_of(const Json& result) {
    std::map<std::string, Worst> all;
    for (const Json& point : array_at(result, "points")) {
        if (!point.contains("invariants")) continue;
        for (const auto& [name, value] : point["invariants"].items()) {
            Worst& w = all[name];
            const double error = number_at(value, "error").value_or(1e300);
            const double limit = number_at(value, "limit").value_or(0);
            const double condition = number_at(value, "condition").value_or(std::nan(""));
            const bool holds = true_at(value, "holds");
            const double margin =
                error > 0 ? limit / error : std::numeric_limits<double>::infinity();
            ++w.points;
            w.failed += !holds;
            if (!(w.condition >= condition)) w.condition = condition;
            if (w.points > 1 && !(margin < w.margin)) continue;
            w.margin = margin;
            w.error = error;
            w.limit = limit;
            w.at = text_at(point, "label");
        }
    }
    return all;
}

std::string title_of(const std::string& section) {
    std::string title = section;
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
    return title;
}

std::string plain(const std::string& name) {
    std::string text = name;
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

std::string margin_words(const Worst& w) {
    if (w.limit == 0) return w.failed == 0 ? "exact" : "–";
    if (!std::isfinite(w.margin)) return "exact";
    return fmt::format("× {}", significant(w.margin, 2));
}

struct Place {
    double x;
    std::string label;  // for axes of words
};

// A point's place on the axis; on a logarithmic axis 0 is a decade to the left of the smallest, and
// points go by their magnitude.
Place place_of(const Json& point, const Json& result) {
    const double x = number_at(point, "x").value_or(std::nan(""));
    if (!true_at(result, "log_x")) return {x, ""};
    if (x != 0) return {std::abs(x), ""};
    double least = 1e300;
    for (const Json& other : array_at(result, "points")) {
        const double size = std::abs(number_at(other, "x").value_or(0));
        if (size > 0) least = std::min(least, size);
    }
    return {least / 10, "0"};
}

ChartPoint point_at(const Place& place, double error, const std::string& about) {
    ChartPoint p;
    p.x = place.x;
    p.y = std::max(error, k_floor);
    p.hollow = !(error > 0);
    p.about = about;
    return p;
}

// One chart: an invariant with its limit and the textbook's methods, or several invariants
// together.
std::string chart_of(const Json& result, const std::vector<std::string>& invariants,
                     const std::string& title, bool with_contrasts) {
    Chart chart;
    chart.title = title;
    chart.about = title + ", against " + text_at(result, "x_label");
    chart.x_label = text_at(result, "x_label");
    chart.y_label = invariants.size() == 1 ? plain(invariants.front()) + ", error" : "error";
    chart.log_x = true_at(result, "log_x");
    std::map<std::string, ChartSeries> contrasts;
    for (const std::string& name : invariants) {
        ChartSeries found, limit;
        found.name = with_contrasts ? "culet" : plain(name);
        limit.name = "allowed";
        limit.dashed = true;
        limit.markers = false;
        for (const Json& point : array_at(result, "points")) {
            const Place place = place_of(point, result);
            if (!point.contains("invariants") || !point["invariants"].contains(name)) continue;
            const Json& value = point["invariants"][name];
            const double error = number_at(value, "error").value_or(1e300);
            found.points.push_back(
                point_at(place, error,
                         fmt::format("{} at {}: {}", plain(name), text_at(point, "label"),
                                     significant(error, 2))));
            if (found.points.back().hollow || !place.label.empty()) {
                found.points.back().label = place.label;
            }
            limit.points.push_back(
                point_at(place, number_at(value, "limit").value_or(0), "allowed"));
            for (const Json& contrast : array_at(point, "contrasts")) {
                if (!with_contrasts || text_at(contrast, "invariant") != name) continue;
                const std::string way = text_at(contrast, "name");
                ChartSeries& series = contrasts[way];
                series.name = way;
                const auto off = number_at(contrast, "error");
                if (!off) continue;
                series.points.push_back(
                    point_at(place, *off,
                             fmt::format("{} at {}: {}", way, text_at(point, "label"),
                                         significant(off, 2))));
            }
        }
        chart.series.push_back(std::move(found));
        if (with_contrasts) chart.series.push_back(std::move(limit));
    }
    for (auto& [way, series] : contrasts) chart.series.push_back(std::move(series));
    return chart_figure(draw_chart_svg(chart));
}

std::string charts_of(const Json& result) {
    const Json& points = array_at(result, "points");
    if (points.size() < 2 || !number_at(points[0], "x")) return {};
    std::vector<std::string> contrasted, others;
    for (const Json& point : points) {
        for (const Json& contrast : array_at(point, "contrasts")) {
            const std::string name = text_at(contrast, "invariant");
            const bool measured =
                point.contains("invariants") && point["invariants"].contains(name);
            if (measured &&
                std::find(contrasted.begin(), contrasted.end(), name) == contrasted.end()) {
                contrasted.push_back(name);
            }
        }
    }
    std::string text;
    for (const std::string& name : contrasted) {
        text += chart_of(result, {name}, "Beside the textbook: " + plain(name), true);
    }
    // Counts that must be 0 have no curve.
    for (const auto& [name, w] : worst_of(result)) {
        if (w.limit > 0 &&
            std::find(contrasted.begin(), contrasted.end(), name) == contrasted.end()) {
            others.push_back(name);
        }
    }
    // As many series as a reader, and the palette, can distinguish.
    constexpr std::size_t k_most = 6;
    for (std::size_t first = 0; first < others.size(); first += k_most) {
        const std::vector<std::string> some(
            others.begin() + static_cast<std::ptrdiff_t>(first),
            others.begin() + static_cast<std::ptrdiff_t>(std::min(first + k_most, others.size())));
        text += chart_of(result, some, "Error against difficulty", false);
    }
    return text;
}

std::vector<View> rows_of(const Json& result) {
    std::vector<View> rows;
    for (const auto& [name, w] : worst_of(result)) {
        rows.push_back(
            {{"invariant", plain(name)},
             {"holds", w.failed == 0},
             {"error", significant(w.error, 2)},
             {"allowed", w.limit == 0 ? "0" : significant(w.limit, 2)},
             {"margin", margin_words(w)},
             {"at", w.at},
             {"condition", std::isfinite(w.condition) ? significant(w.condition, 2) : ""}});
    }
    return rows;
}

std::string id_of(const HardCase& one) {
    return one.section + "-" + one.name;
}

struct Tally {
    int cases = 0, run = 0, checks = 0, failed = 0;
};

std::vector<View> overview(const std::vector<HardCase>& corpus, const std::vector<Json>& results,
                           Tally& tally) {
    std::vector<View> rows;
    for (std::size_t i = 0; i < corpus.size(); ++i) {
        const HardCase& one = corpus[i];
        ++tally.cases;
        const bool run = !results[i].is_null();
        tally.run += run;
        Worst narrowest;
        std::string of;
        int failed = 0;
        if (run) {
            for (const auto& [name, w] : worst_of(results[i])) {
                tally.checks += w.points;
                failed += w.failed;
                if (w.limit > 0 && w.margin < narrowest.margin) {
                    narrowest = w;
                    of = name;
                }
            }
            // A point that could not be computed has no invariants.
            for (const Json& p : array_at(results[i], "points"))
                failed += !p.contains("invariants");
        }
        tally.failed += failed;
        rows.push_back({{"section", one.section},
                        {"id", id_of(one)},
                        {"title", one.title},
                        {"run", run},
                        {"holds", failed == 0},
                        {"points", std::to_string(one.points.size())},
                        {"margin", of.empty() ? (run ? "exact" : "") : margin_words(narrowest)},
                        {"of", of.empty() ? "" : plain(of) + " at " + narrowest.at}});
    }
    return rows;
}

std::vector<View> highlights_of(const std::vector<HardCase>& corpus,
                                const std::vector<Json>& results) {
    std::vector<View> highlights;
    for (std::size_t i = 0; i < corpus.size(); ++i) {
        const HardCase& one = corpus[i];
        if (one.highlight.empty() || results[i].is_null()) continue;
        highlights.push_back(
            {{"id", id_of(one)},
             {"title", one.title},
             {"chart_html", chart_of(results[i], {one.highlight}, one.title, true)}});
    }
    return highlights;
}

std::vector<View> sections_of(const std::vector<HardCase>& corpus,
                              const std::vector<Json>& results) {
    std::vector<View> shown;
    for (const std::string& name : sections()) {
        std::vector<View> cases;
        for (std::size_t i = 0; i < corpus.size(); ++i) {
            const HardCase& one = corpus[i];
            if (one.section != name) continue;
            const bool run = !results[i].is_null();
            const std::vector<View> rows = run ? rows_of(results[i]) : std::vector<View>{};
            cases.push_back({{"id", id_of(one)},
                             {"title", one.title},
                             {"why", one.why},
                             {"charts_html", run ? charts_of(results[i]) : ""},
                             {"run", run},
                             {"tall", is_tall(rows)},
                             {"rows", rows}});
        }
        if (cases.empty()) continue;
        shown.push_back({{"name", name}, {"heading", title_of(name)}, {"cases", cases}});
    }
    return shown;
}

}  // namespace

std::string stability_page(const std::vector<HardCase>& corpus,
                           const std::vector<std::string>& results) {
    std::vector<Json> parsed;
    for (const std::string& text : results) {
        parsed.push_back(text.empty() ? Json() : parsed_object<Json>(text, "a result"));
    }
    Tally tally;
    const std::vector<View> rows = overview(corpus, parsed, tally);
    const std::vector<View> highlights = highlights_of(corpus, parsed);
    const bool all_run = tally.run == tally.cases;
    const std::string body =
        filled(templates::stability,
               {{"cases", std::to_string(tally.cases)},
                {"checks", std::to_string(tally.checks)},
                {"not_run", all_run ? "" : std::to_string(tally.cases - tally.run)},
                {"all_hold", all_run && tally.failed == 0},
                {"failed", all_run && tally.failed > 0 ? std::to_string(tally.failed) : ""},
                {"beside", !highlights.empty()},
                {"highlights", highlights},
                {"tall", is_tall(rows)},
                {"rows", rows},
                {"sections", sections_of(corpus, parsed)}});
    return html_page("Hard cases: how stable culet's numbers are", body);
}

std::string verdicts(const std::vector<std::string>& results) {
    std::string lines;
    for (const std::string& text : results) {
        if (text.empty()) continue;
        const Json result = parsed_object<Json>(text, "a result");
        for (const Json& point : array_at(result, "points")) {
            if (!point.contains("invariants")) continue;
            for (const auto& [name, value] : point["invariants"].items()) {
                lines += fmt::format("{}.{} {} {} {}\n", text_at(result, "section"),
                                     text_at(result, "name"), text_at(point, "label"), name,
                                     true_at(value, "holds") ? "holds" : "fails");
            }
        }
    }
    return lines;
}

}  // namespace culet::hard
