#include "page/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "page/drawing.h"
#include "page/fit_fields.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/template.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// The proportions of a fit report, as texts; empty where the report has none.
struct FitProportions {
    const Json& list;

    std::string with_sigma(const std::string& name) const {
        const Json* p = named_in(list, name);
        return p == nullptr ? "" : proportion_text(*p);
    }
    // To the first digit of sigma.
    std::string rounded(const std::string& name) const {
        const Json* p = named_in(list, name);
        if (p == nullptr) return {};
        return to_place_of(number_at(*p, "value"), 10 * value_at(*p, "sigma"), text_at(*p, "unit"));
    }
    double value(const std::string& name) const {
        const Json* p = named_in(list, name);
        return p == nullptr ? 0 : number_at(*p, "value").value_or(0);
    }
    bool round() const { return named_in(list, "diameter") != nullptr; }
};

// As the trade writes it: 8.99 × 7.01 × 5.20 mm; of a round stone 6.49 – 6.52 × 3.99 mm. To the
// first digit of the largest sigma.
std::string size_text(const FitProportions& of) {
    const bool round = of.round();
    const std::array<const Json*, 3> sides{named_in(of.list, round ? "caliper min" : "length"),
                                           named_in(of.list, round ? "caliper max" : "width"),
                                           named_in(of.list, "depth")};
    double sigma = 0;
    for (const Json* side : sides) {
        if (side == nullptr) return {};
        sigma = std::max(sigma, number_at(*side, "sigma").value_or(0));
    }
    std::string text;
    for (const Json* side : sides) {
        if (!text.empty()) text += round && side == sides[1] ? "\u2009–\u2009" : " × ";
        text += to_place_of(number_at(*side, "value"), 10 * sigma,
                            side == sides[2] ? text_at(*side, "unit") : "");
    }
    return text;
}

// The balance's reading, if there is one and the fit has no doubt about it.
View weight_view(const Json& fit, const FitProportions& of) {
    const std::set<std::string> suspects = suspects_of(fit);
    for (const Json& reading : array_at(fit, "readings")) {
        if (text_at(reading, "kind") == "weight" && !suspects.contains(text_at(reading, "id")))
            return {
                {"text", quantity(number_at(reading, "value"), number_at(reading, "sigma"), "ct")},
                {"how", "weighed"}};
    }
    return {{"text", of.with_sigma("weight")}, {"how", "calculated"}};
}

std::vector<View> proportion_rows(const FitProportions& of) {
    std::vector<std::pair<std::string, std::string>> names{
        {"length", "length"}, {"width", "width"}, {"length/width", "length to width"}};
    if (of.round())
        names = {{"caliper min", "least diameter"},
                 {"caliper max", "largest diameter"},
                 {"diameter", "mean diameter"}};
    for (const char* name : {"depth", "total depth", "table", "crown height", "girdle thickness",
                             "pavilion depth", "crown angle", "pavilion angle", "volume"})
        names.emplace_back(name, name);
    std::vector<View> rows;
    for (const auto& [name, shown] : names) {
        const std::string text = of.with_sigma(name);
        if (!text.empty()) rows.push_back({{"name", shown}, {"value", text}});
    }
    return rows;
}

// Crown, girdle and pavilion beside the stone's outline, in per cent of its height.
std::vector<View> height_marks(const FitProportions& of) {
    const double total = of.value("total depth");
    std::vector<View> marks;
    double top = 0;
    for (const auto& [name, angle] : {std::pair{"crown height", "crown angle"},
                                      {"girdle thickness", ""},
                                      {"pavilion depth", "pavilion angle"}}) {
        const double share = total > 0 ? 100 * of.value(name) / total : 0;
        if (share > 0)
            marks.push_back({{"top", fmt::format("{:.2f}", top)},
                             {"height", fmt::format("{:.2f}", share)},
                             {"text", of.rounded(name)},
                             {"angle", of.rounded(angle)}});
        top += share;
    }
    return marks;
}

std::string drawing_of(const Solid& stone, ViewSide side) {
    Solid nameless = stone;
    for (Facet& facet : nameless.facets) facet.name.clear();
    return draw_facets_svg(nameless, side);
}

// The width in mm at which a drawing has this height.
std::string width_for(const Solid& stone, ViewSide side, double height_mm) {
    const FacetView view = view_of(stone, side, 1000);
    return fmt::format("{:.1f}", view.height > 0 ? height_mm * view.width / view.height : 0);
}

}  // namespace

std::string certificate_page(const Certificate& certificate) {
    const Json fit = parsed_object<Json>(certificate.fit_json, "the fit report for the page");
    const FitProportions of{array_at(fit, "proportions")};
    const std::size_t readings = array_at(fit, "readings").size();
    std::string status = text_at(fit, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    const std::string picture =
        certificate.picture_png.empty() ? "" : png_uri(certificate.picture_png);
    return filled(templates::certificate,
                  {{"name", certificate.name},
                   {"material", certificate.material},
                   {"issuer", certificate.issuer},
                   {"number", certificate.number},
                   {"date", certificate.date},
                   {"logo_uri", certificate.logo_uri},
                   {"paper", certificate.paper},
                   {"version", certificate.version},
                   {"picture_uri", picture},
                   {"doubt", status == "converged" ? "" : status},
                   {"size", size_text(of)},
                   {"weight", weight_view(fit, of)},
                   {"facets", std::to_string(certificate.stone.facets.size())},
                   {"readings", readings == 0 ? "" : std::to_string(readings)},
                   {"crown_svg", drawing_of(certificate.stone, ViewSide::crown)},
                   {"crown_mm", width_for(certificate.stone, ViewSide::crown, 42)},
                   {"pavilion_svg", drawing_of(certificate.stone, ViewSide::pavilion)},
                   {"profile_svg", drawing_of(certificate.stone, ViewSide::girdle)},
                   {"profile_mm", width_for(certificate.stone, ViewSide::girdle, 38)},
                   {"marks", height_marks(of)},
                   {"table", of.rounded("table")},
                   {"total_depth", of.rounded("total depth")},
                   {"round", of.round()},
                   {"proportions", table_view(proportion_rows(of))}});
}

std::string logo_uri(std::string_view bytes) {
    const std::string_view start = bytes.substr(0, 4096);
    const char* const kind = start.starts_with("\x89PNG")                   ? "png"
                             : start.starts_with("\xff\xd8\xff")            ? "jpeg"
                             : start.find("<svg") != std::string_view::npos ? "svg+xml"
                                                                            : nullptr;
    return kind == nullptr ? "" : fmt::format("data:image/{};base64,{}", kind, base64(bytes));
}

}  // namespace culet
