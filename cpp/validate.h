// The only gate to Ceres: what would make one of its CHECKs end the process is refused here.
#pragma once

#include "smash/src/bridge/paper.rs.h"

namespace smash {

// SMASH section 5.1, "synthetic data".
inline constexpr double kSmallestMassRatio = 1e-5;
inline constexpr double kLargestMassRatio = 10.0;

// Throws std::invalid_argument on anything that isn't finite, positive, of unit length, equal in
// number or within bounds where it must be.
void CheckPaperInput(const PaperScene& scene, double collision_frames,
                     const PaperUnknowns& unknowns);

// Throws std::invalid_argument unless a flight of so many frames can be integrated.
void CheckDuration(double frames);

}  // namespace smash
