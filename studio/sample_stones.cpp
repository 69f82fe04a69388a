#include "studio/sample_stones.h"

#include <algorithm>
#include <map>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "studio/new_project.h"

namespace culet {

namespace embedded {
extern const char* const evening_stone;
extern const char* const evening_mesh;
extern const char* const evening_readings;
extern const char* const dravite_stone;
extern const char* const dravite_mesh;
extern const char* const dravite_readings;
}  // namespace embedded

namespace fs = std::filesystem;

const std::vector<SampleStone>& sample_stones() {
    static const std::vector<SampleStone> samples{
        {"cutters-evening", "a round brilliant and an evening's readings, one of them a slip"},
        {"dravite-step", "a step-cut tourmaline, drawn by hand and read with care"}};
    return samples;
}

fs::path project_of_sample(const fs::path& folder, const std::string& name) {
    const std::map<std::string, std::map<std::string, const char*>> files{
        {"cutters-evening",
         {{"stone.toml", embedded::evening_stone},
          {"start.obj", embedded::evening_mesh},
          {"readings.csv", embedded::evening_readings}}},
        {"dravite-step",
         {{"stone.toml", embedded::dravite_stone},
          {"hand.obj", embedded::dravite_mesh},
          {"readings.csv", embedded::dravite_readings}}}};
    const auto sample = files.find(name);
    if (sample == files.end()) throw InputError("there is no such sample: choose one of the list");
    bool is_there = false;
    const fs::path own =
        folder_for(folder, name, "stone.toml", sample->second.at("stone.toml"), is_there);
    if (is_there) return own / "stone.toml";
    for (const auto& [file, text] : sample->second) write_text(own / file, text);
    return own / "stone.toml";
}

}  // namespace culet
