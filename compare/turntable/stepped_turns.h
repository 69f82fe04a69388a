#pragma once
// How a turntable stepped: evenly but for single steps that are missing, doubled or of another
// size.

#include <cstddef>
#include <vector>

namespace culet {

struct TurnJump {
    std::size_t before = 0;  ///< between this picture and the next
    double steps = 0;        ///< that the turntable made there beyond the expected ones
};

struct SteppedTurns {
    std::vector<double> turns;  ///< without the wobble of single pictures
    double scale = 1;           ///< of the given steps
    std::vector<TurnJump> jumps;
};

/// `given`: turns by even steps; `found`: turns that pictures show, each by itself.
SteppedTurns stepped_turns(const std::vector<double>& given, const std::vector<double>& found);

}  // namespace culet
