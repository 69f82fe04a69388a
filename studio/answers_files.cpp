// The answers of the other screens: the stone that turns, the bench, and files to be saved.

#include <algorithm>
#include <cmath>

#include "stone/text/errors.h"
#include "studio/answers.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"
#include "viewer/engine_file.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Answer Answers::view() {
    std::unique_lock lock(mutex_);
    if (!project_) return {404, "text/plain", "No stone is open.\n"};
    // Compressed once here, not in each copy.
    engine_for_pages();
    const auto work = [loaded = project_->loaded(), fitted = fitted_,
                       version = version_](const Progress&) {
        return page_of_stone(*loaded, fitted.solid, fitted.report, version);
    };
    lock.unlock();
    const WorkEnd end = run_apart(work, mutex_, {});
    if (end.how == WorkEnd::How::done) return {200, "text/html; charset=utf-8", end.text};
    return {400, "text/plain; charset=utf-8", end.text + "\n"};
}

Answer Answers::engine(const Call& call) {
    std::unique_lock lock(mutex_);
    if (!project_) return {404, "application/json", R"({"trouble":"no stone is open"})"};
    // Windows that listen are few, and their engine ends with them.
    const std::vector<std::string> windows = events_.windows();
    if (std::find(windows.begin(), windows.end(), call.window) == windows.end())
        return {400, "application/json", R"({"trouble":"no window of this studio asks this"})"};
    if (!engines_.contains(call.window)) {
        engines_[call.window] = std::make_shared<ViewEngine>(
            version_, project_->loaded()->file.mesh_file.parent_path(), mutex_);
    }
    const std::shared_ptr<ViewEngine> engine = engines_[call.window];
    lock.unlock();
    ViewEngine::Reply reply = engine->answer(call.body);
    if (reply.how == ViewEngine::Reply::How::done)
        return {200, "application/octet-stream", std::move(reply.text)};
    const Json json{{"trouble", reply.text}, {"died", reply.how == ViewEngine::Reply::How::died}};
    return {400, "application/json", text_of(json)};
}

// In a process of its own: a mesh from anybody decides how hard that is.
std::string Answers::bench(std::unique_lock<std::mutex>& lock) {
    if (!project_) throw InputError("no stone is open: begin with one");
    const auto work = [loaded = project_->loaded(), fitted = fitted_, opened = opened_,
                       file = marks_file(project_->stone_file())](const Progress&) {
        return bench_json(*loaded, fitted, file, opened);
    };
    lock.unlock();
    const WorkEnd end = run_apart(work, mutex_, {});
    lock.lock();
    if (end.how != WorkEnd::How::done) throw InputError(end.text);
    return end.text;
}

std::string Answers::post_mark(const Call& call) {
    const Json body = Json::parse(call.body);
    require_opened(body.at("opened").get<int>());
    mark(marks_file(project_->stone_file()), body.at("step").get<std::size_t>(),
         body.at("tier").get<std::string>(), body.at("done").get<bool>());
    look_at_marks();
    return "{}";
}

void Answers::require_opened(int opened) const {
    if (opened != opened_)
        throw InputError("another stone was opened in another window: look again");
}

// Tells the windows of marks that were changed, here or by another program.
void Answers::look_at_marks() {
    std::set<std::string> marks;
    try {
        marks = marks_in(marks_file(project_->stone_file()));
    } catch (const InputError&) {
        return;  // the bench says what is wrong
    }
    if (marks == marks_) return;
    marks_ = std::move(marks);
    events_.send("bench", "{}");
}

void Answers::make_file(const Call& call) {
    const Json body = Json::parse(call.body);
    const auto kind = body.at("kind").get<std::string>();
    require_opened(body.at("opened").get<int>());
    if (made_.runs) throw InputError("another file is being made: wait for it, or stop it");
    made_ = {made_.number + 1};
    made_.runs = true;
    made_.by = call.window;
    Job job{"file", call.window, {}, {}, {}};
    job.work = [loaded = project_->loaded(), fitted = fitted_, version = version_,
                kind](const Progress& progress) {
        return exported_file(*loaded, fitted, kind, version, progress);
    };
    job.progress = [this](double fraction) {
        const std::lock_guard lock(mutex_);
        made_.fraction = std::isfinite(fraction) ? fraction : 0;
        events_.send("file", made_json());
    };
    job.ended = [this, number = made_.number](const WorkEnd& end) {
        const std::lock_guard lock(mutex_);
        if (number == made_.number && made_.runs) file_ended(end);
    };
    files_.add(std::move(job));
    events_.send("file", made_json());
}

void Answers::file_ended(const WorkEnd& end) {
    made_.runs = false;
    if (end.how == WorkEnd::How::done) {
        const std::size_t line = end.text.find('\n');
        const Json head = Json::parse(end.text.substr(0, line));
        made_.file = head.at("file").get<std::string>();
        made_.notes = text_of(head.at("notes"));
        made_.bytes = end.text.substr(line + 1);
    } else {
        made_.trouble = end.how == WorkEnd::How::failed ? end.text : "stopped";
    }
    events_.send("file", made_json());
}

std::string Answers::made_json() const {
    Json json{{"number", made_.number},     {"runs", made_.runs},
              {"fraction", made_.fraction}, {"by", made_.by},
              {"file", made_.file},         {"size", made_.bytes.size()},
              {"trouble", made_.trouble},   {"notes", Json::parse(made_.notes)}};
    json["opened"] = opened_;
    return text_of(json);
}

Answer Answers::made_file() const {
    if (made_.file.empty()) throw InputError("no file was made yet: choose one");
    return {200, "application/octet-stream", made_.bytes, made_.file};
}

}  // namespace culet
