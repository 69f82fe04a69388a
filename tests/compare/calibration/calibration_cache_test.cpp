#include "compare/calibration/calibration_cache.h"
#include "compare/scores/score_list.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "compare/calibration/facet_tilts.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

namespace fs = std::filesystem;

Calibration calibration() {
    Calibration result;
    result.hash = "c0ffee";
    result.keys = {"zncc", k_facet_tilts};
    result.draws = {{Alternative::facet_error, "0.1 degrees", 0.1, {0.9, 0.11}},
                    {Alternative::light, "", 0, {0.2, std::nullopt}}};
    return result;
}

class CalibrationCacheTest : public testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    const fs::path folder_ = fs::path(testing::TempDir()) / "culet-cache-test";
    const CalibrationCache cache_{folder_};
    const TiltVariance tilts_{{0.1f, 1e-20f, -3e9f, 0.25f, 0.0f, 7.0f}, 3};
};

TEST_F(CalibrationCacheTest, FindsWhatItKeptToTheLastBit) {
    cache_.keep(calibration(), tilts_);
    const auto found = cache_.find("c0ffee");
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(found->calibration.from_cache);
    EXPECT_EQ(calibration_json(found->calibration), calibration_json(calibration()));
    EXPECT_EQ(found->tilts.rows(), tilts_.rows());
    EXPECT_EQ(found->tilts.samples(), 3u);
    EXPECT_FALSE(cache_.find("tea").has_value());
}

TEST_F(CalibrationCacheTest, KeepsNothingWithoutAFolder) {
    const CalibrationCache none{fs::path()};
    none.keep(calibration(), tilts_);
    EXPECT_FALSE(none.find("c0ffee").has_value());
}

// A non-convex stone has no such score, and then there is nothing to store.
TEST_F(CalibrationCacheTest, AsksForTheTiltsOnlyWhereDrawsHaveTheirScore) {
    Calibration without = calibration();
    without.draws[0].scores[1].reset();
    cache_.keep(without, TiltVariance());
    const auto found = cache_.find("c0ffee");
    ASSERT_TRUE(found.has_value());
    EXPECT_FALSE(found->tilts.usable());
}

TEST_F(CalibrationCacheTest, DoesWithoutWhatIsBroken) {
    const auto breaks = [&](const char* extension, const std::string& text) {
        cache_.keep(calibration(), tilts_);
        ASSERT_TRUE(cache_.find("c0ffee").has_value());
        std::ofstream(folder_ / (std::string("calibration-c0ffee") + extension)) << text;
        EXPECT_FALSE(cache_.find("c0ffee").has_value()) << extension << " '" << text << "'";
    };
    for (const char* text :
         {"", "no numbers", "P5 2 2 255\nabcd", "Pf\n3 2\n-1\nabcd", "v/1\x01\x02"}) {
        breaks(".pfm", text);
        breaks(".json", text);
    }
    cache_.keep(calibration(), tilts_);
    fs::remove(folder_ / "calibration-c0ffee.pfm");
    EXPECT_FALSE(cache_.find("c0ffee").has_value());
}

}  // namespace
}  // namespace culet
