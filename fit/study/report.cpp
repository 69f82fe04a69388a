// A study as JSON and as comma-separated values.

#include <fmt/format.h>

#include "fit/report/json_number.h"
#include "fit/study/study.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json setting_json(const StudySetting& row) {
    // Without a sound stone there is no error.
    const auto if_sound = [&](double value) {
        return row.sound > 0 ? json_number(value) : Json(nullptr);
    };
    return {{"sweep", row.sweep},
            {"setting", row.setting},
            {"as_asked", row.as_asked},
            {"fits", row.fits},
            {"sound", row.sound},
            {"settled", row.settled},
            {"best", row.best < 0 ? Json(nullptr) : Json(row.best)},
            {"angle_error", if_sound(degrees(row.angle_error))},
            {"angle_left", row.angle_left < 0 ? Json(nullptr) : json_degrees(row.angle_left)},
            {"offset_error", if_sound(row.offset_error)},
            {"seconds", row.seconds},
            {"seconds_low", row.seconds_low},
            {"seconds_high", row.seconds_high}};
}

Json limit_json(const StudyLimit& row) {
    const bool measured = row.draws > row.failed;
    const auto if_measured = [&](double value) {
        return measured ? json_number(value) : Json(nullptr);
    };
    return {
        {"readings", row.readings},
        {"share", row.share},
        {"dof", row.dof},
        {"draws", row.draws},
        {"failed", row.failed},
        {"angle_error", if_measured(degrees(row.angle_error))},
        {"angle_limit", json_degrees(row.angle_limit)},
        {"ratio", if_measured(row.ratio)},
        // One draw has no scatter.
        {"ratio_sigma", row.draws - row.failed > 1 ? if_measured(row.ratio_sigma) : Json(nullptr)},
        {"offset_error", if_measured(row.offset_error)},
        {"offset_limit", json_number(row.offset_limit)}};
}

std::string csv(const Json& rows) {
    if (rows.empty()) return {};
    std::string text;
    for (const auto& [key, value] : rows.front().items()) {
        text += (text.empty() ? "" : ",") + key;
    }
    text += "\n";
    for (const Json& row : rows) {
        std::string line;
        bool first = true;
        for (const auto& [key, value] : row.items()) {
            if (!first) line += ",";
            first = false;
            if (value.is_null()) continue;
            line += value.is_string() ? value.get<std::string>() : value.dump();
        }
        text += line + "\n";
    }
    return text;
}

}  // namespace

std::string study_json(const Study& study) {
    const FitOptions& fit = study.options.fit;
    Json object;
    object["schema"] = 1;
    object["kind"] = "fit";
    object["name"] = study.stone;
    object["status"] = name_of(study.status);
    object["message"] = study.message;
    object["unit"] = std::string(name_of(study.unit));
    object["facets"] = study.facets;
    object["readings"] = study.readings;
    object["seconds"] = study.seconds;
    object["options"] = {{"seed", study.options.seed},
                         {"draws", study.options.draws},
                         {"budget", study.options.budget_seconds},
                         {"meets", name_of(fit.meets)},
                         {"meet_sigma", fit.meet_sigma ? Json(*fit.meet_sigma) : Json("auto")},
                         {"iterations", fit.iterations},
                         {"starts", fit.starts},
                         {"significance", fit.significance}};
    object["settings"] = json_list(study.settings, setting_json);
    object["limits"] = json_list(study.limits, limit_json);
    object["limit_made_exact"] = study.limit_made_exact;
    object["limit_message"] = study.limit_message;
    object["left_out"] = study.left_out;
    // A name need not be UTF-8.
    return object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string study_time_csv(const Study& study) {
    return csv(json_list(study.settings, setting_json));
}

std::string study_limit_csv(const Study& study) {
    return csv(json_list(study.limits, limit_json));
}

}  // namespace culet
