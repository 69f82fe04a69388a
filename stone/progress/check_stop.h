#pragma once
// Lets functions deep inside long work, which are not handed the progress, react to a stop: they
// call `check_stop`.

#include "stone/progress/progress.h"

namespace culet {

/// While it lives, `check_stop` in this thread asks `progress`, which must outlive it.
class StopScope {
public:
    explicit StopScope(const Progress& progress);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    /// Pass this on in place of `progress`.
    Progress progress();

private:
    friend void check_stop();
    const Progress& asked_;
    double fraction_ = 0;
    StopScope* outer_;
};

/// Throws Interrupted when the surrounding work was asked to stop.
void check_stop();

}  // namespace culet
