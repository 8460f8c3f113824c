#include "refined_bridge.h"

#include "flight_fits.h"
#include "refined_problem.h"
#include "validate.h"

namespace smash {

RefinedSolution solve_refined(const RefinedScene& scene, const RefinedProblem& problem) {
  CheckRefinedProblem(scene, problem);
  return SolveRefined(scene, problem);
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
