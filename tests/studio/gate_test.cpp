// Tokens of the studio. Expectation: docs/studio.md, "Who may speak to it".

#include "studio/gate.h"

#include <gtest/gtest.h>

#include <set>

namespace culet {
namespace {

TEST(Gate, TokensAreLongAndNeverTheSame) {
    std::set<std::string> tokens;
    for (int i = 0; i < 1000; ++i) tokens.insert(random_token());
    EXPECT_EQ(tokens.size(), 1000u);
    EXPECT_EQ(tokens.begin()->size(), 32u);
    EXPECT_EQ(tokens.begin()->find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Gate, WantsOneHostAndItsOwnCookie) {
    const Gate gate(8080);
    const std::string cookie = gate.cookie().substr(0, gate.cookie().find(';'));
    const auto verdict = [&](const Knock& knock) { return gate.verdict(knock); };
    using enum Gate::Verdict;
    EXPECT_EQ(verdict({"/", {"127.0.0.1:8080"}, {}, {"a=b; " + cookie + "; c=d"}, {}}), pass);
    EXPECT_EQ(verdict({"/", {"127.0.0.1:8080", "127.0.0.1:8080"}, {}, {cookie}, {}}), refuse);
    EXPECT_EQ(verdict({"/", {}, {}, {cookie}, {}}), refuse);
    EXPECT_EQ(verdict({"/", {"127.0.0.1:8080"}, {}, {"x" + cookie}, {}}), refuse);
    EXPECT_EQ(verdict({"/", {"127.0.0.1:8080"}, {}, {cookie + "0"}, {}}), refuse);
    // Another studio's cookie does not open this one.
    const Gate other(8080);
    EXPECT_EQ(other.verdict({"/", {"127.0.0.1:8080"}, {}, {cookie}, {}}), refuse);
}

}  // namespace
}  // namespace culet
