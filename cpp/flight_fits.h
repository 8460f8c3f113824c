// Small fits that lead to the start of the refined solver, each by ceres::TinySolver.
#pragma once

#include "smash/src/bridge/refined.rs.h"

namespace smash {

// A flight's rotation from its own poses, which have passed CheckSpinFlight: first the nearest two,
// then twice as many, and so on; each fit tells the next pose to well within half a turn.
SpinFit FitSpin(const SpinFlight& flight);

// The impulse, line of action and mass ratio that explain the jumps, which have passed
// CheckJumps.
JumpFit FitJump(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                const RefinedUnknowns& start);

}  // namespace smash
