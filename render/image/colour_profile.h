#pragma once
// ICC profiles, applied with Little CMS.

#include <cstddef>
#include <memory>
#include <string>

namespace culet {

/// Converts samples (0 to 1; inks: 1 is full) to linear sRGB, relative colorimetric: the medium's
/// white becomes (1, 1, 1). Colours outside sRGB are below 0 or above 1. Reads ICC.1:2010 and ICC.2
/// as the library does.
class ColourProfile {
public:
    /// `channels`: 1 (grey), 3 (R, G, B) or 4 (C, M, Y, K). Grey with an RGB profile counts as
    /// three equal samples.
    ColourProfile(const std::string& bytes, std::size_t channels);

    /// Why it cannot be applied; empty: it can.
    const std::string& trouble() const { return trouble_; }
    const std::string& name() const { return name_; }
    /// True if it equals sRGB's curve and primaries to 0.001 of white.
    bool is_srgb() const;
    void linear(const float* samples, std::size_t pixels, float* rgb) const;

private:
    // unused in the web page's stub
    [[maybe_unused]] std::size_t channels_, of_profile_;
    std::string trouble_, name_;
    std::shared_ptr<void> transform_;
};

}  // namespace culet
