#include "studio/begin_json.h"

#include <nlohmann/json.hpp>

#include "stone/cuts/cuts.h"
#include "stone/material/material.h"
#include "studio/new_project.h"

namespace culet {

std::string begin_json(const std::filesystem::path& folder) {
    using Json = nlohmann::ordered_json;
    Json json{{"folder", folder.string()},
              {"cuts", Json::array()},
              {"materials", catalogue_names()},
              {"stones", Json::array()},
              {"recent", Json::array()}};
    for (const CutKind& kind : cut_kinds()) {
        Json parameters = Json::array();
        for (const CutParameter& p : kind.parameters) {
            parameters.push_back({{"name", p.name},
                                  {"value", p.value},
                                  {"least", p.least},
                                  {"most", p.most},
                                  {"unit", p.unit},
                                  {"what", p.what}});
        }
        json["cuts"].push_back(
            {{"name", kind.name}, {"summary", kind.summary}, {"parameters", parameters}});
    }
    for (const auto& file : stone_files_in(folder)) json["stones"].push_back(file.string());
    for (const auto& file : recent_projects()) json["recent"].push_back(file.string());
    return json.dump();
}

}  // namespace culet
