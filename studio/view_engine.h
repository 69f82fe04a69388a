#pragma once
// The engine of the page in which the stone turns (viewer/engine), as the program runs it.

#include <sys/types.h>
#include <filesystem>
#include <mutex>
#include <string>

namespace culet {

/// In a process of its own, which keeps what was opened from call to call.
class ViewEngine {
public:
    /// Files are read within `folder` only. `quiet` as in run_apart.
    ViewEngine(std::string version, std::filesystem::path folder, std::mutex& quiet);
    ~ViewEngine();
    ViewEngine(const ViewEngine&) = delete;
    ViewEngine& operator=(const ViewEngine&) = delete;

    struct Reply {
        enum class How { done, refused, died } how = How::done;
        std::string text;  ///< a line of JSON and the picture's bytes; else one line for people
    };
    /// From any thread. `request`: a line of JSON, {"call", "arguments"} of docs/viewer.md, and
    /// what is attached. After `died` the next call begins anew, with nothing opened.
    Reply answer(const std::string& request);

private:
    void start();
    void end();

    std::string version_;
    std::filesystem::path folder_;
    std::mutex& quiet_;
    std::mutex mutex_;  // one call at a time
    pid_t process_ = 0;
    int socket_ = -1;
};

}  // namespace culet
