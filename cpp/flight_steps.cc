#include "flight_steps.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "acting_effects.h"

namespace smash {
namespace {

// Radians a step, at the body's fastest: some 1e-6 rad of error in a flight, a thousandth of a
// deviation of this size.
constexpr double kLargestStepRad = 0.12;
constexpr double kUsualDeviationRad = 1e-3;
// Of the largest step; shorter ones are for what no orientation tells.
constexpr double kShortestStep = 0.15;

// Of an effect's flight, whose position needs steps too: with these the integrator's error is some
// 1e-7 rad and less.
constexpr double kEffectStepS = 0.02;
// Of one flight with effects.
constexpr double kMostEffectSteps = 2e4;
// A search ends where a body with effects turns farther in a flight than twelve turns a second and
// two a pose: from its own poses it starts with six a second, or half a turn a pose, at most.
constexpr double kFastestRadPerS = 75.0;
constexpr double kMostRadAPose = 12.5;
// How much faster than at the start a body may turn with the start's steps.
constexpr double kMuchFaster = 1.0 / 0.7;

// Radians a step for orientations as exact as these: the error goes with the step's fourth power.
double StepRad(const RefinedScene& scene) {
  double finest_rad = kUsualDeviationRad;
  for (const RefinedBody& body : scene.bodies) {
    for (const RefinedPose& pose : body.poses) {
      if (pose.has_orientation) finest_rad = std::min(finest_rad, pose.orientation_std_rad);
    }
  }
  const double share = std::pow(finest_rad / kUsualDeviationRad, 0.25);
  return kLargestStepRad * std::max(kShortestStep, share);
}

// Of each body, before and after the collision with all that strikes there.
std::vector<std::array<double, 2>> FastestSpins(const RefinedScene& scene,
                                                const RefinedUnknowns& unknowns) {
  const std::vector<RefinedLaunch> launched = Launches(scene, unknowns);
  std::vector<std::array<double, 2>> fastest;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const RefinedMotion& motion = unknowns.bodies[i];
    const Quaternion<double> q = ToQuaternion(motion.orientation);
    fastest.push_back(
        {FastestSpin(ToVector3(scene.bodies[i].inertia_per_mass), q, ToVector3(motion.spin_before)),
         FastestSpin(ToVector3(launched[i].inertia_per_mass), q,
                     ToVector3(launched[i].spin_after))});
  }
  return fastest;
}

}  // namespace

FlightSteps::FlightSteps(const RefinedScene& scene, const RefinedProblem& problem)
    : scene_(scene),
      problem_(problem),
      step_rad_(StepRad(scene)),
      fastest_(FastestSpins(scene, problem.start)) {}

std::vector<int> FlightSteps::Pairs(const Flight& flight) const {
  const double step_s = step_rad_ / fastest_[flight.body][flight.is_after];
  std::vector<int> pairs;
  double reached_s = StartOf(flight);
  for (const FlightPose& pose : flight.poses) {
    pairs.push_back(FreeRotation::Pairs(pose.time_s - reached_s, step_s));
    reached_s = pose.time_s;
  }
  return pairs;
}

std::vector<int> FlightSteps::WithEffects(const Flight& flight, int fineness) const {
  const double fastest = fastest_[flight.body][flight.is_after];
  const double step_s = std::min(step_rad_ / fastest, kEffectStepS) / fineness;
  double reached_s = StartOf(flight);
  const double span_s = std::abs(flight.poses.back().time_s - reached_s);
  if (!(span_s / step_s < kMostEffectSteps)) {
    throw std::runtime_error("a flight is too long, or turns too fast, to be followed");
  }
  // About its largest axis a body of this energy turns slowest. To look at it once is cheap.
  const Vector3<double> inertia = ToVector3(scene_.bodies[flight.body].inertia_per_mass);
  const double slowest = fastest * std::sqrt(inertia.minCoeff() / inertia.maxCoeff());
  const double most_rad =
      kFastestRadPerS * span_s + kMostRadAPose * static_cast<double>(flight.poses.size());
  if (problem_.most_iterations > 0 && slowest * span_s > most_rad) {
    throw std::runtime_error("a body turns too fast for its poses to tell how");
  }
  std::vector<int> steps;
  for (const FlightPose& pose : flight.poses) {
    const double count = std::ceil(std::abs(pose.time_s - reached_s) / step_s);
    steps.push_back(std::max(1, static_cast<int>(count)));
    reached_s = pose.time_s;
  }
  return steps;
}

bool FlightSteps::AreTooLong(const RefinedUnknowns& unknowns) const {
  const auto now = FastestSpins(scene_, unknowns);
  for (std::size_t i = 0; i < now.size(); ++i) {
    for (const std::size_t side : {0UL, 1UL}) {
      if (now[i][side] > kMuchFaster * fastest_[i][side]) return true;
    }
  }
  return false;
}

// The farther end of the segment that its collision is in.
double FlightSteps::StartOf(const Flight& flight) const {
  return flight.is_after ? problem_.earliest_s : problem_.latest_s;
}

double FastestSpin(const Vector3<double>& inertia_per_mass, const Quaternion<double>& q,
                   const Vector3<double>& l) {
  // The energy l.omega is constant: omega^2 is at most l.omega / I_min.
  const Vector3<double> omega =
      AngularVelocity(q, l, Vector3<double>(inertia_per_mass.cwiseInverse()));
  return std::max(1e-6, std::sqrt(std::max(0.0, l.dot(omega)) / inertia_per_mass.minCoeff()));
}

double LongestStep(const Vector3<double>& inertia_per_mass, const Quaternion<double>& q,
                   const Vector3<double>& l) {
  return kLargestStepRad / FastestSpin(inertia_per_mass, q, l);
}

}  // namespace smash
