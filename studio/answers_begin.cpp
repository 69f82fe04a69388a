// The answers of the begin screen.

#include <algorithm>
#include <chrono>

#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "studio/answers.h"
#include "studio/described_stone.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"
#include "studio/new_project.h"
#include "studio/sample_stones.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

// Files come from anybody: what they do to their readers, they do in a process of its own first.
std::string Answers::open_tried(const std::function<fs::path()>& made, const std::string& window,
                                std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    const auto work = [&](const Progress&) {
        const fs::path stone_file = made();
        const Project trial(stone_file);
        return stone_file.string();
    };
    constexpr auto k_longest = std::chrono::minutes(1);
    const auto until = std::chrono::steady_clock::now() + k_longest;
    const WorkEnd end =
        run_apart(work, mutex_, [&](double) { return std::chrono::steady_clock::now() < until; });
    lock.lock();
    if (end.how == WorkEnd::How::stopped) throw InputError("this takes longer than a minute");
    if (end.how == WorkEnd::How::failed) throw InputError(end.text);
    return open(end.text, window);
}

std::string Answers::begin(const Call& call, std::unique_lock<std::mutex>& lock) {
    if (call.path == "/api/begin/upload") {
        if (++uploads_ > k_most_uploads)
            throw InputError("this is too much for one sitting: start the studio again");
        return open_tried([&] { return project_of_file(folder_, call.name, call.body); },
                          call.window, lock);
    }
    const Json body = Json::parse(call.body.empty() ? "{}" : call.body);
    const auto kind = [&] { return body.at("kind").get<std::string>(); };
    const auto values = [&] { return body.at("values").get<std::map<std::string, double>>(); };
    if (call.path == "/api/begin/preview") return plain_drawings(make_cut(kind(), values()));
    if (call.path == "/api/begin/words") {
        const DescribedStone stone = described_stone(body.at("text").get<std::string>());
        return text_of(Json{{"kind", stone.kind},
                            {"values", stone.values},
                            {"material", stone.material},
                            {"notes", stone.notes}});
    }
    if (call.path == "/api/begin/sample")
        return open(project_of_sample(folder_, body.at("name").get<std::string>()), call.window);
    if (call.path == "/api/begin/cut") {
        return open(
            project_of_cut(folder_, kind(), values(), body.at("material").get<std::string>()),
            call.window);
    }
    if (call.path == "/api/begin/open") {
        // One of a list of this program: no page names a path.
        const std::vector<fs::path> list =
            body.at("recent").get<bool>() ? recent_projects() : stone_files_in(folder_);
        const auto file = std::find_if(list.begin(), list.end(), [&](const fs::path& one) {
            return one.string() == body.at("file").get<std::string>();
        });
        if (file == list.end()) throw InputError("this stone is no longer there");
        return open_tried([&] { return *file; }, call.window, lock);
    }
    if (call.path != "/api/begin/leave") throw NoSuchCall();
    jobs_.cancel("fit");
    files_.cancel("file");
    photographs_.cancel("photograph");
    forget_cuts();
    project_.reset();
    ++opened_;
    events_.send("opened", state());
    return state();
}

}  // namespace culet
