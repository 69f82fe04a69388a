#pragma once
// Merges exposures of one motionless scene into linear light.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "stone/progress/progress.h"

namespace culet {

/// Read on demand, because a long series does not fit into memory.
struct BracketShot {
    std::string name;
    double exposure = 1;          ///< relative; larger is brighter
    std::function<Photo()> read;  ///< must return the same photo at each call
};

enum class Response {
    as_read,  ///< linear as read: raw or float files, or 8- and 16-bit files through the sRGB curve
    calibrated  ///< found from the series (Debevec & Malik 1997, by OpenCV); 8-bit files only
};

struct BracketOptions {
    /// Nothing: calibrated for at least five 8-bit JPEGs, otherwise as_read.
    std::optional<Response> response;
    bool align = true;
};

/// Linear light of an 8-bit camera's 256 values, for each channel; increasing, 1 at 255 of green.
using ResponseCurve = std::array<std::array<float, 256>, 3>;

struct FrameShift {
    double x = 0,
           y = 0;  ///< pixels by which the shot's content lies right of and below the first's
};

struct Bracket {
    /// In units of the first shot, whose unsaturated values stay. With `variance` and `saturated`.
    Photo photo;
    Response response = Response::as_read;
    std::optional<ResponseCurve> curve;  ///< if calibrated
    std::vector<FrameShift> shifts;      ///< one for each shot
    /// Measured over stated ratio of exposures from each shot to the next darker one, 1 where they
    /// agree; empty for one shot.
    std::vector<double> exposure_ratios;
    std::vector<std::string> notes;
};

/// Each pixel is the mean of the shots' values over their exposures with inverse-variance weights
/// (shot noise, read noise, 8-bit rounding). Values near over-exposure fade out, so that no edge
/// appears. A pixel that every shot over-exposes keeps the darkest shot's value and is marked.
///
/// Shots are shifted onto the first (correlation of log-luminance, to 0.1 pixels; smaller shifts
/// are not applied). They are read from the brightest to the darkest, once to analyse and once to
/// add, two at a time; up to 512 MiB of them are kept in between. Throws InputError for different
/// sizes, equal exposures, non-finite samples, or all black.
Bracket merge_bracket(const std::vector<BracketShot>& shots, const BracketOptions& options = {},
                      const Progress& progress = {});

}  // namespace culet
