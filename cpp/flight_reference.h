// What the tests call: the hand-made derivatives of FlightCost beside automatic ones. No program
// refers to it, so that the linker leaves it out.
#pragma once

#include "rust/cxx.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

struct FlightDifference;

FlightDifference compare_flights(const RefinedScene& scene, const RefinedProblem& problem);

}  // namespace smash
