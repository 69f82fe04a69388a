#pragma once
// Long work, one at a time, in the order in which it was asked for.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "studio/apart.h"

namespace culet {

struct Job {
    std::string name;   ///< `fit`; a newer job of a name replaces older ones
    std::string owner;  ///< the window that asked
    std::function<std::string(const Progress&)> work;  ///< runs apart (apart.h)
    std::function<void(double)> progress;              ///< in the queue's thread, when it changes
    std::function<void(const WorkEnd&)> ended;         ///< in the queue's thread; not if replaced
};

class JobQueue {
public:
    /// `quiet` as in run_apart.
    explicit JobQueue(std::mutex& quiet);
    /// Stops what runs.
    ~JobQueue();
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;

    void add(Job job);
    /// Jobs of this name, or all of them that this window asked for; they end as stopped.
    void cancel(const std::string& name);
    void cancel_of(const std::string& owner);

private:
    struct Entry {
        Job job;
        std::atomic<bool> cancelled{false}, replaced{false};
    };
    void work();
    template <class Which>
    void cancel_those(const Which& which);

    std::mutex& quiet_;
    std::mutex mutex_;
    std::condition_variable news_;
    std::deque<std::shared_ptr<Entry>> waiting_;  // the first one runs
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace culet
