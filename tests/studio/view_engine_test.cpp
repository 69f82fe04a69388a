// The engine of the stone that turns, in its own process. Expectations: docs/viewer.md ("The
// engine's calls") and studio/view_engine.h.

#include "studio/view_engine.h"

#include <sys/types.h>

#include <csignal>
#include <fstream>

#include "tests/studio/studio_over_the_network.h"

namespace culet {
namespace {

using How = ViewEngine::Reply::How;

// Of this thread.
std::vector<pid_t> children() {
    std::ifstream list("/proc/thread-self/children");
    std::vector<pid_t> pids;
    for (pid_t pid = 0; list >> pid;) pids.push_back(pid);
    return pids;
}

TEST(ViewEngines, RefuseInOneLineWhatIsNoCall) {
    std::mutex quiet;
    ViewEngine engine("0", ".", quiet);
    for (const std::string request :
         {"", "garbage\n", "{}\n", R"({"call":"draw","arguments":{}})",
          R"({"call":"nothing","arguments":{}})", R"({"call":7,"arguments":[]})",
          "{\"call\":\"open\",\"arguments\":{\"item\":0}}\nno document"}) {
        const ViewEngine::Reply reply = engine.answer(request);
        EXPECT_EQ(reply.how, How::refused) << request;
        EXPECT_FALSE(reply.text.empty()) << request;
        EXPECT_EQ(reply.text.find('\n'), std::string::npos) << reply.text;
    }
}

TEST(ViewEngines, ThatAreKilledEndNothingElseAndBeginAnew) {
    std::mutex quiet;
    ViewEngine engine("0", ".", quiet);
    const std::string request = R"({"call":"draw","arguments":{}})";
    EXPECT_EQ(engine.answer(request).how, How::refused);
    ASSERT_EQ(children().size(), 1u);
    kill(children().front(), SIGKILL);
    EXPECT_EQ(engine.answer(request).how, How::died);
    EXPECT_EQ(engine.answer(request).how, How::refused);
}

TEST_F(StudioOverTheNetwork, AnswersTheEnginesCallsOfItsOwnWindowsAlone) {
    const std::string request = R"({"call":"draw","arguments":{}})";
    const auto alone = post("/api/engine?window=nobody", request, cookie_);
    EXPECT_EQ(alone->status, 400);
    EXPECT_NE(alone->body.find("no window"), std::string::npos) << alone->body;
    EXPECT_EQ(post("/api/engine?window=other", request, {})->status, 403);
    heard("table", [&] {
        const auto asked = post("/api/engine?window=other", request, cookie_);
        EXPECT_EQ(asked->status, 400);
        EXPECT_NE(asked->body.find("\"died\":false"), std::string::npos) << asked->body;
        EXPECT_EQ(asked->body.find("no window"), std::string::npos) << asked->body;
        EXPECT_EQ(edit(0, "value", "33.7"), 200);  // another event
    });
}

}  // namespace
}  // namespace culet
