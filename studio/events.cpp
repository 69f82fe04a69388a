#include "studio/events.h"

#include <algorithm>

namespace culet {

void Events::send(const std::string& name, const std::string& data) {
    const std::lock_guard lock(mutex_);
    for (const auto& window : windows_) window->waiting[name] = data;
    news_.notify_all();
}

std::shared_ptr<Events::Window> Events::open(const std::string& id) {
    const std::lock_guard lock(mutex_);
    if (stopped_ || windows_.size() >= k_most_windows) return nullptr;
    windows_.push_back(std::make_shared<Window>(Window{id, {}}));
    return windows_.back();
}

void Events::close(const std::shared_ptr<Window>& window) {
    const std::lock_guard lock(mutex_);
    std::erase(windows_, window);
}

std::vector<std::string> Events::windows() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> ids;
    for (const auto& window : windows_) ids.push_back(window->id);
    return ids;
}

std::optional<std::pair<std::string, std::string>> Events::next(Window& window,
                                                                std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, wait, [&] { return stopped_ || !window.waiting.empty(); });
    if (window.waiting.empty()) return std::nullopt;
    auto first = window.waiting.extract(window.waiting.begin());
    return std::pair{std::move(first.key()), std::move(first.mapped())};
}

void Events::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    news_.notify_all();
}

bool Events::stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
}

}  // namespace culet
