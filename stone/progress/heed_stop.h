#pragma once
// Lets functions deep inside long work, which are not handed the progress, react to a stop: they
// call `heed_stop`.

#include "stone/progress/progress.h"

namespace culet {

/// While it lives, `heed_stop` in this thread asks `progress`, which must outlive it.
class StopsHeeded {
public:
    explicit StopsHeeded(const Progress& progress);
    ~StopsHeeded();
    StopsHeeded(const StopsHeeded&) = delete;
    StopsHeeded& operator=(const StopsHeeded&) = delete;

    /// Pass this on in place of `progress`.
    Progress progress();

private:
    friend void heed_stop();
    const Progress& asked_;
    double fraction_ = 0;
    StopsHeeded* outer_;
};

/// Throws Interrupted when the surrounding work was asked to stop.
void heed_stop();

}  // namespace culet
