#pragma once
// Several exposures of one motionless scene as one picture in linear light.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "stone/progress/progress.h"

namespace culet {

/// A shot of a series, read when it is needed: a long series does not fit into memory.
struct BracketShot {
    std::string name;
    double exposure = 1;          ///< relative amount of light let in; larger is brighter
    std::function<Photo()> read;  ///< the same photo each time it is called
};

enum class Response {
    as_read,    ///< linear as read: raw, float files, or the sRGB curve of 8- and 16-bit files
    calibrated  ///< found from the series itself (Debevec & Malik 1997, by OpenCV): 8-bit files
                ///< only
};

struct BracketOptions {
    /// Nothing: calibrated when the files are 8-bit JPEGs and there are at least five of them.
    std::optional<Response> response;
    bool align = true;
};

/// Of a camera that writes 8 bits: linear light for each of the 256 values, a channel; increasing;
/// 1 at 255 of green.
using ResponseCurve = std::array<std::array<float, 256>, 3>;

struct FrameShift {
    double x = 0,
           y = 0;  ///< pixels that the shot's content lies to the right of and below the first's
};

struct Bracket {
    /// In units of the first shot: its unsaturated values stay as they are. With `variance` and
    /// `saturated`.
    Photo photo;
    Response response = Response::as_read;
    std::optional<ResponseCurve> curve;  ///< where it was found
    std::vector<FrameShift> shifts;      ///< a shot
    /// Measured over stated ratio of exposures from each shot to the next darker one, 1 where they
    /// agree; empty for one shot.
    std::vector<double> exposure_ratios;
    std::vector<std::string> notes;
};

/// Each pixel is the mean of the shots' values over their exposures, weighted by the inverse of
/// their variance (shot noise and reading noise; rounding to 8 bits where they have so few) with
/// what is over-exposed left out and what is near it faded out, so that there is no edge. A pixel
/// that every shot over-exposes keeps the darkest shot's value and is marked.
/// Shots are aligned to the first by shifts (correlation of log-luminance, to a tenth of a pixel);
/// only shifts over 0.1 pixels are applied. Shots are read from the brightest to the darkest, once
/// to look at and once to add; beside the sums, two of them are in memory at a time, and as many as
/// fit into 512 MiB are kept in between. Throws InputError: sizes that differ, the same exposure
/// twice, not-finite samples, all black.
Bracket merge_bracket(const std::vector<BracketShot>& shots, const BracketOptions& options = {},
                      const Progress& progress = {});

}  // namespace culet
