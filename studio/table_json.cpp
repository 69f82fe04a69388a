#include "studio/table_json.h"

#include <fmt/format.h>

#include <map>

#include "fit/findings/words.h"
#include "studio/json_text.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// By line of the readings file.
std::map<long, Json> flags_of(const Project& project) {
    std::map<long, Json> flags;
    for (const RowProblem& problem : project.problems()) {
        if (problem.line > 0)
            flags[problem.line] = {{"what", sentence_of(problem.what)}, {"refused", true}};
    }
    for (const Doubt& doubt : project.doubts()) {
        const Reading& reading = project.bound()[doubt.reading];
        if (reading.file != project.readings().path()) continue;
        Json& flag = flags[reading.line];
        if (!flag.is_null()) continue;
        const std::string place = place_words(reading) + ": ";
        std::string what =
            doubt.what.starts_with(place) ? doubt.what.substr(place.size()) : doubt.what;
        if (!doubt.slip.empty()) {
            flag["suggested"] = fmt::format("{:.6g}", file_unit(reading.kind) * doubt.corrected);
            flag["slip"] = doubt.slip;
        }
        flag["what"] = sentence_of(std::move(what));
    }
    return flags;
}

}  // namespace

std::string table_json(const Project& project, const TableNews& news) {
    const ReadingsTable& table = project.table();
    Json json{{"opened", news.opened},
              {"revision", project.revision()},
              {"shape", project.shape()},
              {"name", project.name()},
              {"folder", project.stone_file().parent_path().string()},
              {"file", project.loaded()->readings.filename().string()},
              {"outside", news.outside},
              {"trouble", news.trouble},
              {"columns", table.columns()},
              {"rows", Json::array()}};
    json["undo"] = project.readings().can_undo();
    json["redo"] = project.readings().can_redo();
    for (const RowProblem& problem : project.problems()) {
        if (problem.line == 0) json["trouble"] = problem.what;
    }
    std::map<long, Json> flags = flags_of(project);
    std::map<long, bool> skipped;
    for (const WrittenReading& written : project.loaded()->written) {
        if (written.file == project.readings().path()) skipped[written.line] = written.skipped;
    }
    for (std::size_t r = 0; r < table.rows().size(); ++r) {
        const ReadingsTable::Row& row = table.rows()[r];
        Json own{{"line", row.line},
                 {"cells", row.cells},
                 {"facets", project.facets_of_rows()[r]},
                 {"read", !skipped[row.line]}};
        if (const auto flag = flags.find(row.line); flag != flags.end()) own["flag"] = flag->second;
        json["rows"].push_back(std::move(own));
    }
    return text_of(json);
}

}  // namespace culet
