#include "studio/new_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include "fit/readings/readings_template.h"
#include "stone/cuts/cuts.h"
#include "stone/design/design.h"
#include "stone/file_kind.h"
#include "stone/material/material.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/path_fence.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"
#include "studio/json_text.h"
#include "studio/sample_stones.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_most_recent = 12, k_most_folders = 200, k_longest_name = 60;
constexpr const char *k_stone = "stone.toml", *k_readings = "readings.csv";

// The mesh that a stone file names; empty: none, or it cannot be read.
fs::path mesh_of(const fs::path& stone_file) {
    try {
        const auto stone = read_toml(stone_file).table("stone");
        const auto mesh = stone ? stone->path("mesh") : std::nullopt;
        return mesh ? fs::weakly_canonical(*mesh) : fs::path();
    } catch (const InputError&) {
        return {};
    }
}

bool is_stone_file(const fs::path& file) {
    if (extension_of(file) != "toml") return false;
    try {
        return kind_of(file) == FileKind::stone;
    } catch (const InputError&) {
        return false;
    }
}

std::vector<fs::path> stone_files_directly_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.is_regular_file(ignored) && is_stone_file(entry.path()))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

fs::path finished(const fs::path& folder, const std::string& mesh, const std::string& material) {
    const SolidInput input = load_solid(folder / mesh);
    Stone stone;
    stone.name = fs::path(mesh).stem().string();
    stone.solid = input.solid;
    stone.facets_are_whole = input.facets_are_whole;
    if (!material.empty()) stone.material = catalogue_material(material);
    const ReadingsForm form = readings_form(stone, !material.empty());
    write_text(folder / k_readings, form.csv);
    write_text(folder / k_stone, stone_file_text(stone, folder / k_stone, folder / mesh,
                                                 folder / k_readings, material, form.up_facet));
    return folder / k_stone;
}

// A folder that was begun is removed when the rest fails.
fs::path made_in(const fs::path& folder, const std::string& mesh, const std::string& bytes,
                 const std::string& material) {
    try {
        write_text(folder / mesh, bytes);
        return finished(folder, mesh, material);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        throw;
    }
}

fs::path recent_file() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    const char* const home = std::getenv("HOME");
    if (state != nullptr && *state != '\0') return fs::path(state) / "culet" / "studio-recent";
    if (home == nullptr) return {};
    return fs::path(home) / ".local" / "state" / "culet" / "studio-recent";
}

}  // namespace

std::string plain_name(const std::string& given) {
    std::string name;
    for (const char c : fs::path(given).filename().string()) {
        const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' ||
                          c == '-' || c == '_' || c == ' ';
        name += kept ? c : '_';
    }
    const std::size_t first = name.find_first_not_of(". ");
    name = first == std::string::npos ? "stone" : name.substr(first);
    const std::string extension = fs::path(name).extension().string();
    const std::string stem = fs::path(name).stem().string().substr(0, k_longest_name);
    return stem + extension.substr(0, 8);
}

fs::path folder_for(const fs::path& within, const std::string& stem, const std::string& name,
                    const std::string& bytes, bool& is_there) {
    for (int n = 1; n < 1000; ++n) {
        const fs::path folder = within / (n == 1 ? stem : fmt::format("{}-{}", stem, n));
        std::error_code error;
        is_there = fs::is_regular_file(folder / k_stone, error) &&
                   fs::is_regular_file(folder / name, error) && read_text(folder / name) == bytes;
        if (is_there || fs::create_directory(folder, error)) return folder;
        if (error) throw InputError(folder, fmt::format("cannot be made: {}", error.message()));
    }
    throw InputError(within, "has no room for another folder " + stem);
}

fs::path stone_file_for(const fs::path& input) {
    std::error_code error;
    const fs::path path = fs::canonical(input, error);
    if (error) throw InputError(input, "no such file or folder");
    if (fs::is_directory(path, error)) {
        if (fs::is_regular_file(path / k_stone, error)) return path / k_stone;
        const std::vector<fs::path> files = stone_files_directly_in(path);
        return files.size() == 1 ? files.front() : fs::path();
    }
    if (is_solid_file(path)) {
        for (const fs::path& file : stone_files_directly_in(path.parent_path())) {
            if (mesh_of(file) == path) return file;
        }
        return project_of_file(path.parent_path(), path.filename().string(), read_text(path));
    }
    if (kind_of(path) == FileKind::stone) return path;
    throw InputError(input, fmt::format("is {}; culet studio opens a folder, a stone file, a mesh "
                                        "or a design",
                                        words_for(kind_of(path))));
}

fs::path project_of_file(const fs::path& folder, const std::string& file_name,
                         const std::string& bytes, const std::string& material) {
    const std::string name = plain_name(file_name);
    if (!is_solid_file(name)) load_solid(folder / name);  // throws, and lists what can be read
    bool is_there = false;
    const fs::path own = folder_for(folder, fs::path(name).stem().string(), name, bytes, is_there);
    return is_there ? own / k_stone : made_in(own, name, bytes, material);
}

fs::path project_of_cut(const fs::path& folder, const std::string& kind,
                        const std::map<std::string, double>& values, const std::string& material) {
    const CutKind& cut = cut_kind(kind);
    if (!material.empty()) catalogue_material(material);
    Solid solid = make_cut(cut.name, values);
    if (cut.convex) solid.design = std::make_shared<const Design>(drawn_design(solid));
    bool is_there = false;
    const std::string name = cut.name + ".obj";
    const fs::path own = folder_for(folder, cut.name, name, {}, is_there);
    try {
        write_design(solid, cut.name, own / name);
        return finished(own, name, material);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(own, ignored);
        throw;
    }
}

std::vector<fs::path> stone_files_in(const fs::path& folder) {
    std::vector<fs::path> files = stone_files_directly_in(folder), folders;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.is_directory(ignored) && !entry.is_symlink(ignored) &&
            !entry.path().filename().string().starts_with('.'))
            folders.push_back(entry.path());
        if (folders.size() >= k_most_folders) break;
    }
    std::sort(folders.begin(), folders.end());
    for (const fs::path& one : folders) {
        for (const fs::path& file : stone_files_directly_in(one)) files.push_back(file);
    }
    return files;
}

std::vector<fs::path> recent_projects() {
    std::vector<fs::path> projects;
    std::error_code ignored;
    const fs::path list = recent_file();
    if (!fs::is_regular_file(list, ignored)) return projects;
    std::istringstream lines(read_text(list, 1u << 20));
    for (std::string line; std::getline(lines, line) && projects.size() < k_most_recent;) {
        if (fs::is_regular_file(line, ignored)) projects.emplace_back(line);
    }
    return projects;
}

void remember_project(const fs::path& stone_file) {
    std::vector<fs::path> projects = recent_projects();
    std::erase(projects, stone_file);
    projects.insert(projects.begin(), stone_file);
    if (projects.size() > k_most_recent) projects.resize(k_most_recent);
    std::string text;
    for (const fs::path& one : projects) text += one.string() + "\n";
    std::error_code ignored;
    const fs::path list = recent_file();
    if (list.empty()) return;
    fs::create_directories(list.parent_path(), ignored);
    try {
        write_text(list, text);
    } catch (const InputError&) {
        // The studio works without it.
    }
}

std::string begin_json(const std::filesystem::path& folder) {
    using Json = nlohmann::ordered_json;
    Json json{{"folder", folder.string()},      {"cuts", Json::parse(cut_list_json())},
              {"materials", catalogue_names()}, {"stones", Json::array()},
              {"recent", Json::array()},        {"samples", Json::array()}};
    for (const SampleStone& sample : sample_stones())
        json["samples"].push_back({{"name", sample.name}, {"words", sample.words}});
    for (const auto& file : stone_files_in(folder)) json["stones"].push_back(file.string());
    for (const auto& file : recent_projects()) json["recent"].push_back(file.string());
    return text_of(json);
}

}  // namespace culet
