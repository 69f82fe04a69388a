#pragma once
// The studio's answers to its page, without the network.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>

#include "studio/bench_work.h"
#include "studio/cut_work.h"
#include "studio/events.h"
#include "studio/job_queue.h"
#include "studio/photograph_work.h"
#include "studio/project.h"
#include "studio/view_engine.h"

namespace culet {

struct Call {
    bool posts = false;  ///< POST; otherwise GET
    std::string path, body;
    std::string window;  ///< id of the window that asks
    std::string name;    ///< of an uploaded file
};

struct Answer {
    int status = 200;
    std::string type, body;
    std::string file = {};  ///< what the browser is to save it as; empty: nothing to save
};

/// A file that was made for a window to save, or that is being made.
struct MadeFile {
    int number = 0;  ///< counts them
    bool runs = false;
    double fraction = 0;
    std::string by = {}, file = {}, trouble = {};  ///< `by`: the window that asked
    std::string notes = "[]";                      ///< JSON
    std::string bytes = {};
};

/// The cuts that were tried on the stone, in their order.
struct TriedCuts {
    std::vector<TriedCut> list;  ///< empty: none was asked for yet
    std::size_t at = 0;          ///< the one that is shown
    CutGround ground;
    int job = 0;            ///< counts what ran
    std::string runs = {};  ///< optimise, grade; empty: nothing
    double fraction = 0;
    std::string trouble = {};  ///< of what ran last
    std::string page = {};     ///< the grade of the one at `paged`
    std::size_t paged = 0;
    int graded_job = 0;  ///< that made the page
};

/// The photograph that all windows show.
struct ShownPhotograph {
    int step = 0;            ///< changes with everything but `fraction`
    PhotographAsk ask = {};  ///< its file is empty: none is shown
    std::string png = {}, about = {}, wire = {}, card_html = {},
                html = {};  ///< `about`, `wire`: JSON
    std::string notes = "[]";
    std::string phase = {};  ///< of the work under way: laying, quick, nearby, open; empty: none
    std::string by = {}, trouble = {};
    double fraction = 0;
    bool found = false, sure = false;
    int fit_revision = 0;  ///< of the stone that was laid on it
};

/// Thrown for a path that is none of the page's: 404.
struct NoSuchCall {};

class Answers {
public:
    /// `input` as in StudioOptions. Throws InputError.
    Answers(const std::filesystem::path& input, std::string version);

    /// From any thread. What is wrong in a call is an answer with `trouble`, one line for people.
    Answer to(const Call& call);
    /// The stone in the viewer's page. It has scripts inside, and must be shown in a sandbox.
    Answer view();
    /// The grade of the cut that is tried; likewise.
    Answer grade_page();
    /// A picture of the stone that turns, or what else its page asks of the engine.
    Answer engine(const Call& call);
    Events& events() { return events_; }
    /// A window begins to listen, or was closed: what it asked for is cancelled, unless another
    /// window shows it too.
    void window_opened(const std::string& window);
    void window_closed(const std::string& window);
    /// Looks for changes of files by other programs, and tells the windows.
    void look_outside();

private:
    std::string state() const;
    std::string table_json() const;
    std::string changed(const std::string& window);
    std::string post(const Call& call);
    std::string begin(const Call& call, std::unique_lock<std::mutex>& lock);
    std::string open_tried(const std::function<std::filesystem::path()>& made,
                           const std::string& window, std::unique_lock<std::mutex>& lock);
    std::string open(const std::filesystem::path& stone_file, const std::string& window);
    void ask_for_fit(const std::string& window);
    void fit_ended(int revision, const WorkEnd& end);
    // answers_files.cpp
    std::string bench(std::unique_lock<std::mutex>& lock);
    std::string post_mark(const Call& call);
    void make_file(const Call& call);
    void file_ended(const WorkEnd& end);
    std::string made_json() const;
    Answer made_file() const;
    void look_at_marks();
    void require_opened(int opened) const;
    // answers_photograph.cpp
    Answer photograph(const Call& call, std::unique_lock<std::mutex>& lock);
    std::string photograph_json(std::unique_lock<std::mutex>& lock) const;
    void take_photograph(const Call& call, std::unique_lock<std::mutex>& lock);
    void work_on_photograph(const std::string& phase, const std::string& window);
    void photograph_ended(const WorkEnd& end);
    void photograph_changed();

    // answers_cut.cpp
    std::string cut(const Call& call, std::unique_lock<std::mutex>& lock);
    std::string cut_json() const;
    TriedCut tried_apart(const std::function<TriedCut()>& made, std::unique_lock<std::mutex>& lock);
    void add_cut(TriedCut cut);
    void stop_cut_job();
    void forget_cuts();
    void cut_job(const Call& call, const nlohmann::ordered_json& body);
    void cut_ended(const WorkEnd& end);
    std::string keep_cut(const Call& call, std::unique_lock<std::mutex>& lock);

    std::string version_;
    mutable std::mutex mutex_;  // of all below; held while the work of a job is copied (apart.h)
    std::filesystem::path folder_;
    std::unique_ptr<Project> project_;
    int opened_ = 0, uploads_ = 0;  // counts projects
    bool outside_ = false;
    std::string trouble_, fit_, drawings_;  // JSON
    FittedStone fitted_;
    std::set<std::string> marks_;  // as last told
    MadeFile made_;
    TriedCuts cuts_;
    std::map<std::string, std::shared_ptr<ViewEngine>> engines_;  // by window
    ShownPhotograph photo_;
    int fit_revision_ = 0;
    bool fit_runs_ = false;
    Events events_;
    // Last: their threads use the rest. A picture keeps no fit waiting.
    JobQueue jobs_{mutex_}, files_{mutex_}, photographs_{mutex_};
};

/// Most bytes of an uploaded file, and of any other call.
inline constexpr std::size_t k_largest_upload = 64u << 20, k_largest_call = 1u << 20;
inline constexpr int k_most_uploads = 100;  ///< of one run

}  // namespace culet
