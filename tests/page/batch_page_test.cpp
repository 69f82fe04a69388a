#include "page/batch_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/page/kept_pages.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(BatchPage, TakesNamesForTextAndLeavesPicturesTheirShape) {
    BatchPageJob job;
    job.name = job.message = test::hostile_name();
    job.status = "not_trusted";
    job.files = {"grade.html", test::hostile_name() + ".obj"};
    job.png = "no picture, but shown";
    BatchPage batch;
    batch.jobs = {job, job};
    const std::string page = batch_page(batch);
    EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(page, HasSubstr("not trusted"));
    EXPECT_THAT(page, Not(HasSubstr("width=\"96\" height=\"96\"")));
    test::keep_page("batch", page);
}

}  // namespace
}  // namespace culet
