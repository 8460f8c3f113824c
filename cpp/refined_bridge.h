// What Rust calls of the refined solver. Plain data in, plain data out; every failure is an
// exception, which the generated code turns into a Result.
#pragma once

#include "bridge.h"
#include "rust/cxx.h"

namespace smash {

struct Jump;
struct JumpFit;
struct RefinedProblem;
struct RefinedScene;
struct RefinedSolution;
struct RefinedUnknowns;
struct SpinFit;
struct SpinFlight;

RefinedSolution solve_refined(const RefinedScene& scene, const RefinedProblem& problem);

SpinFit fit_spin(const SpinFlight& flight);

JumpFit fit_jump(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                 const RefinedUnknowns& start);

}  // namespace smash
