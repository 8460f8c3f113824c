// What the tests call: derivatives made in one way beside those made in another. No program refers
// to it, so that the linker leaves it out.
#pragma once

#include "rust/cxx.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

struct FlightDifference;

// The hand-made derivatives of FlightCost beside automatic ones.
FlightDifference compare_flights(const RefinedScene& scene, const RefinedProblem& problem);

// The automatic derivatives of EffectFlight beside central differences.
FlightDifference difference_effects(const RefinedScene& scene, const RefinedProblem& problem);

}  // namespace smash
