#pragma once
// Long work that Python waits for: without its lock, with its progress, and ended by Ctrl-C.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

#include "stone/progress/progress.h"

namespace culet {

/// What `work(progress)` returns or throws. It runs in a thread of its own, without Python's global
/// lock. This one wakes up twenty times a second: it looks for Ctrl-C (KeyboardInterrupt), and
/// calls `told`, Python's callable or None, with the fraction done, once at least. Where that
/// returns False or raises, the work is asked to stop; the first ends as Interrupted.
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
        // Work that was over before this thread woke up.
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
