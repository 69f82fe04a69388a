#include <fmt/format.h>

#include "app/describe/describe.h"
#include "app/program/file_kinds.h"
#include "stone/design/design_difference.h"
#include "stone/solid_input.h"

namespace culet {

Description describe_difference(const DescribeOptions& options,
                                const std::filesystem::path& other) {
    Description about;
    std::vector<Solid> solids;
    for (const std::filesystem::path& file : {options.file, other}) {
        require_kind(file, {FileKind::solid}, "culet info --diff");
        SolidInput input = load_solid(file, options.cut);
        for (const std::string& note : input.notes)
            about.notes.push_back(fmt::format("{}: {}", file.string(), note));
        solids.push_back(std::move(input.solid));
    }
    about.object["format"] = "difference";
    about.object["against"] = other.string();
    about.object["differences"] = nlohmann::ordered_json::array();
    for (const DesignDifference& one : design_differences(solids[0], solids[1])) {
        about.object["differences"].push_back(
            {{"what", one.what}, {"tier", one.tier}, {"a", one.a}, {"b", one.b}});
        about.lines.push_back(words_of(one));
    }
    if (about.lines.empty()) {
        about.lines.push_back(
            fmt::format("{} and {} are cut alike", options.file.string(), other.string()));
    }
    return about;
}

}  // namespace culet
