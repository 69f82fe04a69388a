#pragma once
// Drawing by a GPU driver in tests.

#include <gtest/gtest.h>

#include "render/gpu/gpu_canvas.h"
#include "stone/text/errors.h"
#include "tests/render/beams/beam_lights.h"
#include "tests/render/gpu/path_pattern.h"

namespace culet {

/// Why there is no driver here; empty if there is one.
inline std::string missing_driver() {
    try {
        const GlContext context;
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

/// Tests that draw. They are skipped, with a message, only where no driver is installed.
class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        static const std::string missing = missing_driver();
        if (!missing.empty()) GTEST_SKIP() << missing;
    }
};

}  // namespace culet
