#pragma once
// Structural similarity of complex wavelets: are the same edges in the same places?

#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

/// Log-Gabor wavelets (Field 1987) of six directions and wavelengths of 3 % and 6 % of the
/// diameter, in the frequency plane, for pictures of one size.
struct WaveletBank {
    double scale = 1;  ///< reduces the pictures to at most 256 pixels across the stone
    cv::Size size;     ///< of the frequency plane
    /// The response has a narrow band, so few places are enough: the band is moved to frequency
    /// zero, which shifts all phases alike, and transformed by itself.
    struct Wavelet {
        double wavelength_px = 0;
        cv::Rect band;    ///< of frequencies, relative to zero; may be negative
        cv::Mat filter;   ///< CV_32F, for the band
        cv::Size places;  ///< size of the response's grid, spread evenly over the plane
    };
    std::vector<Wavelet> wavelets;
};
WaveletBank wavelet_bank(cv::Size picture_size, double diameter);

/// CW-SSIM (Sampat, Wang, Gupta, Bovik, Markey 2009, equation 7) of encoded luminance under the
/// mask: 0 to 1, insensitive to small shifts and slow changes of brightness. The pictures must have
/// the bank's size.
double cw_ssim(const ShownPictures& pictures, const cv::Mat& mask, const WaveletBank& bank);

}  // namespace culet
