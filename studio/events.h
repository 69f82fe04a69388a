#pragma once
// What the windows of the studio are told without asking.

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culet {

/// Of events with one name a window that is slow gets the last alone, so that nothing piles up.
class Events {
public:
    /// A window that listens; its member is the events'.
    struct Window {
        std::string id;
        std::map<std::string, std::string> waiting;
    };

    /// `data` is JSON, on one line.
    void send(const std::string& name, const std::string& data);

    /// Null: too many windows listen, or the studio ends.
    std::shared_ptr<Window> open(const std::string& id);
    void close(const std::shared_ptr<Window>& window);
    /// Ids of the windows that listen.
    std::vector<std::string> windows() const;

    /// Name and data; nothing within `wait`: say that the line still stands.
    std::optional<std::pair<std::string, std::string>> next(Window& window,
                                                            std::chrono::milliseconds wait);
    /// Lets all waiting end, for good.
    void stop();
    bool stopped() const;

private:
    mutable std::mutex mutex_;
    std::condition_variable news_;
    std::vector<std::shared_ptr<Window>> windows_;
    bool stopped_ = false;
};

/// A browser keeps six connections to a server, and each window that listens one of them.
inline constexpr std::size_t k_most_windows = 5;

}  // namespace culet
