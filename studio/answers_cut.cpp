// The answers of the cut screen.

#include <algorithm>
#include <cmath>

#include "stone/material/material.h"
#include "stone/text/errors.h"
#include "studio/answers.h"
#include "studio/json_text.h"
#include "studio/new_project.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_most_cuts = 500;  // half a megabyte each at most, of usual stones far less

}  // namespace

std::string Answers::cut(const Call& call, std::unique_lock<std::mutex>& lock) {
    if (!project_) throw InputError("no stone is open: begin with one");
    if (call.path == "/api/cut/stop") {
        files_.cancel("cut");  // its end tells the windows
        return "{}";
    }
    // The stone as it is now, unless something was tried on it already.
    const bool fresh = cuts_.list.size() <= 1 && cuts_.ground.fitted.solid != fitted_.solid;
    if (cuts_.list.empty() || fresh || call.path == "/api/cut/restart") {
        const CutGround ground{project_->loaded(), fitted_};
        const TriedCut first = tried_apart([&] { return first_cut(ground); }, lock);
        forget_cuts();
        cuts_.ground = ground;
        cuts_.list.push_back(first);
    }
    if (!call.posts || call.path == "/api/cut/restart") return cut_json();
    const Json body = Json::parse(call.body);
    require_opened(body.at("opened").get<int>());
    if (body.at("at").get<std::size_t>() != cuts_.at)
        throw InputError("the cut was changed in another window: look again");
    const auto turned = [&] {
        return tried_apart(
            [ground = cuts_.ground, solid = cuts_.list[cuts_.at].solid,
             tier = body.at("tier").get<std::size_t>(), value = body.at("value").get<double>()] {
                return changed_cut(ground, solid, tier, value);
            },
            lock);
    };
    if (call.path == "/api/cut/preview") return turned().shown;
    if (call.path == "/api/cut/keep") return keep_cut(call, lock);
    if (call.path == "/api/cut/change") {
        add_cut(turned());
    } else if (call.path == "/api/cut/undo") {
        stop_cut_job();
        cuts_.at -= cuts_.at > 0 ? 1 : 0;
    } else if (call.path == "/api/cut/redo") {
        stop_cut_job();
        cuts_.at += cuts_.at + 1 < cuts_.list.size() ? 1 : 0;
    } else {
        cut_job(call, body);
    }
    events_.send("cut", Json{{"by", call.window}}.dump());
    return cut_json();
}

// In a process of its own, as with all that a file decides the cost of.
TriedCut Answers::tried_apart(const std::function<TriedCut()>& made,
                              std::unique_lock<std::mutex>& lock) {
    const int opened = opened_;
    const std::size_t at = cuts_.at;
    lock.unlock();
    const WorkEnd end = run_apart([&](const Progress&) { return text_of(made()); }, mutex_, {});
    lock.lock();
    if (end.how != WorkEnd::How::done) throw InputError(end.text);
    if (opened != opened_ || at != cuts_.at)
        throw InputError("the cut was changed in another window: look again");
    return tried_cut_in(end.text);
}

void Answers::add_cut(TriedCut cut) {
    stop_cut_job();
    cuts_.list.resize(cuts_.at + 1);
    if (cuts_.list.size() >= k_most_cuts)
        throw InputError("too many cuts were tried: keep this one, or begin again");
    cuts_.list.push_back(std::move(cut));
    cuts_.at = cuts_.list.size() - 1;
}

void Answers::stop_cut_job() {
    files_.cancel("cut");
    cuts_.runs.clear();
    ++cuts_.job;
}

void Answers::forget_cuts() {
    stop_cut_job();
    const int job = cuts_.job;
    cuts_ = {};
    cuts_.job = job;
}

void Answers::cut_job(const Call& call, const Json& body) {
    const bool grades = call.path == "/api/cut/grade";
    if (!grades && call.path != "/api/cut/optimise") throw NoSuchCall();
    if (!cuts_.runs.empty()) throw InputError("the last one still runs: wait for it, or stop it");
    Job job{"cut", call.window, {}, {}, {}};
    if (grades) {
        job.work = [ground = cuts_.ground, first = cuts_.list.front(), cut = cuts_.list[cuts_.at],
                    version = version_](const Progress& progress) {
            return grade_of_cut(ground, first, cut, version, progress);
        };
    } else {
        CutWishes wishes{body.at("objective").get<std::string>(), body.at("recut").get<bool>(),
                         body.at("most_loss").get<double>() / 100};
        // A recut lies in the stone that is there, not in one that was tried.
        const TriedCut& from = wishes.recut ? cuts_.list.front() : cuts_.list[cuts_.at];
        job.work = [ground = cuts_.ground, solid = from.solid, wishes](const Progress& progress) {
            return text_of(optimised_cut(ground, solid, wishes, progress));
        };
    }
    job.progress = [this](double fraction) {
        const std::lock_guard lock(mutex_);
        cuts_.fraction = std::isfinite(fraction) ? fraction : 0;
        events_.send("cut-progress", Json{{"fraction", cuts_.fraction}}.dump());
    };
    job.ended = [this, number = ++cuts_.job](const WorkEnd& end) {
        const std::lock_guard lock(mutex_);
        if (number == cuts_.job) cut_ended(end);
    };
    cuts_.runs = grades ? "grade" : "optimise";
    cuts_.fraction = 0;
    cuts_.trouble.clear();
    files_.add(std::move(job));
}

void Answers::cut_ended(const WorkEnd& end) {
    const bool graded = cuts_.runs == "grade";
    cuts_.runs.clear();
    if (end.how != WorkEnd::How::done) {
        cuts_.trouble = end.how == WorkEnd::How::failed ? end.text : "stopped";
    } else if (graded) {
        cuts_.page = end.text;
        cuts_.paged = cuts_.at;
        cuts_.graded_job = cuts_.job;
    } else {
        add_cut(tried_cut_in(end.text));
    }
    events_.send("cut", R"({"by":""})");
}

std::string Answers::cut_json() const {
    const bool last = cuts_.at + 1 == cuts_.list.size();
    Json json{{"opened", opened_},
              {"at", cuts_.at},
              {"start", Json::parse(cuts_.list.front().shown)},
              {"now", Json::parse(cuts_.list[cuts_.at].shown)},
              {"undo", cuts_.at > 0 ? cuts_.list[cuts_.at].done : ""},
              {"redo", last ? "" : cuts_.list[cuts_.at + 1].done},
              {"runs", cuts_.runs},
              {"fraction", cuts_.fraction},
              {"trouble", cuts_.trouble},
              {"graded_job", cuts_.graded_job},
              {"graded", !cuts_.page.empty() && cuts_.paged == cuts_.at},
              {"stale", cuts_.ground.fitted.solid != fitted_.solid}};
    json["start"].erase("drawings");
    return text_of(json);
}

Answer Answers::grade_page() {
    const std::lock_guard lock(mutex_);
    if (cuts_.page.empty()) return {404, "text/plain", "Nothing was graded yet.\n"};
    return {200, "text/html; charset=utf-8", cuts_.page};
}

// The stone that was measured stays as it is: the new cut becomes a stone of its own beside it.
std::string Answers::keep_cut(const Call& call, std::unique_lock<std::mutex>& lock) {
    const LoadedStone& loaded = *project_->loaded();
    std::string material = loaded.file.has_material ? loaded.file.stone.material.id : "";
    const std::vector<std::string> known = catalogue_names();
    if (std::find(known.begin(), known.end(), material) == known.end()) material.clear();
    return open_tried(
        [folder = folder_, solid = cuts_.list[cuts_.at].solid, material,
         name =
             plain_name(project_->stone_file().parent_path().filename().string() + "-recut.obj")] {
            return project_of_file(folder, name, solid, material);
        },
        call.window, lock);
}

}  // namespace culet
