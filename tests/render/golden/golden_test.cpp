// Scenes of samples/effects against stored pictures. Expectations: the mean of 16 pictures with
// other seeds, and their variance. Most pictures do not depend on the seed. If a change is meant to
// change a picture, look at the old and the new one and run build/make_golden.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render/image/image_io.h"
#include "tests/render/golden/golden_picture.h"

namespace culet::test {
namespace {

class Golden : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

// Writes the old picture, the new one, and ten times their difference about grey. Returns where
// they are.
std::string left_behind(const Picture& picture, const GoldenPicture& golden,
                        const std::string& name) {
    Picture off = picture;
    const double mean = mean_radiance(golden.mean);
    for (std::size_t i = 0; i < off.rgb.size(); ++i)
        off.rgb[i] = std::max(0.2f + float(10 * (picture.rgb[i] - golden.mean.rgb[i]) / mean), 0.f);
    const std::filesystem::path folder = std::filesystem::current_path() / "golden-failures";
    std::filesystem::create_directories(folder);
    write_picture(golden.mean, folder / (name + "-was.png"));
    write_picture(picture, folder / (name + "-is.png"));
    write_picture(off, folder / (name + "-difference.png"));
    return (folder / (name + "-*.png")).string();
}

// Five standard deviations of the stored pictures' differences from each other.
double most_of(const GoldenPicture& golden) {
    return std::max(1.0, golden.ratio_mean + 5 * golden.ratio_sigma);
}

TEST_P(Golden, LooksAsItDid) {
    const auto& [scene, engine] = GetParam();
    const GoldenPicture golden = read_golden(golden_file(scene, engine));
    const Picture picture = drawn(scene, engine, 1);
    EXPECT_LT(squared_difference(picture, golden), most_of(golden))
        << left_behind(picture, golden, scene + "-" + engine);
}

INSTANTIATE_TEST_SUITE_P(Effects, Golden,
                         testing::Combine(testing::ValuesIn(golden_scenes()),
                                          testing::Values("auto", "reference")),
                         [](const auto& which) {
                             std::string name =
                                 std::get<0>(which.param) + "_" + std::get<1>(which.param);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(GoldenPictures, ASmallChangeIsNoticed) {
    const std::string scene = "garnet-depth", engine = "reference";
    const GoldenPicture golden = read_golden(golden_file(scene, engine));
    Picture picture = drawn(scene, engine, 1);
    for (std::size_t i = 0; i < picture.rgb.size() / 4; ++i) picture.rgb[i] *= 1.05f;
    EXPECT_GT(squared_difference(picture, golden), most_of(golden));
}

}  // namespace
}  // namespace culet::test
