#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/calibration/calibration.h"
#include "page/json_fields.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;
constexpr auto number = json_number<OrderedJson>;

constexpr int k_schema = 3;  // 1: scored against a sharp render; 2: without the facets' tilts
constexpr std::size_t k_most_draws = 100000;

constexpr Alternative k_alternatives[] = {
    Alternative::facet_error, Alternative::light,    Alternative::pose, Alternative::both,
    Alternative::catalogue,   Alternative::material, Alternative::wrong};

std::optional<Alternative> alternative_named(const std::string& name) {
    for (const Alternative alternative : k_alternatives) {
        if (name == name_of(alternative)) return alternative;
    }
    return std::nullopt;
}

}  // namespace

const char* name_of(Alternative alternative) {
    switch (alternative) {
        case Alternative::facet_error:
            return "facet_error";
        case Alternative::light:
            return "light";
        case Alternative::pose:
            return "pose";
        case Alternative::both:
            return "both";
        case Alternative::catalogue:
            return "catalogue";
        case Alternative::material:
            return "material";
        case Alternative::wrong:
            return "wrong";
    }
    return "wrong";
}

std::string calibration_json(const Calibration& calibration) {
    OrderedJson json;
    json["schema"] = k_schema;
    json["kind"] = "calibration";
    json["hash"] = calibration.hash;
    json["seed"] = calibration.seed;
    json["stone_px"] = number(calibration.stone_px);
    json["psf_px"] = number(calibration.psf_px);
    json["electrons"] = number(calibration.electrons);
    json["keys"] = calibration.keys;
    json["notes"] = calibration.notes;
    json["draws"] = OrderedJson::array();
    for (const CalibrationDraw& draw : calibration.draws) {
        OrderedJson one = {{"world", name_of(draw.alternative)},
                           {"name", draw.name},
                           {"facet_error_deg", number(draw.facet_error_deg)},
                           {"scores", OrderedJson::array()}};
        for (const auto& score : draw.scores) one["scores"].push_back(number(score));
        json["draws"].push_back(std::move(one));
    }
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::optional<Calibration> calibration_from(const std::string& text) {
    // Whatever is wrong with a cached file, the calibration is made anew.
    try {
        const OrderedJson json = OrderedJson::parse(text);
        if (json.at("schema") != k_schema || json.at("kind") != "calibration") return std::nullopt;
        Calibration result;
        result.hash = json.at("hash").get<std::string>();
        result.seed = json.at("seed").get<std::uint64_t>();
        result.stone_px = json.at("stone_px").get<double>();
        result.psf_px = json.at("psf_px").get<double>();
        result.electrons = json.at("electrons").get<double>();
        result.keys = json.at("keys").get<std::vector<std::string>>();
        result.notes = json.at("notes").get<std::vector<std::string>>();
        if (json.at("draws").size() > k_most_draws) return std::nullopt;
        for (const OrderedJson& one : json.at("draws")) {
            CalibrationDraw draw;
            const auto alternative = alternative_named(one.at("world").get<std::string>());
            if (!alternative) return std::nullopt;
            draw.alternative = *alternative;
            draw.name = one.at("name").get<std::string>();
            draw.facet_error_deg = one.at("facet_error_deg").get<double>();
            for (const OrderedJson& score : one.at("scores")) {
                draw.scores.push_back(score.is_null() ? std::nullopt
                                                      : std::optional(score.get<double>()));
            }
            if (draw.scores.size() != result.keys.size()) return std::nullopt;
            result.draws.push_back(std::move(draw));
        }
        return result;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace culet
