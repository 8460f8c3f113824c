// What the result rests on: cost, residuals and information at the optimum.
#pragma once

#include "refined_blocks.h"

namespace smash {

// A flight of the problem.
struct Flight {
  std::size_t body;
  bool is_after;
  // Owned by the ceres::Problem.
  ceres::CostFunction* cost;
  // Outwards from the collision.
  std::vector<FlightPose> poses;
  std::vector<Block*> blocks;

  // How many residuals a pose has.
  int Rows(const RefinedScene& scene, const FlightPose& pose) const {
    return scene.bodies[body].has_spin && pose.has_orientation ? 6 : 3;
  }
};

// Fills them into `solution`, from one evaluation of each flight; the Jacobian as far as it is
// asked for.
void Summarise(const RefinedScene& scene, const std::vector<Flight>& flights,
               const RefinedBlocks& blocks, JacobianBy jacobian_by, RefinedSolution& solution);

}  // namespace smash
