#include <algorithm>
#include <cmath>

#include "dynamics/law.h"
#include "dynamics/vector.h"
#include "validate.h"

namespace smash {
namespace {

// Three thousand turns; one evaluation of a flight takes some ten milliseconds then.
constexpr double kLargestTurningRad = 2e4;

bool IsPositive(double value) { return value > 0 && std::isfinite(value); }

void CheckInertia(const std::array<double, 3>& inertia_per_mass) {
  for (const double moment : inertia_per_mass) {
    if (!IsPositive(moment)) Refuse("a moment of inertia isn't positive");
  }
}

void CheckPose(const RefinedPose& pose) {
  if (!std::isfinite(pose.time_s) || !AllFinite(pose.position) || !AllFinite(pose.orientation)) {
    Refuse("a pose that isn't finite");
  }
  if (!IsPositive(pose.position_std_m) || !IsPositive(pose.orientation_std_rad)) {
    Refuse("a standard deviation that isn't positive");
  }
  if (pose.has_orientation && !IsUnit(pose.orientation)) Refuse("an orientation isn't of length 1");
}

// A start whose rotation would take too many steps. `omega` is bounded by l / I_min.
void CheckTurning(const std::array<double, 3>& inertia_per_mass, double spin, double duration_s) {
  const double least = *std::min_element(inertia_per_mass.begin(), inertia_per_mass.end());
  if (!(spin / least * std::abs(duration_s) < kLargestTurningRad)) {
    Refuse("a spin is too fast to be integrated");
  }
}

// A register beyond its law's would be memory of somebody else's.
void CheckLaw(const RefinedScene& scene, const ActingLaw& law, std::size_t parameters) {
  if (law.body >= scene.bodies.size() || law.hook >= kHooks || !std::isfinite(law.sign)) {
    Refuse("a law on no body or of no kind");
  }
  if (law.first_parameter > parameters || law.parameter_count > parameters - law.first_parameter ||
      kInputs + law.parameter_count > law.registers) {
    Refuse("a law with too few parameters");
  }
  const auto check = [&](int place, int size) {
    if (place + size > law.registers) Refuse("a law reads a register that it hasn't got");
  };
  const auto hook = static_cast<Hook>(law.hook);
  check(law.result, hook == Hook::kTime || hook == Hook::kEventTime ? 1 : 3);
  for (const LawInstruction& i : law.instructions) {
    if (i.operation >= static_cast<std::uint8_t>(Operation::kEnd)) {
      Refuse("a law with an unknown operation");
    }
    const OperandSizes sizes = SizesOf(static_cast<Operation>(i.operation));
    check(i.target, sizes.target);
    check(i.left, sizes.left);
    check(i.right, sizes.right);
    if (i.target < kInputs + law.parameter_count || !std::isfinite(i.value)) {
      Refuse("a law that writes over what it is given");
    }
  }
}

}  // namespace

void CheckUnknowns(const RefinedScene& scene, const RefinedUnknowns& unknowns) {
  if (scene.bodies.empty() || scene.bodies.size() > 2) Refuse("there must be one or two bodies");
  if (unknowns.bodies.size() != scene.bodies.size()) Refuse("unknowns and bodies differ in number");
  for (const RefinedMotion& body : unknowns.bodies) {
    if (!AllFinite(body.position) || !AllFinite(body.velocity_before) ||
        !AllFinite(body.spin_before) || !IsUnit(body.orientation)) {
      Refuse("a start that isn't finite or of unit length");
    }
  }
  if (!AllFinite(unknowns.tilt) || !AllFinite(unknowns.impulse) ||
      !AllFinite(unknowns.contact_point) ||
      // Derivatives step beyond the bound.
      !(std::abs(unknowns.log_mass_ratio) <= kLargestLogMassRatio + 1)) {
    Refuse("a start that isn't finite");
  }
  const bool has_plane = scene.plane_normal != std::array<double, 3>{};
  if (has_plane && !IsUnit(scene.plane_normal)) Refuse("a plane's normal isn't of length 1");
  if (!(scene.gravity_m_s2 >= 0 && std::isfinite(scene.gravity_m_s2)) ||
      !IsPositive(scene.tilt_std_rad)) {
    Refuse("gravity is negative or not finite, or its tilt's deviation isn't positive");
  }
  if (!IsUnit(scene.down) || !IsUnit(scene.across[0]) || !IsUnit(scene.across[1])) {
    Refuse("an axis of gravity isn't of length 1");
  }
  if (!AllFinite(scene.camera)) Refuse("a camera that isn't finite");
  for (const RefinedBody& body : scene.bodies) {
    CheckInertia(body.inertia_per_mass);
    if (!AllFinite(body.size)) Refuse("a size that isn't finite");
  }
  for (const double parameter : unknowns.parameters) {
    if (!std::isfinite(parameter)) Refuse("an effect's parameter isn't finite");
  }
  for (const ActingLaw& law : scene.laws) CheckLaw(scene, law, unknowns.parameters.size());
}

void CheckRefinedProblem(const RefinedScene& scene, const RefinedProblem& problem) {
  CheckUnknowns(scene, problem.start);
  if (scene.parameters.size() != problem.start.parameters.size()) {
    Refuse("parameters and their rules differ in number");
  }
  for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
    const ParameterRule& rule = scene.parameters[i];
    const double value = problem.start.parameters[i];
    if (!rule.held && !(rule.low <= value && value <= rule.high && rule.low < rule.high)) {
      Refuse("an effect's parameter starts out of its bounds");
    }
  }
  if (!(std::abs(problem.start.log_mass_ratio) <= kLargestLogMassRatio)) {
    Refuse("a start that isn't finite");
  }
  const double time_s = problem.start.collision_time_s;
  if (!(problem.earliest_s <= time_s && time_s <= problem.latest_s &&
        problem.earliest_s < problem.latest_s && std::isfinite(problem.earliest_s) &&
        std::isfinite(problem.latest_s))) {
    Refuse("the collision time is out of its bounds");
  }
  if (!std::isfinite(problem.restitution.value) || !std::isfinite(problem.restitution.weight)) {
    Refuse("the restitution isn't finite");
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const RefinedBody& body = scene.bodies[i];
    if (body.poses.empty()) Refuse("a body without poses");
    if (!std::is_sorted(
            body.poses.begin(), body.poses.end(),
            [](const RefinedPose& a, const RefinedPose& b) { return a.time_s < b.time_s; })) {
      Refuse("poses out of order");
    }
    const RefinedMotion& start = problem.start.bodies[i];
    const double mass = i == 0 ? 1.0 : std::exp(problem.start.log_mass_ratio);
    const double lever =
        (ToVector3(problem.start.contact_point) - ToVector3(start.position)).norm();
    const double spin = ToVector3(start.spin_before).norm() +
                        lever * ToVector3(problem.start.impulse).norm() / mass;
    for (const RefinedPose& pose : body.poses) {
      CheckPose(pose);
      CheckTurning(body.inertia_per_mass, spin, pose.time_s - problem.earliest_s);
      CheckTurning(body.inertia_per_mass, spin, pose.time_s - problem.latest_s);
    }
  }
}

void CheckFlown(const RefinedScene& scene, const RefinedUnknowns& unknowns, std::size_t body,
                rust::Slice<const double> stamps_s) {
  if (body >= scene.bodies.size()) Refuse("there is no such body");
  const RefinedMotion& motion = unknowns.bodies[body];
  const double lever = (ToVector3(unknowns.contact_point) - ToVector3(motion.position)).norm();
  const double mass = body == 0 ? 1.0 : std::exp(unknowns.log_mass_ratio);
  const double spin =
      ToVector3(motion.spin_before).norm() + lever * ToVector3(unknowns.impulse).norm() / mass;
  for (const double stamp_s : stamps_s) {
    if (!std::isfinite(stamp_s)) Refuse("a time that isn't finite");
    CheckTurning(scene.bodies[body].inertia_per_mass, spin, stamp_s - unknowns.collision_time_s);
  }
}

void CheckSpinFlight(const SpinFlight& flight) {
  CheckInertia(flight.inertia_per_mass);
  if (!std::isfinite(flight.collision_time_s) || !AllFinite(flight.spin)) {
    Refuse("a start that isn't finite");
  }
  std::size_t seen = 0;
  for (const RefinedPose& pose : flight.poses) {
    CheckPose(pose);
    CheckTurning(flight.inertia_per_mass, ToVector3(flight.spin).norm(),
                 pose.time_s - flight.collision_time_s);
    seen += pose.has_orientation ? 1 : 0;
  }
  if (seen == 0) Refuse("a flight without orientations");
}

void CheckJumps(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                const RefinedUnknowns& start) {
  CheckUnknowns(scene, start);
  if (jumps.size() != scene.bodies.size()) Refuse("jumps and bodies differ in number");
  for (const Jump& jump : jumps) {
    if (!AllFinite(jump.position) || !AllFinite(jump.velocity) || !AllFinite(jump.spin) ||
        !AllFinite(jump.velocity_weight) || !AllFinite(jump.spin_weight)) {
      Refuse("a jump that isn't finite");
    }
  }
}

}  // namespace smash
