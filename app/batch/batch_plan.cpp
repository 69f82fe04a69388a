#include "app/batch/batch_plan.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using PlanJson = nlohmann::ordered_json;

// FNV-1a, 64 bits (draft-eastlake-fnv). Hashes each part's length too, so that moving a boundary
// changes the hash.
class Fingerprint {
public:
    void add(std::string_view text) {
        bytes(fmt::format("{}:", text.size()));
        bytes(text);
    }
    std::string text() const { return fmt::format("{:016x}", hash_); }

private:
    void bytes(std::string_view text) {
        for (const char c : text) {
            hash_ ^= static_cast<unsigned char>(c);
            hash_ *= 0x100000001b3u;
        }
    }
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::string text_of(const PlanJson& json, int indent) {
    return json.dump(indent, ' ', false, PlanJson::error_handler_t::replace);
}

PlanJson job_json(const BatchJob& job) {
    PlanJson json{{"name", job.name}, {"stone", job.stone}};
    if (!job.material.empty()) json["material"] = job.material;
    if (job.index) json["index"] = *job.index;
    if (!job.set.empty()) json["set"] = job.set;
    return json;
}

PlanJson settings_json(const BatchSettings& settings) {
    PlanJson json{{"tilts", settings.tilts},
                  {"head_deg", settings.head_deg},
                  {"draws", settings.draws},
                  {"pages", settings.pages},
                  {"seed", settings.seed}};
    if (!settings.material.empty()) json["material"] = settings.material;
    if (settings.index) json["index"] = *settings.index;
    if (!settings.set.empty()) json["set"] = settings.set;
    return json;
}

bool is_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

// Adds `file` and the files that it names.
void gather(const fs::path& file, std::set<fs::path>& files);

void gather_named(const std::string& name, const fs::path& folder, std::set<fs::path>& files) {
    constexpr std::size_t k_longest_path = 4096;
    if (name.empty() || name.size() > k_longest_path) return;
    if (is_file(folder / name)) gather((folder / name).lexically_normal(), files);
}

void gather_texts(const toml::node& node, const fs::path& folder, std::set<fs::path>& files) {
    if (const auto* const text = node.as_string()) {
        gather_named(text->get(), folder, files);
    } else if (const auto* const list = node.as_array()) {
        for (const toml::node& item : *list) gather_texts(item, folder, files);
    } else if (const auto* const table = node.as_table()) {
        for (const auto& [key, item] : *table) gather_texts(item, folder, files);
    }
}

void gather(const fs::path& file, std::set<fs::path>& files) {
    if (!files.insert(file).second || extension_of(file) != "toml") return;
    try {
        gather_texts(toml::parse(decoded_text(read_text(file), file)), file.parent_path(), files);
    } catch (const toml::parse_error&) {
        // Not readable as TOML: only its own bytes count.
    } catch (const InputError&) {
    }
}

}  // namespace

std::string batch_plan_json(const BatchList& list, const BatchSettings& settings) {
    PlanJson plan{{"schema", 1}, {"version", CULET_VERSION}, {"settings", settings_json(settings)}};
    plan["jobs"] = PlanJson::array();
    for (const BatchJob& job : list.jobs) plan["jobs"].push_back(job_json(job));
    return text_of(plan, 1) + "\n";
}

std::vector<BatchJob> jobs_of_plan(const std::string& json, const fs::path& file) {
    try {
        const PlanJson plan = PlanJson::parse(json);
        std::vector<BatchJob> jobs;
        for (const PlanJson& entry : plan.at("jobs")) {
            BatchJob job;
            job.name = entry.at("name").get<std::string>();
            job.stone = entry.at("stone").get<std::string>();
            if (job.name.empty() || job.name.find('/') != std::string::npos || job.name[0] == '.')
                throw InputError(file,
                                 "names a job that cannot name a folder: start the batch anew");
            jobs.push_back(std::move(job));
        }
        return jobs;
    } catch (const PlanJson::exception&) {
        throw InputError(file, "is not the plan of a batch: run culet batch JOBS -o DIR --resume");
    }
}

std::vector<fs::path> files_of_stone(const fs::path& file, const std::vector<std::string>& set) {
    std::set<fs::path> files;
    gather(file.lexically_normal(), files);
    for (const std::string& setting : set) {
        std::string value = setting.substr(std::min(setting.find('=') + 1, setting.size()));
        std::erase_if(value, [](char c) { return c == '"' || c == '\''; });
        gather_named(value, file.parent_path(), files);
    }
    return {files.begin(), files.end()};
}

std::string hash_of(std::string_view text) {
    Fingerprint print;
    print.add(text);
    return print.text();
}

std::string fingerprint_of(const BatchList& list, const BatchJob& job,
                           const BatchSettings& settings) {
    Fingerprint print;
    print.add(CULET_VERSION);
    print.add(text_of(settings_json(settings), -1));
    print.add(text_of(job_json(job), -1));
    std::vector<std::string> set = settings.set;
    set.insert(set.end(), job.set.begin(), job.set.end());
    std::vector<fs::path> files = files_of_stone(list.folder / job.stone, set);
    for (const fs::path& material : {fs::path(settings.material), list.folder / job.material}) {
        if (is_file(material)) files.push_back(material);
    }
    for (const fs::path& file : files) {
        // The batch's location does not count.
        print.add(file.lexically_proximate(list.folder).generic_string());
        try {
            print.add(read_text(file));
        } catch (const InputError& error) {
            print.add(error.what());
        }
    }
    return print.text();
}

}  // namespace culet
