#include "tests/hard/hard_case.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "stone/text/errors.h"

namespace culet::hard {

namespace {

namespace fs = std::filesystem;

// The comment lines at the top, joined.
std::string first_comment(const fs::path& file) {
    std::ifstream text(file);
    std::string words;
    for (std::string line; std::getline(text, line) && line.starts_with('#');) {
        line.erase(0, line.find_first_not_of("# "));
        words += (words.empty() ? "" : " ") + line;
    }
    return words;
}

Allowed allowed_in(const TomlTable& invariants, const std::string& name) {
    Allowed allowed;
    if (const auto table = invariants.kind(name) == TomlTable::Kind::table ? invariants.table(name)
                                                                           : std::nullopt) {
        table->refuse_unknown({"limit", "per_condition", "per_x"});
        allowed.limit = table->number("limit").value_or(0);
        allowed.per_condition = table->number("per_condition").value_or(0);
        allowed.per_x = table->number("per_x").value_or(0);
    } else {
        allowed.limit = invariants.number(name).value_or(0);
    }
    return allowed;
}

std::vector<HardPoint> points_of(const TomlTable& sweep) {
    sweep.refuse_unknown({"parameter", "values", "x", "label", "log"});
    const auto parameters = sweep.words("parameter");
    const auto values = sweep.words("values");
    if (!parameters || !values || values->empty()) {
        sweep.fail("values", "a sweep needs a `parameter` and `values`");
    }
    std::vector<HardPoint> points;
    for (const std::string& value : *values) {
        HardPoint point;
        point.label = value;
        char* end = nullptr;
        point.x = std::strtod(value.c_str(), &end);
        if (end == value.c_str() || *end != '\0' || !std::isfinite(point.x)) {
            point.x = std::nan("");
        }
        for (const std::string& parameter : *parameters) {
            // Words stay words, though TOML reads `nan` and `inf` as numbers.
            point.overrides.push_back(std::isnan(point.x)
                                          ? fmt::format("{}=\"{}\"", parameter, value)
                                          : fmt::format("{}={}", parameter, value));
        }
        points.push_back(std::move(point));
    }
    // Where the swept values do not say how hard they are.
    if (const auto x = sweep.numbers("x")) {
        if (x->size() != points.size()) sweep.fail("x", "as many `x` as `values`");
        for (std::size_t i = 0; i < points.size(); ++i) points[i].x = (*x)[i];
    }
    return points;
}

}  // namespace

const std::vector<std::string>& sections() {
    static const std::vector<std::string> names{"geometry", "readings", "optics", "beams",
                                                "pictures"};
    return names;
}

HardCase read_case(const fs::path& file) {
    HardCase result;
    result.file = file;
    result.name = file.stem().string();
    result.section = file.parent_path().filename().string();
    result.why = first_comment(file);
    if (result.why.empty()) {
        throw InputError(file, 1, "begin with a comment that says why this case is hard");
    }
    const TomlTable root = read_toml(file);
    result.title = root.text("title").value_or(result.name);
    result.kind = root.text("kind").value_or("");
    result.highlight = root.text("highlight").value_or("");
    result.seconds = root.number("seconds").value_or(result.seconds);
    result.no_invalid_operations =
        root.boolean("no_invalid_operations").value_or(result.no_invalid_operations);
    result.may_be_refused = root.boolean("may_be_refused").value_or(false);
    if (const auto sweep = root.table("sweep")) {
        result.points = points_of(*sweep);
        result.x_label = sweep->text("label").value_or(sweep->words("parameter")->front());
        result.log_x = sweep->boolean("log").value_or(true);
    } else {
        result.points.push_back({1, "", {}});
    }
    std::ifstream text(file);
    const toml::table parsed = toml::parse(text, file.string());
    if (const auto invariants = root.table("invariants")) {
        for (const auto& [key, value] : *parsed["invariants"].as_table()) {
            result.invariants[std::string(key.str())] =
                allowed_in(*invariants, std::string(key.str()));
        }
    }
    if (result.invariants.empty()) {
        throw InputError(file, "name in [invariants] what must hold, with the limit of each");
    }
    return result;
}

std::vector<HardCase> read_corpus(const fs::path& folder) {
    std::vector<HardCase> corpus;
    for (const std::string& section : sections()) {
        std::vector<fs::path> files;
        if (!fs::is_directory(folder / section)) continue;
        for (const auto& entry : fs::directory_iterator(folder / section)) {
            if (entry.path().extension() == ".toml") files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) corpus.push_back(read_case(file));
    }
    return corpus;
}

namespace {

// Like read_toml does with a setting: a number if possible, else a word.
void set(toml::table& root, const std::string& setting) {
    const std::size_t equals = setting.find('=');
    std::vector<std::string> names;
    std::istringstream keys(setting.substr(0, equals));
    for (std::string key; std::getline(keys, key, '.');) names.push_back(key);
    toml::table parsed;
    const std::string value = setting.substr(equals + 1);
    try {
        parsed = toml::parse("value = " + value);
    } catch (const toml::parse_error&) {
        parsed.insert_or_assign("value", value);
    }
    toml::node* at = &root;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool last = i + 1 == names.size();
        if (toml::array* list = at->as_array()) {
            const std::size_t index = std::stoul(names[i]);
            if (last) {
                list->erase(list->begin() + static_cast<std::ptrdiff_t>(index));
                list->insert(list->begin() + static_cast<std::ptrdiff_t>(index),
                             *parsed.get("value"));
            } else {
                at = list->get(index);
            }
        } else if (last) {
            at->as_table()->insert_or_assign(names[i], *parsed.get("value"));
        } else {
            at = &at->as_table()->insert(names[i], toml::table{}).first->second;
        }
    }
}

}  // namespace

std::string scene_text(const HardCase& hard_case, const HardPoint& point, const std::string& mesh) {
    std::ifstream text(hard_case.file);
    toml::table root = toml::parse(text, hard_case.file.string());
    for (const std::string& setting : point.overrides) {
        if (setting.starts_with("scene.")) set(root, setting);
    }
    toml::table* scene = root["scene"].as_table();
    if (scene == nullptr) throw InputError(hard_case.file, "a case of this kind needs a [scene]");
    scene->insert_or_assign("mesh", mesh);
    std::ostringstream out;
    out << *scene << '\n';
    return out.str();
}

}  // namespace culet::hard
