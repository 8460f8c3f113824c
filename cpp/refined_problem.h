// The refined solver's chi-square as a ceres::Problem.
#pragma once

#include <functional>

#include "refined_blocks.h"
#include "refined_summary.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

// Minimises from the start, all of which has passed CheckRefinedProblem. Throws std::runtime_error
// when no usable solution is found.
RefinedSolution SolveRefined(const RefinedScene& scene, const RefinedProblem& problem);

// Calls `visit` with each flight of the problem, its blocks at the start.
void VisitFlights(const RefinedScene& scene, const RefinedProblem& problem,
                  const std::function<void(const Flight&)>& visit);

FlightPose ToFlightPose(const RefinedPose& pose);

}  // namespace smash
