// Work apart: what it throws, and how it crashes, stays there. Expectation: docs/studio.md.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <future>
#include <thread>

#include "stone/text/errors.h"
#include "studio/job_queue.h"

namespace culet {
namespace {

using How = WorkEnd::How;

WorkEnd apart(const std::function<std::string(const Progress&)>& work) {
    std::mutex quiet;
    return run_apart(work, quiet, {});
}

TEST(WorkApart, GivesItsResultHoweverLong) {
    const std::string large(3 << 20, 'x');
    const WorkEnd end = apart([&](const Progress&) { return large; });
    EXPECT_EQ(end.how, How::done);
    EXPECT_EQ(end.text, large);
}

TEST(WorkApart, FailsInOneLineWhereItThrows) {
    EXPECT_EQ(apart([](const Progress&) -> std::string { throw InputError("no such facet"); }).text,
              "no such facet");
    EXPECT_EQ(apart([](const Progress&) -> std::string { throw InternalError("x"); }).how,
              How::failed);
    EXPECT_EQ(apart([](const Progress&) -> std::string { throw 7; }).how, How::failed);
}

TEST(WorkApart, CrashesAlone) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
        const WorkEnd end = apart([&](const Progress&) -> std::string {
            std::signal(signal, SIG_DFL);
            raise(signal);
            return "unreached";
        });
        EXPECT_EQ(end.how, How::failed);
        EXPECT_NE(end.text.find("crashed"), std::string::npos) << end.text;
    }
    EXPECT_EQ(apart([](const Progress&) -> std::string { _exit(0); }).how, How::failed);
}

TEST(WorkApart, StopsWhenAskedThoughItNeverAsks) {
    std::mutex quiet;
    int asked = 0;
    const WorkEnd end = run_apart(
        [](const Progress& progress) -> std::string {
            progress(0.5);
            for (;;) pause();
        },
        quiet, [&](double fraction) { return fraction < 0.5 && ++asked < 100; });
    EXPECT_EQ(end.how, How::stopped);
}

TEST(JobQueue, CancelsWhatAWindowAskedFor) {
    std::mutex quiet;
    JobQueue queue(quiet);
    std::promise<How> first, second;
    const auto endless = [](const Progress&) -> std::string {
        for (;;) pause();
    };
    const auto job = [&](const char* name, const char* owner, std::promise<How>& ended) {
        queue.add(
            {name, owner, endless, {}, [&](const WorkEnd& end) { ended.set_value(end.how); }});
    };
    job("a", "window 1", first);
    job("b", "window 2", second);
    queue.cancel_of("window 1");
    EXPECT_EQ(first.get_future().get(), How::stopped);
    queue.cancel("b");
    EXPECT_EQ(second.get_future().get(), How::stopped);
}

TEST(JobQueue, GoesOnAfterWorkThatThrowsAndCrashes) {
    std::mutex quiet;
    JobQueue queue(quiet);
    std::promise<How> ends[3];
    const std::function<std::string(const Progress&)> works[] = {
        [](const Progress&) -> std::string { throw InputError("broken"); },
        [](const Progress&) -> std::string { abort(); },
        [](const Progress&) { return std::string("good"); }};
    for (int i = 0; i < 3; ++i) {
        queue.add({std::to_string(i), "w", works[i], {}, [&ends, i](const WorkEnd& end) {
                       ends[i].set_value(end.how);
                   }});
    }
    EXPECT_EQ(ends[0].get_future().get(), How::failed);
    EXPECT_EQ(ends[1].get_future().get(), How::failed);
    EXPECT_EQ(ends[2].get_future().get(), How::done);
}

TEST(JobQueue, ANewerJobReplacesOneOfItsName) {
    std::mutex quiet;
    JobQueue queue(quiet);
    std::promise<std::string> ended;
    queue.add({"fit",
               "w",
               [](const Progress&) -> std::string {
                   for (;;) pause();
               },
               {},
               [](const WorkEnd&) { ADD_FAILURE() << "the replaced one told its end"; }});
    queue.add({"fit",
               "w",
               [](const Progress&) { return std::string("newer"); },
               {},
               [&](const WorkEnd& end) { ended.set_value(end.text); }});
    EXPECT_EQ(ended.get_future().get(), "newer");
}

}  // namespace
}  // namespace culet
