#include "studio/project.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "stone/text/errors.h"
#include "stone/text/path_fence.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

fs::path readings_of(const fs::path& stone_file) {
    path_within(stone_file.parent_path(), stone_file.filename());
    const PathFence fence(stone_file.parent_path());
    const auto stone = read_toml(stone_file).table("stone");
    if (!stone) throw InputError(stone_file, "there is no [stone] table");
    const auto readings = stone->path("readings");
    if (!readings) {
        throw InputError(stone_file,
                         "names no table of readings: below [stone] write readings = "
                         "\"readings.csv\", a file that begins with kind,of,value,sigma");
    }
    return *readings;
}

}  // namespace

Project::Project(const fs::path& stone_file)
    : stone_file_(fs::canonical(stone_file)), readings_(readings_of(stone_file_)) {
    load();
}

void Project::load() {
    const PathFence fence(stone_file_.parent_path());
    stamps_ = stamps();
    auto next = std::make_shared<LoadedStone>();
    next->file = read_stone(stone_file_);
    next->options = read_fit_options(stone_file_);
    next->readings = readings_.path();
    loaded_ = std::move(next);
    known_facets_.clear();
    stamps_ = stamps();
    ++shape_;
    check();
}

// A copy, since a fit may be at work on the last one.
void Project::check() {
    const PathFence fence(stone_file_.parent_path());
    ++revision_;
    table_ = std::make_unique<ReadingsTable>(readings_.path(), readings_.text());
    auto next = std::make_shared<LoadedStone>(*loaded_);
    problems_.clear();
    doubts_.clear();
    try {
        next->written = read_readings(stone_file_, problems_);
        bound_ = bind_by_row(next->written, next->file.stone, problems_);
        doubts_ = first_check(next->file.stone, bound_,
                              next->options.prior.source == Prior::Source::catalogue);
    } catch (const InputError& error) {
        problems_.push_back({0, error.what()});
        next->written.clear();
        bound_.clear();
    }
    loaded_ = std::move(next);
    facets_.assign(table_->rows().size(), {});
    for (const WrittenReading& written : loaded_->written) {
        if (written.file != readings_.path()) continue;
        for (std::size_t r = 0; r < facets_.size(); ++r) {
            if (table_->rows()[r].line == written.line) facets_[r] = facets_of(written);
        }
    }
}

std::vector<std::string> Project::facets_of(const WrittenReading& written) {
    const std::string key =
        fmt::format("{} {} {}", written.kind, fmt::join(written.of, "/"), written.side);
    if (const auto known = known_facets_.find(key); known != known_facets_.end())
        return known->second;
    std::vector<std::string> names;
    const Solid& solid = loaded_->file.stone.solid;
    // A row that was not read yet has the facets that it would have with a value: one that every
    // angle and length may have.
    WrittenReading row = written;
    row.skipped = row.exact = row.released = false;
    row.value_unit = row.sigma_unit = row.rounding_unit = {};
    row.rounding.reset();
    row.value = 45;
    row.sigma = 1;
    if (const auto kind = reading_kind(row.kind); kind && is_relation(*kind)) row.value.reset();
    try {
        for (const Reading& reading : bind_readings({row}, loaded_->file.stone)) {
            for (const int f : reading.facets) names.push_back(solid.facets[std::size_t(f)].name);
            for (const Place& place : reading.places) {
                if (place.facet >= 0) names.push_back(solid.facets[std::size_t(place.facet)].name);
            }
        }
    } catch (const InputError&) {
        names.clear();  // its problem is told where the row is bound
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return known_facets_[key] = names;
}

std::pair<fs::file_time_type, fs::file_time_type> Project::stamps() const {
    std::error_code ignored;
    const fs::path mesh = loaded_ ? loaded_->file.mesh_file : fs::path();
    return {fs::last_write_time(stone_file_, ignored), fs::last_write_time(mesh, ignored)};
}

bool Project::stone_changed() {
    if (stamps() == stamps_) return false;
    load();
    return true;
}

void Project::edit(const std::vector<ReadingsTable::Edit>& edits) {
    const std::size_t before = table_->rows().size();
    readings_.save(table_->edited(edits));
    check();
    if (table_->rows().size() != before) ++shape_;
}

void Project::remove_row(std::size_t row) {
    readings_.save(table_->without_row(row));
    ++shape_;
    check();
}

void Project::undo() {
    readings_.undo();
    ++shape_;
    check();
}

void Project::redo() {
    readings_.redo();
    ++shape_;
    check();
}

void Project::settle(bool take_other) {
    take_other ? readings_.take_other() : readings_.keep_own();
    ++shape_;
    check();
}

}  // namespace culet
