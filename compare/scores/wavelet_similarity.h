#pragma once
// Are the same edges in the same places? Structural similarity of complex wavelets.

#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

/// Log-Gabor wavelets (Field 1987) of six directions and wavelengths of 3 % and 6 % of the diameter
/// in the frequency plane, for pictures of one size.
struct WaveletBank {
    double scale = 1;  ///< the pictures are reduced so that the stone is 256 pixels across at most
    cv::Size size;     ///< of the frequency plane
    /// Its answer has few frequencies, and is taken at as few places: the band is moved to zero,
    /// which changes all phases alike, and transformed by itself.
    struct Wavelet {
        double wavelength_px = 0;
        cv::Rect band;    ///< of frequencies, from the plane's zero; may be negative
        cv::Mat filter;   ///< CV_32F, of the band
        cv::Size places;  ///< at which the answer is taken, evenly over the plane's pictures
    };
    std::vector<Wavelet> wavelets;
};
WaveletBank wavelet_bank(cv::Size picture_size, double diameter);

/// CW-SSIM (Sampat, Wang, Gupta, Bovik, Markey 2009, equation 7) of encoded luminance under the
/// mask: 0 to 1, indifferent to small shifts and to slow changes of brightness. The pictures must
/// have the size that the bank was made for.
double cw_ssim(const ShownPictures& pictures, const cv::Mat& mask, const WaveletBank& bank);

}  // namespace culet
