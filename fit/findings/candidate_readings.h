#pragma once
// What could be read next of a stone. Private to the room: shows Eigen.

#include <memory>
#include <string>
#include <vector>

#include "fit/findings/assessment.h"
#include "fit/model/fit_model.h"
#include "fit/model/linear.h"

namespace culet {

/// A reading that was not made, as a linear function of the unknowns. In the scale of the fit.
struct CandidateReading {
    NextReading reading;
    FunctionRow function;
    double sigma = 0;
    std::string group;                 ///< kind and tier
    double variance = 0, promise = 0;  ///< for whoever chooses among them
};

/// Every inclination and azimuth, edge lengths, widths all around, depth, table widths and weight
/// (or volume), as far as the tools are at hand; each with the median sigma of the readings like
/// it.
std::vector<CandidateReading> candidate_readings(const FitModel& model, const Shape& shape,
                                                 const std::shared_ptr<const Outline>& outline);

}  // namespace culet
