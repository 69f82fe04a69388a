#pragma once
// For sentences that people read: tests check their facts, not their wording.

#include <gmock/gmock.h>

namespace culet::test {

/// Matches text that states all of these, in any order and wording: numbers, names, places, keys.
template <class... Facts>
auto says(const Facts&... facts) {
    return testing::AllOf(testing::HasSubstr(facts)...);
}

}  // namespace culet::test
