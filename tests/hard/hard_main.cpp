// Registers every file of the corpus as a separate test: Hard_<section>.<name>.

#include <gtest/gtest.h>

#include <cstdio>
#include <exception>
#include <set>

#include "tests/hard/hard_run.h"

namespace {

using namespace culet::hard;

class HardCaseTest : public testing::Test {
public:
    explicit HardCaseTest(const HardCase& hard_case) : case_(hard_case) {}
    void TestBody() override { run_case(case_, CULET_HARD_RESULTS); }

private:
    HardCase case_;
};

TEST(HardCorpus, HasCasesInEverySection) {
    std::set<std::string> found;
    for (const HardCase& one : read_corpus(CULET_SOURCE_DIR "/tests/hard"))
        found.insert(one.section);
    for (const std::string& section : sections()) EXPECT_TRUE(found.contains(section)) << section;
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    try {
        for (const HardCase& one : read_corpus(CULET_SOURCE_DIR "/tests/hard")) {
            testing::RegisterTest(("Hard_" + one.section).c_str(), one.name.c_str(), nullptr,
                                  nullptr, one.file.c_str(), 1,
                                  [=]() -> testing::Test* { return new HardCaseTest(one); });
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return RUN_ALL_TESTS();
}
