#include "studio/answers.h"

#include <fmt/format.h>

#include <cmath>

#include "stone/text/errors.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"
#include "studio/new_project.h"
#include "studio/table_json.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_json = "application/json";

}  // namespace

Answers::Answers(const fs::path& input, std::string version) : version_(std::move(version)) {
    std::error_code error;
    const fs::path stone_file = stone_file_for(input);
    const fs::path path = fs::canonical(input, error);
    folder_ = fs::is_directory(path, error) ? path : path.parent_path();
    if (!stone_file.empty()) open(stone_file, {});
}

std::string Answers::state() const {
    Json json{
        {"version", version_}, {"opened", opened_}, {"screen", project_ ? "readings" : "begin"}};
    if (project_) {
        json["name"] = project_->name();
        json["file"] = project_->stone_file().string();
    }
    return text_of(json);
}

std::string Answers::table_json() const {
    if (!project_) throw InputError("no stone is open: begin with one");
    return culet::table_json(*project_, {opened_, outside_, trouble_});
}

Answer Answers::to(const Call& call) {
    std::unique_lock lock(mutex_);
    try {
        if (call.posts && call.path.starts_with("/api/begin/"))
            return {200, k_json, begin(call, lock)};
        if (call.path.starts_with("/api/cut")) return {200, k_json, cut(call, lock)};
        if (call.path.starts_with("/api/photograph")) return photograph(call, lock);
        if (call.posts) return {200, k_json, post(call)};
        if (call.path == "/api/state") return {200, k_json, state()};
        if (call.path == "/api/begin") return {200, k_json, culet::begin_json(folder_)};
        if (call.path == "/api/table") return {200, k_json, table_json()};
        if (call.path == "/api/drawings") return {200, k_json, drawings_};
        if (call.path == "/api/bench") return {200, k_json, bench(lock)};
        if (call.path == "/api/export") return {200, k_json, made_json()};
        if (call.path == "/api/export/file") return made_file();
        if (call.path == "/api/fit") {
            return {200, k_json,
                    fmt::format(R"({{"opened":{},"revision":{},"runs":{},"fit":{}}})", opened_,
                                fit_revision_, fit_runs_, fit_.empty() ? "null" : fit_)};
        }
        throw NoSuchCall();
    } catch (const NoSuchCall&) {
        return {404, k_json, text_of(Json{{"trouble", "there is no such page"}})};
    } catch (const InputError& error) {
        return {400, k_json, text_of(Json{{"trouble", error.what()}})};
    } catch (const Json::exception&) {
        return {400, k_json, text_of(Json{{"trouble", "the call is not as the page makes it"}})};
    } catch (const std::bad_alloc&) {
        return {400, k_json, text_of(Json{{"trouble", "not enough memory for this"}})};
    } catch (const std::exception& error) {
        const std::string what = fmt::format("{} (an error in culet itself)", error.what());
        return {500, k_json, text_of(Json{{"trouble", what}})};
    }
}

std::string Answers::post(const Call& call) {
    if (!project_) throw InputError("no stone is open: begin with one");
    if (call.path == "/api/fit/cancel") {
        jobs_.cancel("fit");
        return "{}";
    }
    if (call.path == "/api/export/cancel") {
        files_.cancel("file");
        return "{}";
    }
    const Json body = Json::parse(call.body.empty() ? "{}" : call.body);
    if (call.path == "/api/settle") {
        project_->settle(body.at("take_other").get<bool>());
        outside_ = false;
        return changed(call.window);
    }
    if (call.path == "/api/bench/mark") return post_mark(call);
    if (call.path == "/api/export/make") {
        make_file(call);
        return made_json();
    }
    // Rows are counted, so that a window must know of all rows that others added or removed.
    if (body.at("opened").get<int>() != opened_ || body.at("shape").get<int>() != project_->shape())
        throw InputError("the table was changed in another window: look again");
    if (call.path == "/api/cells") {
        std::vector<ReadingsTable::Edit> edits;
        for (const Json& cell : body.at("cells")) {
            edits.push_back({cell.at("row").get<std::size_t>(),
                             cell.at("column").get<std::string>(),
                             cell.at("text").get<std::string>()});
        }
        project_->edit(edits);
    } else if (call.path == "/api/remove") {
        project_->remove_row(body.at("row").get<std::size_t>());
    } else if (call.path == "/api/undo") {
        project_->undo();
    } else if (call.path == "/api/redo") {
        project_->redo();
    } else {
        throw NoSuchCall();
    }
    return changed(call.window);
}

// Of the readings: all windows learn of it, and the fit begins anew.
std::string Answers::changed(const std::string& window) {
    ask_for_fit(window);
    events_.send("table", text_of(Json{{"revision", project_->revision()}, {"by", window}}));
    return table_json();
}

std::string Answers::open(const fs::path& stone_file, const std::string& window) {
    project_ = std::make_unique<Project>(stone_file);
    remember_project(project_->stone_file());
    ++opened_;
    outside_ = false;
    trouble_.clear();
    fit_.clear();
    fitted_ = {};
    files_.cancel("file");
    made_ = {made_.number};
    forget_cuts();
    engines_.clear();
    photographs_.cancel("photograph");
    photo_ = {photo_.step + 1};
    fit_revision_ = 0;
    drawings_ = plain_drawings(project_->loaded()->file.stone.solid);
    ask_for_fit(window);
    events_.send("opened", state());
    return state();
}

void Answers::ask_for_fit(const std::string& window) {
    fit_runs_ = !project_->bound().empty();
    if (!fit_runs_) {
        jobs_.cancel("fit");
        fit_.clear();
        fit_revision_ = project_->revision();
        return;
    }
    Job job{"fit", window, {}, {}, {}};
    job.work = [loaded = project_->loaded(), start = fitted_.solid](const Progress& progress) {
        return fit_for_screen(*loaded, start, progress);
    };
    job.progress = [this](double fraction) {
        events_.send("progress", fmt::format(R"({{"fraction":{:.3f}}})",
                                             std::isfinite(fraction) ? fraction : 0));
    };
    job.ended = [this, opened = opened_, revision = project_->revision()](const WorkEnd& end) {
        const std::lock_guard lock(mutex_);
        if (opened == opened_) fit_ended(revision, end);
    };
    jobs_.add(std::move(job));
}

void Answers::fit_ended(int revision, const WorkEnd& end) {
    // A newer one is under way.
    if (!project_ || revision != project_->revision()) return;
    fit_runs_ = false;
    fit_revision_ = revision;
    if (end.how == WorkEnd::How::done) {
        Json fit = Json::parse(end.text);
        fitted_ = {fit.value("solid", fitted_.solid), fit.value("report", fitted_.report)};
        fit.erase("solid");
        fit.erase("report");
        fit_ = text_of(fit);
    } else {
        fit_ = text_of(Json{{"status", end.how == WorkEnd::How::failed ? "failed" : "cancelled"},
                            {"trouble", end.text}});
    }
    events_.send("fit", text_of(Json{{"revision", revision}}));
}

void Answers::window_opened(const std::string& window) {
    const std::lock_guard lock(mutex_);
    if (project_ && !fit_runs_ && fit_revision_ != project_->revision()) ask_for_fit(window);
    if (project_ && fit_.find(R"("status":"cancelled")") != std::string::npos) ask_for_fit(window);
}

void Answers::window_closed(const std::string& window) {
    jobs_.cancel_of(window);
    files_.cancel_of(window);
    photographs_.cancel_of(window);
    const std::vector<std::string> others = events_.windows();
    std::shared_ptr<ViewEngine> ended;  // outside of the lock
    const std::lock_guard lock(mutex_);
    if (const auto engine = engines_.extract(window)) ended = engine.mapped();
    if (project_ && fit_runs_ && !others.empty()) ask_for_fit(others.front());
}

void Answers::look_outside() {
    const std::lock_guard lock(mutex_);
    if (!project_) return;
    look_at_marks();
    const bool outside = project_->readings().changed_outside();
    std::string trouble;
    bool stone_changed = false;
    try {
        stone_changed = project_->stone_changed();
    } catch (const InputError& error) {
        trouble = error.what();
    }
    if (stone_changed) {
        drawings_ = plain_drawings(project_->loaded()->file.stone.solid);
        fitted_ = {};
        ask_for_fit({});
    }
    if (outside == outside_ && trouble == trouble_ && !stone_changed) return;
    outside_ = outside;
    trouble_ = trouble;
    events_.send("table", text_of(Json{{"revision", project_->revision()}, {"by", ""}}));
}

}  // namespace culet
