#pragma once
// Stops that are asked for in the middle of long work: steps deep down, to which no progress is
// handed, ask by `heed_stop`.

#include "stone/progress/progress.h"

namespace culet {

/// While it lives, `heed_stop` in this thread asks `progress`, which must outlive it.
class StopsHeeded {
public:
    explicit StopsHeeded(const Progress& progress);
    ~StopsHeeded();
    StopsHeeded(const StopsHeeded&) = delete;
    StopsHeeded& operator=(const StopsHeeded&) = delete;

    /// To be handed on in place of `progress`: remembers the fraction that was told last.
    Progress progress();

private:
    friend void heed_stop();
    const Progress& asked_;
    double fraction_ = 0;
    StopsHeeded* outer_;
};

/// Throws Interrupted when the work around it was asked to stop.
void heed_stop();

}  // namespace culet
