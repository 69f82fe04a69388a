#pragma once
// ICC profiles, by Little CMS.

#include <cstddef>
#include <memory>
#include <string>

namespace culet {

/// From samples (0 to 1; of inks 1 is all of it) to linear sRGB, relative colorimetric (white of
/// the medium is 1, 1, 1); colours outside of sRGB lie below 0 or above 1. ICC.1:2010 and ICC.2 as
/// the library reads them.
class ColourProfile {
public:
    /// Of 1 (grey), 3 (R, G, B) or 4 (C, M, Y, K) channels. Grey with a profile of R, G, B is that
    /// with three equal samples.
    ColourProfile(const std::string& bytes, std::size_t channels);

    /// Why it cannot be followed; empty: it can.
    const std::string& trouble() const { return trouble_; }
    const std::string& name() const { return name_; }
    /// The same as sRGB's curve and primaries, to 0.001 of white.
    bool is_srgb() const;
    void linear(const float* samples, std::size_t pixels, float* rgb) const;

private:
    // The page's stand-in needs neither.
    [[maybe_unused]] std::size_t channels_, of_profile_;
    std::string trouble_, name_;
    std::shared_ptr<void> transform_;
};

}  // namespace culet
