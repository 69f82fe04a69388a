#pragma once
// How long work reports its progress. Libraries never print.

#include <functional>

namespace culet {

/// Called now and then with the fraction done, 0..1, from one thread at a time. Returns false to
/// ask for a stop; the work then throws Interrupted and leaves nothing half written.
using Progress = std::function<bool(double fraction)>;

}  // namespace culet
