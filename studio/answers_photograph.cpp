// The answers of the photograph's screen.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <utility>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/path_fence.h"
#include "studio/answers.h"
#include "studio/json_text.h"
#include "studio/new_project.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* const k_job = "photograph";

// A name that is free, or that holds this very picture. Nothing is overwritten.
fs::path free_name(const fs::path& folder, const std::string& name, const std::string& bytes) {
    const fs::path given(name);
    std::error_code ignored;
    for (int n = 1; n < 1000; ++n) {
        const std::string stem = given.stem().string() + (n == 1 ? "" : "-" + std::to_string(n));
        const fs::path file = folder / (stem + given.extension().string());
        const fs::file_status status = fs::symlink_status(file, ignored);
        if (!fs::exists(status)) return file;
        if (fs::is_regular_file(status) && fs::file_size(file, ignored) == bytes.size() &&
            read_text(file) == bytes)
            return file;
    }
    throw InputError(folder, "has no room for another photograph " + name);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

}  // namespace

Answer Answers::photograph(const Call& call, std::unique_lock<std::mutex>& lock) {
    if (!project_) throw InputError("no stone is open: begin with one");
    const std::string what = call.path.substr(std::string_view("/api/photograph").size());
    if (!call.posts && what == "/photo.png" && !photo_.png.empty())
        return {200, "image/png", photo_.png};
    if (!call.posts && what == "/report")
        return {200, "application/json",
                text_of(Json{{"step", photo_.step}, {"html", photo_.html}})};
    if (call.posts && (what == "/upload" || what == "/open")) {
        take_photograph(call, lock);
    } else if (call.posts && what == "/cancel") {
        photographs_.cancel(k_job);
    } else if (call.posts && (what == "/lay" || what == "/look")) {
        const Json body = Json::parse(call.body);
        require_opened(body.at("opened").get<int>());
        if (photo_.ask.file.empty()) throw InputError("there is no photograph yet: choose one");
        if (what == "/lay") {
            photo_.ask.view = text_of(body.at("view"));
            photo_.ask.placed = body.at("placed").get<bool>();
            photo_.ask.by_hand = body.at("by_hand").get<bool>();
            photo_.ask.light = body.at("light").get<std::string>();
        }
        work_on_photograph(what == "/lay" ? "laying"
                           : photo_.found ? "open"
                                          : "nearby",
                           call.window);
    } else if (call.posts || !what.empty()) {
        throw InputError("there is no such page");
    }
    return {200, "application/json", photograph_json(lock)};
}

std::string Answers::photograph_json(std::unique_lock<std::mutex>& lock) const {
    const auto work = [folder = project_->stone_file().parent_path()](const Progress&) {
        return photographs_json(folder);
    };
    lock.unlock();
    const WorkEnd end = run_apart(work, mutex_, {});
    lock.lock();
    if (end.how != WorkEnd::How::done) throw InputError(end.text);
    Json json = Json::parse(end.text);
    const auto parsed = [](const std::string& text) {
        return text.empty() ? Json() : Json::parse(text);
    };
    json.update({{"opened", opened_},
                 {"step", photo_.step},
                 {"file", photo_.ask.file.filename().string()},
                 {"about", parsed(photo_.about)},
                 {"wire", parsed(photo_.wire)},
                 {"view", parsed(photo_.ask.view)},
                 {"light", photo_.ask.light},
                 {"placed", photo_.ask.placed},
                 {"by_hand", photo_.ask.by_hand},
                 {"found", photo_.found},
                 {"card_html", photo_.card_html},
                 {"notes", parsed(photo_.notes)},
                 {"phase", photo_.phase},
                 {"fraction", photo_.fraction},
                 {"by", photo_.by},
                 {"can_look", !fitted_.report.empty()},
                 {"stale", photo_.found && photo_.fit_revision != fit_revision_}});
    if (!photo_.trouble.empty()) json["trouble"] = photo_.trouble;
    return text_of(json);
}

// An uploaded one is decoded from a file with no name yet, which gets its name when it is good.
void Answers::take_photograph(const Call& call, std::unique_lock<std::mutex>& lock) {
    const bool uploads = call.path.ends_with("/upload");
    const fs::path folder = project_->stone_file().parent_path();
    ShownPhotograph next;
    next.ask.loaded = project_->loaded();
    next.ask.fitted = fitted_;
    next.ask.folder = folder;
    next.ask.version = version_;
    std::unique_ptr<OutputFile> unnamed;
    if (uploads) {
        if (++uploads_ > k_most_uploads)
            throw InputError("this is too much for one sitting: start the studio again");
        next.ask.file = free_name(folder, plain_name(call.name), call.body);
    } else {
        const auto name = Json::parse(call.body).at("file").get<std::string>();
        require_opened(Json::parse(call.body).at("opened").get<int>());
        next.ask.file = path_within(folder, name);
    }
    PhotographAsk reads = next.ask;
    if (uploads) {
        unnamed = std::make_unique<OutputFile>(next.ask.file);
        reads.file = unnamed->path();
        std::ofstream(reads.file, std::ios::binary) << call.body;
    }
    photographs_.cancel(k_job);
    const int opened = opened_;
    lock.unlock();
    constexpr auto k_longest = std::chrono::minutes(1);
    const auto until = std::chrono::steady_clock::now() + k_longest;
    const WorkEnd end = run_apart([&](const Progress&) { return opened_photograph(reads); }, mutex_,
                                  [&](double) { return std::chrono::steady_clock::now() < until; });
    lock.lock();
    if (end.how == WorkEnd::How::stopped) throw InputError("this takes longer than a minute");
    if (end.how == WorkEnd::How::failed)
        throw InputError(
            replaced(end.text, reads.file.string(), next.ask.file.filename().string()));
    require_opened(opened);
    if (unnamed) unnamed->commit();
    const std::size_t line = end.text.find('\n');
    Json about = Json::parse(end.text.substr(0, line));
    next.png = end.text.substr(line + 1);
    next.ask.view = text_of(about.at("view"));
    next.ask.light = about.at("light").get<std::string>();
    next.wire = text_of(about.at("wire"));
    about.erase("wire");
    next.about = text_of(about);
    next.step = photo_.step;
    photo_ = std::move(next);
    work_on_photograph("laying", call.window);
}

void Answers::work_on_photograph(const std::string& phase, const std::string& window) {
    photo_.ask.loaded = project_->loaded();
    photo_.ask.fitted = fitted_;
    photo_.phase = phase;
    photo_.by = window;
    photo_.trouble.clear();
    photo_.fraction = 0;
    if (phase == "laying") {
        photo_.found = photo_.sure = false;
        photo_.card_html.clear();
        photo_.html.clear();
        photo_.notes = "[]";
        photo_.fit_revision = fit_revision_;
    }
    photograph_changed();
    Job job{k_job, window, {}, {}, {}};
    job.work = [ask = photo_.ask, phase](const Progress& progress) {
        if (phase == "laying") return laid_photograph(ask, progress);
        return compared_photograph(ask,
                                   phase == "quick"    ? PhotographLook::quick
                                   : phase == "nearby" ? PhotographLook::nearby
                                                       : PhotographLook::open,
                                   progress);
    };
    job.progress = [this, step = photo_.step](double fraction) {
        const std::lock_guard lock(mutex_);
        if (step != photo_.step) return;
        photo_.fraction = std::isfinite(fraction) ? fraction : 0;
        events_.send("photograph", text_of(Json{{"step", step}, {"fraction", photo_.fraction}}));
    };
    job.ended = [this, step = photo_.step](const WorkEnd& end) {
        const std::lock_guard lock(mutex_);
        if (project_ && step == photo_.step) photograph_ended(end);
    };
    photographs_.add(std::move(job));
}

// What was found is shown at once, and looked at further.
void Answers::photograph_ended(const WorkEnd& end) {
    const std::string phase = std::exchange(photo_.phase, "");
    if (end.how != WorkEnd::How::done) {
        photo_.trouble = end.how == WorkEnd::How::failed ? end.text : "stopped";
        return photograph_changed();
    }
    const Json json = Json::parse(end.text);
    if (json.contains("view")) photo_.ask.view = text_of(json.at("view"));
    if (phase != "laying") {
        photo_.html = json.at("html").get<std::string>();
        photo_.notes = text_of(json.at("notes"));
        if (phase == "quick" && !photo_.sure) return work_on_photograph("nearby", photo_.by);
        return photograph_changed();
    }
    photo_.found = json.at("found").get<bool>();
    photo_.sure = json.at("sure").get<bool>() || photo_.ask.by_hand;
    photo_.wire = text_of(json.at("wire"));
    photo_.card_html = json.at("card_html").get<std::string>();
    if (!photo_.found) return photograph_changed();
    photo_.ask.placed = false;
    work_on_photograph("quick", photo_.by);
}

void Answers::photograph_changed() {
    ++photo_.step;
    events_.send("photograph", text_of(Json{{"step", photo_.step}, {"fraction", photo_.fraction}}));
}

}  // namespace culet
