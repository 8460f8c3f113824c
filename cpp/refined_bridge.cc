#include "refined_bridge.h"

#include "acting_effects.h"
#include "flight_fits.h"
#include "refined_problem.h"
#include "validate.h"

namespace smash {

RefinedSolution solve_refined(const RefinedScene& scene, const RefinedProblem& problem) {
  CheckRefinedProblem(scene, problem);
  return SolveRefined(scene, problem);
}

rust::Vec<RefinedLaunch> launch(const RefinedScene& scene, const RefinedUnknowns& unknowns) {
  CheckUnknowns(scene, unknowns);
  rust::Vec<RefinedLaunch> launches;
  for (const RefinedLaunch& body : Launches(scene, unknowns)) launches.push_back(body);
  return launches;
}

rust::Vec<double> pose_times(const RefinedScene& scene, const RefinedUnknowns& unknowns) {
  CheckUnknowns(scene, unknowns);
  const std::vector<ActingEffects> effects = EffectBodies(scene);
  rust::Vec<double> times_s;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    for (const double time_s : PoseTimes(scene, effects[i], i, unknowns)) times_s.push_back(time_s);
  }
  return times_s;
}

rust::Vec<FlownState> fly(const RefinedScene& scene, const RefinedUnknowns& unknowns,
                          std::size_t body, rust::Slice<const double> stamps_s) {
  CheckUnknowns(scene, unknowns);
  CheckFlown(scene, unknowns, body, stamps_s);
  rust::Vec<FlownState> states;
  for (const FlownState& state : Flown(scene, unknowns, body, stamps_s)) states.push_back(state);
  return states;
}

SpinFit fit_spin(const SpinFlight& flight) {
  CheckSpinFlight(flight);
  return FitSpin(flight);
}

JumpFit fit_jump(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                 const RefinedUnknowns& start) {
  CheckJumps(scene, jumps, start);
  return FitJump(scene, jumps, start);
}

}  // namespace smash
