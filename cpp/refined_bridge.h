// What Rust calls of the refined solver. Plain data in, plain data out; every failure is an
// exception, which the generated code turns into a Result.
#pragma once

#include "bridge.h"
#include "rust/cxx.h"

namespace smash {

struct FlownState;
struct Jump;
struct JumpFit;
struct RefinedLaunch;
struct RefinedProblem;
struct RefinedScene;
struct RefinedSolution;
struct RefinedUnknowns;
struct SpinFit;
struct SpinFlight;

RefinedSolution solve_refined(const RefinedScene& scene, const RefinedProblem& problem);

rust::Vec<RefinedLaunch> launch(const RefinedScene& scene, const RefinedUnknowns& unknowns);

rust::Vec<double> pose_times(const RefinedScene& scene, const RefinedUnknowns& unknowns);

rust::Vec<FlownState> fly(const RefinedScene& scene, const RefinedUnknowns& unknowns,
                          std::size_t body, rust::Slice<const double> stamps_s);

SpinFit fit_spin(const SpinFlight& flight);

JumpFit fit_jump(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                 const RefinedUnknowns& start);

}  // namespace smash
