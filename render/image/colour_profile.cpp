#include "render/image/colour_profile.h"

#include <fmt/format.h>
#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/colour/colour.h"
#include "render/colour/primaries.h"

namespace culet {

namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using OpenProfile = std::unique_ptr<void, CloseProfile>;

OpenProfile linear_srgb_profile() {
    const auto xyy = [](std::size_t i) {
        return cmsCIExyY{k_srgb_primaries[i][0], k_srgb_primaries[i][1], 1};
    };
    const cmsCIExyY white = xyy(3);
    const cmsCIExyYTRIPLE primaries{xyy(0), xyy(1), xyy(2)};
    cmsToneCurve* const line = cmsBuildGamma(nullptr, 1);
    cmsToneCurve* curves[3]{line, line, line};
    OpenProfile profile(cmsCreateRGBProfile(&white, &primaries, curves));
    cmsFreeToneCurve(line);
    return profile;
}

std::string description_of(cmsHPROFILE profile) {
    std::array<char, 80> text{};
    cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text.data(), text.size() - 1);
    return text[0] == '\0' ? "an ICC profile without a name" : text.data();
}

}  // namespace

ColourProfile::ColourProfile(const std::string& bytes, std::size_t channels)
    : channels_(channels), of_profile_(channels) {
    const OpenProfile profile(
        cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    if (profile == nullptr) {
        trouble_ = "its ICC profile is damaged";
        return;
    }
    name_ = description_of(profile.get());
    const cmsColorSpaceSignature space = cmsGetColorSpace(profile.get());
    if (channels == 1 && space == cmsSigRgbData) of_profile_ = 3;
    if (space != (of_profile_ == 1   ? cmsSigGrayData
                  : of_profile_ == 3 ? cmsSigRgbData
                                     : cmsSigCmykData)) {
        trouble_ = fmt::format("its ICC profile \"{}\" is one for other channels", name_);
        return;
    }
    const OpenProfile linear = linear_srgb_profile();
    transform_.reset(cmsCreateTransform(profile.get(),
                                        of_profile_ == 1   ? TYPE_GRAY_FLT
                                        : of_profile_ == 3 ? TYPE_RGB_FLT
                                                           : TYPE_CMYK_FLT,
                                        linear.get(), TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC,
                                        cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE),
                     [](void* transform) {
                         if (transform != nullptr) cmsDeleteTransform(transform);
                     });
    if (transform_ == nullptr)
        trouble_ = fmt::format("its ICC profile \"{}\" gives no colours", name_);
}

bool ColourProfile::is_srgb() const {
    if (channels_ == 4) return false;
    for (int step = 0; step <= 16; ++step) {
        for (std::size_t c = 0; c < channels_; ++c) {
            // Test greys, and each channel alone.
            for (const bool alone : {false, true}) {
                std::array<float, 3> samples{}, rgb{};
                if (alone)
                    samples[c] = static_cast<float>(step) / 16;
                else
                    samples.fill(static_cast<float>(step) / 16);
                linear(samples.data(), 1, rgb.data());
                for (std::size_t k = 0; k < 3; ++k) {
                    const double expected =
                        srgb_decoded(static_cast<double>(samples[channels_ == 1 ? 0 : k]));
                    if (!(std::abs(static_cast<double>(rgb[k]) - expected) <= 1e-3)) return false;
                }
            }
        }
    }
    return true;
}

void ColourProfile::linear(const float* samples, std::size_t pixels, float* rgb) const {
    std::vector<float> meant;
    if (channels_ == 4) {  // the library uses per cent for inks
        meant.assign(samples, samples + 4 * pixels);
        for (float& v : meant) v *= 100;
    }
    for (std::size_t p = 0; p < pixels && of_profile_ != channels_; ++p)
        meant.insert(meant.end(), 3, samples[p]);
    if (!meant.empty()) samples = meant.data();
    cmsDoTransform(transform_.get(), samples, rgb, static_cast<cmsUInt32Number>(pixels));
}

}  // namespace culet
