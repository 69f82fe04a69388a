// The trade's proportions, as they are and as laboratories round them.

#include <fmt/format.h>

#include <algorithm>

#include "app/describe/describe.h"
#include "page/json_fields.h"
#include "page/quantity.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json measures_json(const Solid& solid) {
    Json list = Json::array();
    for (const CutMeasure& measure : cut_measures(solid)) {
        const std::string unit = measure.unit == "length" ? "" : measure.unit;
        Json one{{"name", measure.name}, {"value", measure.value}, {"unit", unit}};
        for (const auto& [key, style] :
             {std::pair("gia", ReportStyle::gia), std::pair("ags", ReportStyle::ags)}) {
            const double step = rounding_step(style, measure.name, unit);
            if (step > 0) one[key] = rounded_to(measure.value, step);
        }
        list.push_back(std::move(one));
    }
    return list;
}

}  // namespace

void describe_measures(const Solid& solid, const DescribeOptions& options, Description& about) {
    if (options.report.empty()) {
        about.object["proportions"] = measures_json(solid);
    } else {
        const Json fit = parsed_object<Json>(read_text(options.report), "the fit report");
        about.object["proportions"] = array_at(fit, "proportions");
    }
    if (!options.style) return;
    const char* const rounded = *options.style == ReportStyle::gia   ? "gia"
                                : *options.style == ReportStyle::ags ? "ags"
                                                                     : nullptr;
    for (const Json& one : about.object["proportions"]) {
        const std::string unit = text_at(one, "unit");
        const auto value = number_at(one, "value"), sigma = number_at(one, "sigma");
        if (!value) continue;
        const std::string shown =
            sigma ? plain_signs(quantity(value, sigma, unit))
                  : fmt::format("{:.4f}{}{}", *value, unit.empty() ? "" : " ", unit);
        std::string line = fmt::format("{:<26} {:>24}", text_at(one, "name"), shown);
        const auto as_printed = rounded == nullptr ? std::nullopt : number_at(one, rounded);
        if (as_printed) line += fmt::format("  {:>8g}", *as_printed);
        about.lines.push_back(std::move(line));
    }
}

}  // namespace culet
