// Sections of the report that come from a fit: the stone, its readings, what the fit changed.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "compare/drawing.h"
#include "compare/html.h"
#include "compare/report_parts.h"
#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// Beyond four standard uncertainties everything is as red: such a reading is in doubt anyway.
constexpr double k_worst_shown = 4;

const Json& array_at(const Json& object, const char* key) {
    static const Json none = Json::array();
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : none;
}

bool true_at(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// Names that a reading speaks of: "of" is an array, or one string with `/` between names.
std::vector<std::string> names_of(const Json& reading) {
    std::vector<std::string> names;
    const auto found = reading.find("of");
    if (found == reading.end()) return names;
    if (found->is_array()) {
        for (const Json& name : *found) {
            if (name.is_string()) names.push_back(name.get<std::string>());
        }
    } else if (found->is_string()) {
        std::string all = found->get<std::string>();
        for (std::size_t at = 0; at <= all.size();) {
            const std::size_t end = std::min(all.find('/', at), all.size());
            names.push_back(all.substr(at, end - at));
            at = end + 1;
        }
    }
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& name : names) result += (result.empty() ? "" : " / ") + name;
    return result;
}

/// Does `name` fit `pattern` with `*` for any run of characters; also inside mean(), min(), max().
bool names_facet(std::string pattern, const std::string& name) {
    for (const char* wrapper : {"mean(", "min(", "max("}) {
        if (pattern.starts_with(wrapper) && pattern.ends_with(")")) {
            pattern = pattern.substr(std::string(wrapper).size());
            pattern.pop_back();
        }
    }
    // One star can be handled by going back to it: linear in practice, no recursion.
    std::size_t p = 0, n = 0, star = std::string::npos, back = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            back = n;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++p;
            ++n;
        } else if (star != std::string::npos) {
            p = star + 1;
            n = ++back;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

struct Worst {
    double normalized = 0;
    std::string reading;
    int count = 0;
};

std::vector<Worst> worst_readings(const Json& fit, const std::vector<std::string>& facets) {
    std::vector<Worst> worst(facets.size());
    for (const Json& reading : array_at(fit, "readings")) {
        const auto normalized = number_at(reading, "normalized");
        if (!normalized) continue;
        const auto names = names_of(reading);
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const bool speaks = std::any_of(names.begin(), names.end(), [&](const auto& name) {
                return names_facet(name, facets[f]);
            });
            if (!speaks) continue;
            ++worst[f].count;
            if (worst[f].reading.empty() || std::abs(*normalized) > std::abs(worst[f].normalized)) {
                worst[f].normalized = *normalized;
                worst[f].reading = text_at(reading, "id");
            }
        }
    }
    return worst;
}

const Json* facet_in(const Json& fit, const std::string& name) {
    for (const Json& facet : array_at(fit, "facets")) {
        if (text_at(facet, "name") == name) return &facet;
    }
    return nullptr;
}

std::string both_views(const Solid& solid, const std::vector<FacetPaint>& paint) {
    std::string views;
    for (const auto& [side, name] :
         {std::pair(ViewSide::crown, "Crown, from above"),
          std::pair(ViewSide::pavilion, "Pavilion, turned over about the vertical")}) {
        const std::string svg = draw_facets_svg(solid, side, paint);
        if (svg.empty()) continue;
        views += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, name);
    }
    if (views.empty()) return {};
    return "<div class=\"drawings\"><div class=\"stones\">\n" + views +
           "</div>\n<p class=\"facet-line\" role=\"status\">Point at a facet, tap it, or step "
           "through with the Tab key.</p></div>\n";
}

std::string drawings(const Report& report, const Json& fit) {
    if (!report.fitted) return {};
    std::vector<std::string> names;
    for (const Facet& facet : report.fitted->facets) names.push_back(facet.name);
    const std::vector<Worst> worst = worst_readings(fit, names);
    std::vector<FacetPaint> paint(names.size());
    for (std::size_t f = 0; f < names.size(); ++f) {
        std::string about;
        if (const Json* facet = facet_in(fit, names[f]); facet != nullptr) {
            about = fmt::format("inclination {}° ± {}°, azimuth {}° ± {}°",
                                decimals(number_at(*facet, "inclination"), 2),
                                significant(number_at(*facet, "sigma_inclination"), 2),
                                decimals(number_at(*facet, "azimuth"), 2),
                                significant(number_at(*facet, "sigma_azimuth"), 2));
        }
        if (worst[f].reading.empty()) {
            paint[f].colour = "var(--unread)";
            about += (about.empty() ? "" : "; ") + std::string("no reading of its own");
        } else {
            paint[f].colour =
                css_colour(ColourMap::residual, std::abs(worst[f].normalized) / k_worst_shown);
            about += fmt::format("{}worst of {} readings {}, {} standard uncertainties off",
                                 about.empty() ? "" : "; ", worst[f].count, worst[f].reading,
                                 decimals(worst[f].normalized, 2));
        }
        paint[f].about = about;
    }
    const std::string body = both_views(*report.fitted, paint);
    return body + colour_bar(ColourMap::residual,
                             "each facet's worst reading, in standard uncertainties; plain: no "
                             "reading of its own",
                             "0", "2", "≥ 4");
}

std::string facets_table(const Json& fit, const std::string& unit) {
    std::vector<std::string> names;
    for (const Json& facet : array_at(fit, "facets")) names.push_back(text_at(facet, "name"));
    if (names.empty()) return {};
    const std::vector<Worst> worst = worst_readings(fit, names);
    std::string rows;
    std::size_t f = 0;
    for (const Json& facet : array_at(fit, "facets")) {
        const auto pair = [&](const char* key, const char* sigma, int places) {
            return fmt::format("<td class=\"n\">{} <small>± {}</small></td>",
                               decimals(number_at(facet, key), places),
                               significant(number_at(facet, sigma), 2));
        };
        const double size = std::abs(worst[f].normalized);
        const std::string swatch =
            worst[f].reading.empty()
                ? "<span class=\"swatch\"></span>"
                : fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>",
                              css_colour(ColourMap::residual, size / k_worst_shown));
        rows += fmt::format(
            "<tr><th scope=\"row\">{}{}</th>{}{}{}<td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "</tr>\n",
            swatch, escaped(names[f]), pair("inclination", "sigma_inclination", 3),
            pair("azimuth", "sigma_azimuth", 3), pair("offset", "sigma_offset", 4), worst[f].count,
            worst[f].reading.empty() ? "–"
                                     : decimals(worst[f].normalized, 2) + " <small>" +
                                           escaped(worst[f].reading) + "</small>");
        ++f;
    }
    return table("Facets as fitted",
                 fmt::format("<th scope=\"col\">Facet</th><th scope=\"col\" class=\"n\">"
                             "Inclination, °</th><th scope=\"col\" class=\"n\">Azimuth, °</th>"
                             "<th scope=\"col\" class=\"n\">Offset, {}</th><th scope=\"col\" "
                             "class=\"n\">Readings</th><th scope=\"col\" class=\"n\">Worst, σ</th>",
                             escaped(unit)),
                 rows);
}

// A bar from the middle: -4 .. 4 standard uncertainties.
std::string residual_bar(double normalized) {
    const double size = std::min(std::abs(normalized) / k_worst_shown, 1.0);
    const double length = 50 * size, from = normalized < 0 ? 50 - length : 50;
    return fmt::format(
        "<svg class=\"residual\" viewBox=\"0 0 100 12\" aria-hidden=\"true\"><line class=\"axis\" "
        "x1=\"50\" y1=\"0\" x2=\"50\" y2=\"12\"/><rect x=\"{:.1f}\" y=\"2\" width=\"{:.1f}\" "
        "height=\"8\" style=\"fill:{}\"/></svg>",
        from, std::max(length, 0.6), css_colour(ColourMap::residual, size));
}

std::string readings_table(const Json& fit) {
    std::set<std::string> suspects;
    for (const Json& suspect : array_at(fit, "suspects")) {
        if (suspect.is_string()) suspects.insert(suspect.get<std::string>());
        if (suspect.is_object()) suspects.insert(text_at(suspect, "id"));
    }
    std::string rows;
    for (const Json& reading : array_at(fit, "readings")) {
        const std::string id = text_at(reading, "id");
        const bool suspect = true_at(reading, "suspect") || suspects.contains(id);
        const auto normalized = number_at(reading, "normalized");
        const auto cell = [&](const char* key, int digits) {
            return fmt::format("<td class=\"n\">{}</td>",
                               significant(number_at(reading, key), digits));
        };
        rows += fmt::format(
            "<tr{}><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td>{}{}{}{}<td class=\"n\">{}</td>"
            "<td>{}</td>{}{}</tr>\n",
            suspect ? " class=\"suspect\"" : "", escaped(id),
            suspect ? " <span class=\"badge\">suspect</span>" : "",
            escaped(text_at(reading, "kind")), escaped(joined(names_of(reading))), cell("value", 6),
            cell("sigma", 2), cell("fitted", 6), cell("residual", 2), decimals(normalized, 2),
            normalized ? residual_bar(*normalized) : "", cell("redundancy", 2),
            cell("detectable", 2));
    }
    if (rows.empty()) return {};
    return table(
               "Readings and what is left of them",
               "<th scope=\"col\">Reading</th><th scope=\"col\">Kind</th><th scope=\"col\">Of</th>"
               "<th scope=\"col\" class=\"n\">Value</th><th scope=\"col\" class=\"n\">σ</th>"
               "<th scope=\"col\" class=\"n\">Fitted</th>"
               "<th scope=\"col\" class=\"n\">Residual</th>"
               "<th scope=\"col\" class=\"n\">Normalized</th><th scope=\"col\">−4 … 4</th>"
               "<th scope=\"col\" class=\"n\">Redundancy</th>"
               "<th scope=\"col\" class=\"n\">Detectable</th>",
               rows) +
           "<p class=\"note\">Normalized: the residual over its own standard uncertainty. "
           "Redundancy: "
           "0 means that nothing checks this reading, 1 that it adds nothing. Detectable: the "
           "smallest error in it that would be noticed.</p>\n";
}

std::string fit_facts(const Json& fit) {
    const std::string status = text_at(fit, "status");
    std::string words;
    if (status == "converged") words = "The stone below agrees with the readings.";
    if (status == "not_converged")
        words = "The search did not settle: do not rely on the stone below.";
    if (status == "contradictory") words = "The readings contradict one another: see the suspects.";
    if (status == "undetermined") words = "The readings leave some facets free: see below.";
    std::string shown_status = status;
    std::replace(shown_status.begin(), shown_status.end(), '_', ' ');
    std::string body = fmt::format(
        "<p><span class=\"badge {}\">{}</span> {}</p>\n", status == "converged" ? "good" : "bad",
        escaped(shown_status.empty() ? "status unknown" : shown_status), words);
    std::string free;
    for (const Json& one : array_at(fit, "undetermined")) {
        free += fmt::format("<li>{}: {}</li>", escaped(text_at(one, "facet")),
                            escaped(text_at(one, "freedom")));
    }
    if (!free.empty()) body += "<p>Left free by the readings:</p><ul>" + free + "</ul>\n";
    const auto yes_no = [&](const char* key) {
        return !fit.contains(key) ? "–" : true_at(fit, key) ? "yes" : "no";
    };
    body += fmt::format(
        "<p class=\"note\">χ² {} with {} degrees of freedom; {} iterations in {} s; closed: {}, "
        "convex: {}, largest distance of a corner from its plane {}.</p>\n",
        significant(number_at(fit, "chi2")), whole(number_at(fit, "dof")),
        whole(number_at(fit, "iterations")), significant(number_at(fit, "seconds")),
        yes_no("closed"), yes_no("convex"), significant(number_at(fit, "planarity_max")));
    return body;
}

struct Angles {
    double inclination_deg = 0, azimuth_deg = 0;
};

// Inclination from the horizontal, pavilion facets positive too; azimuth counter-clockwise.
Angles angles_of(const Vec3& normal) {
    const double level = std::hypot(normal.x, normal.y);
    double azimuth = degrees(std::atan2(normal.y, normal.x));
    if (azimuth < 0) azimuth += 360;
    return {degrees(std::atan2(level, std::abs(normal.z))), azimuth};
}

std::string change_row(const Solid& before, const Facet& old_facet, const Solid& after,
                       const Facet& new_facet) {
    const Angles a = angles_of(old_facet.plane.normal), b = angles_of(new_facet.plane.normal);
    const double old_area = area(before, old_facet), new_area = area(after, new_facet);
    // A level facet has no azimuth; a turn is the short way round.
    const bool level = std::min(a.inclination_deg, b.inclination_deg) < 0.05;
    const double turn = std::remainder(b.azimuth_deg - a.azimuth_deg, 360.0);
    const auto three = [](double from, double to, double change, int places) {
        return fmt::format(
            "<td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "<td class=\"n strong\">{}{}</td>",
            decimals(from, places), decimals(to, places), change > 0 ? "+" : "",
            decimals(change, places));
    };
    const std::string no_azimuth =
        "<td class=\"n\">–</td><td class=\"n\">–</td><td class=\"n\">–</td>";
    return fmt::format(
        "<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", escaped(new_facet.name),
        three(a.inclination_deg, b.inclination_deg, b.inclination_deg - a.inclination_deg, 2),
        level ? no_azimuth : three(a.azimuth_deg, b.azimuth_deg, turn, 2),
        three(old_area, new_area, new_area - old_area, 3));
}

std::string changes_table(const Report& report) {
    if (!report.starting || !report.fitted) return {};
    const Solid &before = *report.starting, &after = *report.fitted;
    std::string rows;
    double squares = 0, worst = 0, count = 0;
    std::string worst_name;
    for (const Facet& facet : after.facets) {
        const int old_index = find_facet(before, facet.name);
        if (old_index < 0) continue;
        const Facet& old_facet = before.facets[static_cast<std::size_t>(old_index)];
        rows += change_row(before, old_facet, after, facet);
        const double tilt = std::abs(angles_of(facet.plane.normal).inclination_deg -
                                     angles_of(old_facet.plane.normal).inclination_deg);
        squares += tilt * tilt;
        ++count;
        if (tilt > worst) {
            worst = tilt;
            worst_name = facet.name;
        }
    }
    if (count == 0) return {};
    std::string body = fmt::format(
        "<p>Inclinations differ by {}° (root mean square of {:.0f} facets), at most by {}°{}. "
        "Volume {} → {} {}³.</p>\n",
        decimals(std::sqrt(squares / count), 2), count, decimals(worst, 2),
        worst_name.empty() ? "" : " at " + escaped(worst_name), significant(volume(before), 5),
        significant(volume(after), 5), escaped(report.length_unit));
    return body + table("Each facet before and after",
                        fmt::format("<th scope=\"col\">Facet</th>"
                                    "<th scope=\"col\" class=\"n\">Inclination, °</th>"
                                    "<th scope=\"col\" class=\"n\">fitted</th>"
                                    "<th scope=\"col\" class=\"n\">change</th>"
                                    "<th scope=\"col\" class=\"n\">Azimuth, °</th>"
                                    "<th scope=\"col\" class=\"n\">fitted</th>"
                                    "<th scope=\"col\" class=\"n\">change</th>"
                                    "<th scope=\"col\" class=\"n\">Area, {}²</th>"
                                    "<th scope=\"col\" class=\"n\">fitted</th>"
                                    "<th scope=\"col\" class=\"n\">change</th>",
                                    escaped(report.length_unit)),
                        rows);
}

/// Each facet coloured by how much steeper (red) or flatter (blue) it became.
std::string change_drawings(const Report& report) {
    if (!report.starting || !report.fitted) return {};
    std::vector<FacetPaint> paint;
    std::vector<double> steeper;
    double worst = 0;
    for (const Facet& facet : report.fitted->facets) {
        const int old_index = find_facet(*report.starting, facet.name);
        FacetPaint own{"var(--unread)", "not in the starting mesh"};
        steeper.push_back(0);
        if (old_index >= 0) {
            const Facet& before = report.starting->facets[static_cast<std::size_t>(old_index)];
            const double from = angles_of(before.plane.normal).inclination_deg;
            const double to = angles_of(facet.plane.normal).inclination_deg;
            steeper.back() = to - from;
            worst = std::max(worst, std::abs(to - from));
            own = {"",
                   fmt::format("inclination {}° in place of {}°, {}{}°", decimals(to, 2),
                               decimals(from, 2), to > from ? "+" : "", decimals(to - from, 2))};
        }
        paint.push_back(own);
    }
    // Never finer than a tenth of a degree: equal stones look equal.
    const double range = std::max(0.1, std::ceil(10 * worst) / 10);
    for (std::size_t f = 0; f < paint.size(); ++f) {
        if (!paint[f].colour.empty()) continue;
        paint[f].colour = css_colour(ColourMap::difference, 0.5 + 0.5 * steeper[f] / range);
    }
    const std::string both = both_views(*report.fitted, paint);
    if (both.empty()) return {};
    return both + colour_bar(ColourMap::difference, "blue: flatter than designed, red: steeper",
                             decimals(-range, 1) + "°", "0", "+" + decimals(range, 1) + "°");
}

double white_of(const Report& report) {
    if (report.renders_white > 0) return report.renders_white;
    // The same for both pictures: brightness is part of what is compared.
    std::vector<float> values;
    for (const auto* picture : {&report.starting_render, &report.fitted_render}) {
        if (!picture->has_value()) continue;
        for (const float v : (*picture)->rgb) {
            if (v > 0) values.push_back(v);
        }
    }
    if (values.empty()) return 1;
    const auto rank = values.begin() +
                      static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), rank, values.end());
    return static_cast<double>(*rank);
}

}  // namespace

std::string fit_section(const Report& report, const Json& fit) {
    if (fit.empty() && !report.fitted) return {};
    std::string body;
    if (!fit.empty()) body += fit_facts(fit);
    body += drawings(report, fit);
    body += readings_table(fit);
    body += facets_table(fit, report.length_unit);
    return section("fit", "The fitted stone", body);
}

std::string changes_section(const Report& report) {
    std::string body;
    if (report.starting_render && report.fitted_render) {
        const double white = white_of(report);
        body += slider("changes-slider",
                       {"catalogue", picture_uri(*report.starting_render, white),
                        "Render of the stone as it should have been cut"},
                       {"fitted", picture_uri(*report.fitted_render, white),
                        "Render of the stone as it was measured"});
        body +=
            "<p class=\"note\">The same scene with the starting mesh and with the fitted one; "
            "nothing else differs.</p>\n";
    }
    body += change_drawings(report);
    body += changes_table(report);
    return section("changes", "Catalogue against fitted", body);
}

std::string plan_section(const Json& stats) {
    if (stats.empty()) return {};
    std::string rows;
    for (const Json& effect : array_at(stats, "effects")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"n\">{}</td></tr>\n",
            escaped(text_at(effect, "name")), true_at(effect, "on") ? "on" : "off",
            escaped(text_at(effect, "why")), significant(number_at(effect, "error_bound"), 2));
    }
    std::string body;
    if (!rows.empty()) {
        body += table("What was computed, and why",
                      "<th scope=\"col\">Effect</th><th scope=\"col\"></th>"
                      "<th scope=\"col\">Why</th><th scope=\"col\" class=\"n\">Error bound</th>",
                      rows);
    }
    std::string facts;
    const auto fact = [&](const std::string& name, const std::string& value) {
        facts += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td></tr>\n",
                             escaped(name), value);
    };
    if (!text_at(stats, "engine").empty()) fact("engine", escaped(text_at(stats, "engine")));
    for (const char* key : {"depth", "error_bound", "remainder", "beams", "rays"}) {
        if (number_at(stats, key)) {
            std::string name = key;
            std::replace(name.begin(), name.end(), '_', ' ');
            fact(name, significant(number_at(stats, key)));
        }
    }
    if (stats.contains("seconds") && stats["seconds"].is_object()) {
        for (const auto& [key, value] : stats["seconds"].items()) {
            if (value.is_number()) fact("seconds, " + key, significant(value.get<double>()));
        }
    }
    if (!facts.empty()) {
        body +=
            table("Figures of the render",
                  "<th scope=\"col\">Figure</th><th scope=\"col\" class=\"n\">Value</th>", facts);
    }
    return section("plan", "How it was rendered", body);
}

std::string provenance_section(const Report& report) {
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        if (value.empty()) return;
        rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"path\">{}</td></tr>\n",
                            escaped(name), escaped(value));
    };
    row("program", report.version.empty() ? "" : "culet " + report.version);
    row("command", report.command);
    for (const ReportFile& file : report.files) row(file.role, file.name);
    if (report.comparison) {
        row("seed", std::to_string(report.comparison->seed));
        row("photograph", report.comparison->simulated ? "simulated" : "as given");
        for (const std::string& note : report.comparison->notes) row("note", note);
    }
    std::string body;
    if (!rows.empty()) {
        body += table("Made from", "<th scope=\"col\">What</th><th scope=\"col\">Which</th>", rows);
    }
    if (!report.settings.empty()) {
        body += fmt::format("<details><summary>Settings</summary><pre>{}</pre></details>\n",
                            escaped(report.settings));
    }
    return section("provenance", "How this page was made", body);
}

}  // namespace culet
