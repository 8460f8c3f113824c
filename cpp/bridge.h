// What Rust calls. Plain data in, plain data out; every failure is an exception, which the
// generated code turns into a Result.
#pragma once

#include <cstddef>
#include <exception>

#include "rust/cxx.h"

namespace smash {

struct PaperScene;
struct PaperUnknowns;
struct PaperSolution;
struct PaperPose;
struct PaperVelocities;
enum class PaperPhase : ::std::uint8_t;

PaperSolution solve_paper_phase(const PaperScene& scene, double collision_frames, PaperPhase phase,
                                const PaperUnknowns& start);

rust::Vec<PaperPose> predict_paper_poses(const PaperScene& scene, double collision_frames,
                                         const PaperUnknowns& unknowns, std::size_t body,
                                         rust::Slice<const double> times_frames);

PaperVelocities paper_collision_velocities(const PaperScene& scene, const PaperUnknowns& unknowns,
                                           std::size_t body);

rust::String ceres_version();

void silence_ceres_log();

}  // namespace smash

// Without this only std::exception becomes an Err, and anything else ends the process.
namespace rust::behavior {
template <typename Try, typename Fail>
void trycatch(Try&& attempt, Fail&& fail) noexcept {
  try {
    attempt();
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("an exception that isn't a std::exception");
  }
}
}  // namespace rust::behavior
