#pragma once
// For sentences that people read: a test holds the facts in them, not their words.

#include <gmock/gmock.h>

namespace culet::test {

/// Text that states all of these, in whatever order and words: numbers, names, places, keys.
template <class... Facts>
auto says(const Facts&... facts) {
    return testing::AllOf(testing::HasSubstr(facts)...);
}

}  // namespace culet::test
