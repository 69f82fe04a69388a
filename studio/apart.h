#pragma once
// Work in a process of its own: whatever it does, the studio goes on.

#include <functional>
#include <mutex>
#include <string>

#include "stone/progress/progress.h"

namespace culet {

struct WorkEnd {
    enum class How { done, failed, stopped } how = How::done;
    std::string text;  ///< the result, or what is wrong in one line for people
};

/// In a copy of this process, made by fork: closes what the studio has open but for `kept`, and
/// sees to it that the copy ends with the studio.
void leave_the_studio(int kept);

/// Runs `work` in a copy of this process, which may crash or be killed and shares no memory. What
/// it throws, and a crash, is `failed`; `stopped` when `progress`, which hears of it at least
/// twenty times a second, returns false. Holds `quiet` while the copy is made: no other thread may
/// then be within this library, whose locks would stay locked in the copy.
WorkEnd run_apart(const std::function<std::string(const Progress&)>& work, std::mutex& quiet,
                  const Progress& progress);

}  // namespace culet
