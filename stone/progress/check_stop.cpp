#include "stone/progress/check_stop.h"

#include "stone/text/errors.h"

namespace culet {

namespace {

thread_local StopScope* innermost = nullptr;

}  // namespace

StopScope::StopScope(const Progress& progress) : asked_(progress), outer_(innermost) {
    innermost = this;
}

StopScope::~StopScope() {
    innermost = outer_;
}

Progress StopScope::progress() {
    if (!asked_) return {};
    return [this](double fraction) {
        fraction_ = fraction;
        return asked_(fraction);
    };
}

void check_stop() {
    if (innermost == nullptr || !innermost->asked_) return;
    if (!innermost->asked_(innermost->fraction_)) throw Interrupted();
}

}  // namespace culet
