// The paper's energy (SMASH eq. 16) as a ceres::Problem, phase by phase.
#pragma once

#include "smash/src/bridge/paper.rs.h"

namespace smash {

// Minimises the energy of `phase` from `start`, which has passed CheckPaperInput. Throws
// std::runtime_error when no usable solution is found.
PaperSolution SolvePaperPhase(const PaperScene& scene, double collision_frames, PaperPhase phase,
                              const PaperUnknowns& start);

}  // namespace smash
