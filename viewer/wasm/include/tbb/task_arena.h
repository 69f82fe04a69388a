#pragma once
// See parallel_for.h.

#include <utility>

namespace tbb {

class task_arena {
public:
    static constexpr int automatic = -1;
    explicit task_arena(int = automatic) {}
    template <class Work>
    void execute(Work&& work) {
        std::forward<Work>(work)();
    }
};

}  // namespace tbb
