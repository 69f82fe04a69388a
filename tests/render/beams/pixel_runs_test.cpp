// Compares the vectorised loops with plain ones on every instruction set of this processor.

#include "render/beams/pixel_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "render/beams/beam_shading.h"

using namespace culet;

namespace {

class Runs : public testing::TestWithParam<std::string> {
protected:
    static constexpr int k_width = 83, k_rows = 7, k_first_pixel = 10 * k_width;
    static constexpr std::size_t k_pixels = static_cast<std::size_t>(k_width * k_rows);

    void SetUp() override { ASSERT_TRUE(use_shading_target(GetParam())); }
    void TearDown() override { use_shading_target(shading_targets().front()); }

    // One run of any length in every row; values beyond the runs must not be used.
    void make_runs(std::mt19937_64& random) {
        std::uniform_int_distribution<int> column(0, k_width);
        std::uniform_real_distribution<float> value(0, 1);
        runs_.clear();
        count_ = 0;
        for (int row = 0; row < k_rows; ++row) {
            const auto [from, until] = std::minmax({column(random), column(random)});
            if (from == until) continue;
            runs_.push_back({k_first_pixel + row * k_width + from, count_, until - from});
            count_ += until - from;
        }
        values_.clear();
        shares_.clear();
        for (int i = 0; i < count_ + k_shading_room; ++i) {
            values_.push_back(value(random));
            shares_.push_back(value(random) < 0.4f ? 1.0f : value(random));
        }
    }

    PixelRuns runs_;
    int count_ = 0;
    std::vector<float> values_, shares_;
};

TEST_P(Runs, AreAddedToTheirOwnPixelsAndToNoOthers) {
    std::mt19937_64 random(20271);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE("seed 20271, case " + std::to_string(i));
        make_runs(random);
        for (const bool with_values : {true, false}) {
            std::vector<float> plane(k_pixels, 0.25f), expected(plane);
            for (const PixelRun& run : runs_) {
                for (int k = 0; k < run.count; ++k) {
                    const std::size_t at = static_cast<std::size_t>(run.first + k);
                    expected[static_cast<std::size_t>(run.pixel - k_first_pixel + k)] +=
                        1.5f * shares_[at] * (with_values ? values_[at] : 1.0f);
                }
            }
            add_to_runs(runs_, with_values ? values_.data() : nullptr, shares_.data(), 1.5f,
                        {plane.data(), k_first_pixel});
            // Three roundings of numbers up to 2.
            for (std::size_t p = 0; p < k_pixels; ++p)
                ASSERT_NEAR(plane[p], expected[p], 3 * 1.2e-7f) << "pixel " << p;
        }
    }
}

TEST_P(Runs, ClaimEachPixelOnce) {
    std::mt19937_64 random(20272);
    std::vector<float> taken(k_pixels, 0.0f);
    std::vector<double> given(k_pixels, 0.0);
    std::vector<bool> wanted(k_pixels, false);
    for (int i = 0; i < 6; ++i) {
        make_runs(random);
        std::fill(shares_.begin(), shares_.end(), 1.0f);
        claim_runs(runs_, {taken.data(), k_first_pixel}, shares_.data());
        for (const PixelRun& run : runs_) {
            for (int k = 0; k < run.count; ++k) {
                const std::size_t p = static_cast<std::size_t>(run.pixel - k_first_pixel + k);
                given[p] += static_cast<double>(shares_[static_cast<std::size_t>(run.first + k)]);
                wanted[p] = true;
            }
        }
    }
    for (std::size_t p = 0; p < k_pixels; ++p) {
        EXPECT_EQ(given[p], wanted[p] ? 1 : 0) << "pixel " << p;
        EXPECT_EQ(taken[p], wanted[p] ? 1 : 0) << "pixel " << p;
    }
}

TEST_P(Runs, AreSummed) {
    std::mt19937_64 random(20273);
    for (int i = 0; i < 100; ++i) {
        make_runs(random);
        double of_shares = 0, of_products = 0;
        for (int k = 0; k < count_; ++k) {
            const std::size_t at = static_cast<std::size_t>(k);
            of_shares += static_cast<double>(shares_[at]);
            of_products += static_cast<double>(shares_[at]) * static_cast<double>(values_[at]);
        }
        // One rounding per number added, of a sum no larger than their count.
        const double rounding = 6e-8 * count_ * count_;
        EXPECT_NEAR(static_cast<double>(sum_of_shared(nullptr, shares_.data(), count_)), of_shares,
                    rounding);
        EXPECT_NEAR(static_cast<double>(sum_of_shared(values_.data(), shares_.data(), count_)),
                    of_products, rounding);
    }
}

TEST_P(Runs, TellOfWholePixelsWithoutAMark) {
    for (int count : {0, 1, 5, 16, 17, 40}) {
        const std::size_t size = static_cast<std::size_t>(count + k_shading_room);
        // Beyond the count every entry would match.
        std::vector<float> marks(size, 0.0f), shares(size, 1.0f);
        std::fill_n(marks.begin(), count, 1.0f);
        EXPECT_FALSE(any_unmarked_whole(marks.data(), shares.data(), count));
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            marks[i] = 0;
            EXPECT_TRUE(any_unmarked_whole(marks.data(), shares.data(), count)) << i;
            shares[i] = 0.99f;
            EXPECT_FALSE(any_unmarked_whole(marks.data(), shares.data(), count)) << i;
            marks[i] = shares[i] = 1;
        }
    }
}

TEST_P(Runs, ShowGapsNextToWhatIsTaken) {
    std::mt19937_64 random(20274);
    for (int i = 0; i < 50; ++i) {
        SCOPED_TRACE("seed 20274, case " + std::to_string(i));
        std::vector<float> taken(k_pixels, 0.0f);
        std::bernoulli_distribution some(i % 2 == 0 ? 0.03 : 0.97);
        for (float& t : taken) t = some(random) ? 1.0f : 0.0f;
        std::vector<int> expected, found;
        for (int y = 0; y < k_rows; ++y) {
            for (int x = 0; x < k_width; ++x) {
                const auto at = [&](int u, int v) {
                    return u >= 0 && u < k_width && v >= 0 && v < k_rows &&
                           taken[static_cast<std::size_t>(v * k_width + u)] > 0;
                };
                if (!at(x, y) && (at(x - 1, y) || at(x + 1, y) || at(x, y - 1) || at(x, y + 1)))
                    expected.push_back(k_first_pixel + y * k_width + x);
            }
        }
        find_gaps({taken.data(), k_first_pixel}, k_width, k_rows, found);
        EXPECT_EQ(found, expected);
    }
}

TEST_P(Runs, BecomeCoverAndColour) {
    for (int count : {0, 1, 7, 16, 33}) {
        const std::size_t size = static_cast<std::size_t>(count);
        std::vector<float> values, sums(size + 1, 0.5f), rgb(3 * size + 1, -1.0f);
        for (int i = 0; i < count; ++i) values.push_back(static_cast<float>(i) / 8);
        add_up_to_one(values.data(), count, 0.5f, sums.data());
        spread_to_rgb(values.data(), size, rgb.data());
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_EQ(sums[i], 0.5f + 0.5f * std::min(values[i], 1.0f));
            for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(rgb[3 * i + c], values[i]);
        }
        EXPECT_EQ(sums[size], 0.5f) << "what lies beyond stays";
        EXPECT_EQ(rgb[3 * size], -1.0f) << "what lies beyond stays";
    }
}

INSTANTIATE_TEST_SUITE_P(OnEach, Runs, testing::ValuesIn(shading_targets()),
                         [](const auto& target) { return target.param; });

}  // namespace
