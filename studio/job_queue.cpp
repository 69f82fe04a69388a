#include "studio/job_queue.h"

#include <memory>

namespace culet {

JobQueue::JobQueue(std::mutex& quiet) : quiet_(quiet), thread_([this] { work(); }) {}

JobQueue::~JobQueue() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        for (const auto& entry : waiting_) entry->cancelled = entry->replaced = true;
    }
    news_.notify_all();
    thread_.join();
}

void JobQueue::add(Job job) {
    const std::lock_guard lock(mutex_);
    for (const auto& entry : waiting_) {
        if (entry->job.name == job.name) entry->cancelled = entry->replaced = true;
    }
    waiting_.push_back(std::make_shared<Entry>());
    waiting_.back()->job = std::move(job);
    news_.notify_all();
}

template <class Which>
void JobQueue::cancel_those(const Which& which) {
    const std::lock_guard lock(mutex_);
    for (const auto& entry : waiting_) {
        if (which(entry->job)) entry->cancelled = true;
    }
}

void JobQueue::cancel(const std::string& name) {
    cancel_those([&](const Job& job) { return job.name == name; });
}

void JobQueue::cancel_of(const std::string& owner) {
    cancel_those([&](const Job& job) { return job.owner == owner; });
}

void JobQueue::work() {
    for (std::unique_lock lock(mutex_);;) {
        news_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
        if (ends_) return;
        const std::shared_ptr<Entry> entry = waiting_.front();
        lock.unlock();
        WorkEnd end{WorkEnd::How::stopped, {}};
        if (!entry->cancelled) {
            double told = 0;
            end = run_apart(entry->job.work, quiet_, [&](double fraction) {
                if (fraction != told && entry->job.progress) entry->job.progress(told = fraction);
                return !entry->cancelled;
            });
        }
        if (!entry->replaced && entry->job.ended) entry->job.ended(end);
        lock.lock();
        waiting_.pop_front();
    }
}

}  // namespace culet
