// What the result rests on: cost, residuals and information at the optimum.
#pragma once

#include "refined_blocks.h"

namespace smash {

// A flight of the problem.
struct Flight {
  std::size_t body;
  bool is_after;
  // Owned by the ceres::Problem.
  FlightCost* cost;
};

// Fills them into `solution`, from one evaluation of each flight.
void Summarise(const RefinedScene& scene, const std::vector<Flight>& flights, RefinedBlocks& blocks,
               RefinedSolution& solution);

}  // namespace smash
