#pragma once
// Runs long work for Python: without its lock, with progress, and stopped by Ctrl-C.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

#include "stone/progress/progress.h"

namespace culet {

/// Returns or throws what `work(progress)` does. The work runs in its own thread without Python's
/// global lock. The calling thread wakes up twenty times a second, checks for Ctrl-C
/// (KeyboardInterrupt), and calls `told` (Python's callable or None) with the fraction done, at
/// least once. If that returns False or raises, the work is asked to stop; after False it ends with
/// Interrupted.
template <class Work>
auto wait_for(const pybind11::object& told, Work work) {
    std::atomic<double> done{0};
    std::atomic<bool> stop{false};
    auto result = std::async(std::launch::async, [&] {
        return work(Progress([&](double fraction) {
            done = fraction;
            return !stop;
        }));
    });
    const auto is_ready = [&] {
        const pybind11::gil_scoped_release unlocked;
        return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    };
    try {
        double before = 0;
        while (!is_ready()) {
            if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
            if (told.is_none() || done == before) continue;
            before = done;
            const pybind11::object answer = told(before);
            if (answer.is(pybind11::bool_(false))) stop = true;
        }
        // The work may have ended before this thread woke up.
        if (!told.is_none() && !stop && done > before) told(done.load());
    } catch (...) {
        stop = true;
        const pybind11::gil_scoped_release unlocked;
        result.wait();
        throw;
    }
    return result.get();
}

}  // namespace culet
