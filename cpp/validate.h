// The only gate to Ceres: what would make one of its CHECKs end the process is refused here, by
// std::invalid_argument.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "smash/src/bridge/paper.rs.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

// SMASH section 5.1, "synthetic data".
inline constexpr double kSmallestMassRatio = 1e-5;
inline constexpr double kLargestMassRatio = 10.0;
// Of the refined solver: a mass ratio beyond e^20 either way is none.
inline constexpr double kLargestLogMassRatio = 20.0;

// Refuses anything that isn't finite, positive, of unit length, equal in number or within bounds
// where it must be.
void CheckPaperInput(const PaperScene& scene, double collision_frames,
                     const PaperUnknowns& unknowns);

// Refuses a flight of so many frames that it can't be integrated.
void CheckDuration(double frames);

// As CheckPaperInput, for the refined solver and its parts.
void CheckRefinedProblem(const RefinedScene& scene, const RefinedProblem& problem);
void CheckUnknowns(const RefinedScene& scene, const RefinedUnknowns& unknowns);
void CheckFlown(const RefinedScene& scene, const RefinedUnknowns& unknowns, std::size_t body,
                rust::Slice<const double> stamps_s);
void CheckSpinFlight(const SpinFlight& flight);
void CheckJumps(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                const RefinedUnknowns& start);

[[noreturn]] inline void Refuse(const std::string& what) {
  throw std::invalid_argument("invalid input: " + what);
}

template <std::size_t N>
bool AllFinite(const std::array<double, N>& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

// False of what isn't finite, too.
template <std::size_t N>
bool IsUnit(const std::array<double, N>& values) {
  double square = 0.0;
  for (const double value : values) square += value * value;
  return std::abs(std::sqrt(square) - 1.0) < 1e-6;
}

}  // namespace smash
