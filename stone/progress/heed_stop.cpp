#include "stone/progress/heed_stop.h"

#include "stone/text/errors.h"

namespace culet {

namespace {

thread_local StopsHeeded* innermost = nullptr;

}  // namespace

StopsHeeded::StopsHeeded(const Progress& progress) : asked_(progress), outer_(innermost) {
    innermost = this;
}

StopsHeeded::~StopsHeeded() {
    innermost = outer_;
}

Progress StopsHeeded::progress() {
    if (!asked_) return {};
    return [this](double fraction) {
        fraction_ = fraction;
        return asked_(fraction);
    };
}

void heed_stop() {
    if (innermost == nullptr || !innermost->asked_) return;
    if (!innermost->asked_(innermost->fraction_)) throw Interrupted();
}

}  // namespace culet
