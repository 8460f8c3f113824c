// How finely flights are integrated.
#pragma once

#include <array>
#include <vector>

#include "refined_summary.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

// The steps of a problem's flights, by how fast the bodies turn at its start.
class FlightSteps {
 public:
  FlightSteps(const RefinedScene& scene, const RefinedProblem& problem);

  // Pairs of steps up to each pose of a flight without effects.
  std::vector<int> Pairs(const Flight& flight) const;
  // Steps up to each pose of a flight with effects, `fineness` times as many as usual.
  std::vector<int> WithEffects(const Flight& flight, int fineness) const;
  // Whether a body turns much faster than at the start.
  bool AreTooLong(const RefinedUnknowns& unknowns) const;

 private:
  double StartOf(const Flight& flight) const;

  const RefinedScene& scene_;
  const RefinedProblem& problem_;
  double step_rad_;
  std::vector<std::array<double, 2>> fastest_;
};

// rad/s, at the most, of a free rotation.
double FastestSpin(const Vector3<double>& inertia_per_mass, const Quaternion<double>& q,
                   const Vector3<double>& l);

// The longest step that keeps the integrator's error far under any annotation's: 5e-7 rad over
// ten rad.
double LongestStep(const Vector3<double>& inertia_per_mass, const Quaternion<double>& q,
                   const Vector3<double>& l);

}  // namespace smash
