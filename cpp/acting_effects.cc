#include "acting_effects.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "flight_steps.h"
#include "refined_blocks.h"

namespace smash {
namespace {

// Of a flight that is only looked at, not fitted: errors below 1e-9.
constexpr double kStepRad = 0.01;
constexpr double kStepS = 0.002;
// Some second of work.
constexpr double kMostSteps = 2e6;

Law ToLaw(const ActingLaw& acting) {
  Law law{static_cast<Hook>(acting.hook), acting.registers, acting.result, {}};
  for (const LawInstruction& i : acting.instructions) {
    law.instructions.push_back(
        {static_cast<Operation>(i.operation), i.target, i.left, i.right, i.value});
  }
  law.FindUsed();
  return law;
}

Surroundings SurroundingsOf(const RefinedScene& scene, const RefinedBody& body) {
  const Vector3<double> down = ToVector3(scene.down);
  return {-down,
          scene.gravity_m_s2 * down,
          ToVector3(scene.camera),
          ToVector3(scene.plane_normal),
          ToVector3(body.size),
          {ToVector3(scene.across[0]), ToVector3(scene.across[1])}};
}

// A body's blocks at `unknowns`, as numbers.
struct Numbers {
  Numbers(const RefinedScene& scene, const ActingEffects& effects, std::size_t body,
          const RefinedUnknowns& unknowns)
      : frame(ContactFrameOf(scene, unknowns)) {
    const RefinedMotion& m = unknowns.bodies[body];
    motion.insert(motion.end(), m.position.begin(), m.position.end());
    motion.insert(motion.end(), m.velocity_before.begin(), m.velocity_before.end());
    motion.insert(motion.end(), m.spin_before.begin(), m.spin_before.end());
    orientation.assign(m.orientation.begin(), m.orientation.end());
    tilt.assign(unknowns.tilt.begin(), unknowns.tilt.end());
    const Eigen::VectorXd j = frame.impulse_basis.transpose() * ToVector3(unknowns.impulse);
    impulse.assign(j.data(), j.data() + j.size());
    scalars = {unknowns.collision_time_s, unknowns.log_mass_ratio};
    for (const std::size_t used : effects.used_parameters) {
      scalars.push_back(unknowns.parameters[used]);
    }
  }

  // In the order of EffectBlocks.
  std::vector<const double*> Blocks(std::size_t body, bool is_after) const {
    std::vector<const double*> blocks = {motion.data(), orientation.data(), &scalars[0],
                                         tilt.data()};
    if (is_after) blocks.insert(blocks.end(), {impulse.data(), offset});
    if (body > 0) blocks.push_back(&scalars[1]);
    for (std::size_t i = 2; i < scalars.size(); ++i) blocks.push_back(&scalars[i]);
    return blocks;
  }

  ContactFrame frame;
  std::vector<double> motion, orientation, tilt, impulse;
  double offset[2] = {0.0, 0.0};
  // Collision time, ln m, parameters.
  std::vector<double> scalars;
};

double Finite(double time_s) {
  if (!std::isfinite(time_s)) throw std::runtime_error("an effect's law makes a time infinite");
  return time_s;
}

template <std::size_t N, typename Vector>
std::array<double, N> ToArray(const Vector& v) {
  std::array<double, N> array;
  for (std::size_t i = 0; i < N; ++i) array[i] = v[static_cast<Eigen::Index>(i)];
  return array;
}

// One of a body's flights.
struct Course {
  Course(const RefinedScene& scene, const ActingEffects& effects, const Numbers& numbers,
         std::size_t index, bool is_after)
      : launch(
            effects.body, is_after, numbers.frame,
            EffectBlocks<double>(effects.body, is_after, numbers.Blocks(index, is_after).data())),
        flight(launch.laws, GravityOf(scene).Acceleration(numbers.tilt.data()),
               launch.inertia_per_mass, effects.body.has_spin, is_after, launch.after,
               numbers.scalars[0]) {
    step_s = kStepRad / FastestSpin(launch.inertia_per_mass, launch.after.q, launch.after.l);
    // Parabolas are exact however long the steps.
    if (launch.laws.HasForces()) step_s = std::min(kStepS, step_s);
    reached_s = numbers.scalars[0];
  }

  FlownState At(double stamp_s, double time_s) {
    const double count = std::ceil(std::abs(time_s - reached_s) / step_s);
    steps += count;
    if (!(steps < kMostSteps)) {
      throw std::runtime_error("a flight is too long, or turns too fast, to be followed");
    }
    flight.AdvanceTo(time_s, std::max(1, static_cast<int>(count)));
    reached_s = time_s;
    const FlightState<double>& state = flight.state();
    const Quaternion<double> seen = Turned(state.q, launch.laws.Turn(stamp_s, state));
    return {ToArray<3>(state.p),
            ToArray<3>(state.v),
            ToArray<4>(state.q),
            ToArray<3>(state.l),
            ToArray<3>(launch.laws.Seen(stamp_s, state)),
            ToArray<4>(seen)};
  }

  EffectLaunch<double> launch;
  ForcedFlight<double> flight;
  double step_s, reached_s;
  double steps = 0.0;
};

}  // namespace

bool ActingEffects::HasBeyondStrike() const {
  return std::any_of(body.laws.begin(), body.laws.end(), [](const ActingOn& acting) {
    const Hook hook = acting.law.hook;
    return hook != Hook::kImpulse && hook != Hook::kImpulsePoint && hook != Hook::kAngularImpulse;
  });
}

std::vector<ActingEffects> EffectBodies(const RefinedScene& scene) {
  std::vector<ActingEffects> bodies;
  const bool has_plane = ToVector3(scene.plane_normal).norm() > 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const RefinedBody& body = scene.bodies[i];
    ActingEffects effects{{ToVector3(body.inertia_per_mass),
                           body.has_spin,
                           i == 0,
                           {},
                           0,
                           SurroundingsOf(scene, body),
                           has_plane},
                          {}};
    std::vector<std::size_t>& used = effects.used_parameters;
    for (const ActingLaw& law : scene.laws) {
      if (law.body != i) continue;
      // The laws of one effect share its parameters.
      auto first = std::find(used.begin(), used.end(), law.first_parameter);
      if (law.parameter_count == 0 || first == used.end()) {
        const std::size_t known = used.size();
        used.resize(known + law.parameter_count);
        first = used.begin() + static_cast<std::ptrdiff_t>(known);
        std::iota(first, used.end(), law.first_parameter);
      }
      effects.body.laws.push_back({ToLaw(law), static_cast<int>(law.effect),
                                   static_cast<int>(first - used.begin()),
                                   static_cast<int>(law.parameter_count), law.sign});
    }
    effects.body.parameters = static_cast<int>(used.size());
    bodies.push_back(std::move(effects));
  }
  return bodies;
}

TiltedGravity GravityOf(const RefinedScene& scene) {
  Eigen::Matrix<double, 3, 2> across;
  across << ToVector3(scene.across[0]), ToVector3(scene.across[1]);
  return {scene.gravity_m_s2, ToVector3(scene.down), across};
}

std::vector<double> PoseTimes(const RefinedScene& scene, const ActingEffects& effects,
                              std::size_t body, const RefinedUnknowns& unknowns) {
  const Numbers numbers(scene, effects, body, unknowns);
  const EffectBlocks<double> blocks(effects.body, false, numbers.Blocks(body, false).data());
  EffectLaunch<double> launch(effects.body, false, numbers.frame, blocks);
  std::vector<double> times_s;
  for (const RefinedPose& pose : scene.bodies[body].poses) {
    times_s.push_back(Finite(launch.laws.Time(pose.time_s)));
  }
  return times_s;
}

std::vector<RefinedLaunch> Launches(const RefinedScene& scene, const RefinedUnknowns& unknowns) {
  const std::vector<ActingEffects> bodies = EffectBodies(scene);
  std::vector<RefinedLaunch> launches;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Numbers numbers(scene, bodies[i], i, unknowns);
    const EffectBlocks<double> blocks(bodies[i].body, true, numbers.Blocks(i, true).data());
    const EffectLaunch<double> launch(bodies[i].body, true, numbers.frame, blocks);
    launches.push_back({ToArray<3>(launch.after.v), ToArray<3>(launch.after.l),
                        ToArray<3>(launch.contact_after.v), ToArray<3>(launch.contact_after.l),
                        ToArray<3>(launch.inertia_per_mass)});
  }
  return launches;
}

std::vector<FlownState> Flown(const RefinedScene& scene, const RefinedUnknowns& unknowns,
                              std::size_t body, rust::Slice<const double> stamps_s) {
  const ActingEffects effects = EffectBodies(scene)[body];
  const Numbers numbers(scene, effects, body, unknowns);
  const double collision_s = unknowns.collision_time_s;
  std::vector<FlownState> states(stamps_s.size());
  for (const bool is_after : {false, true}) {
    Course course(scene, effects, numbers, body, is_after);
    // The model's time and the place of each pose of this flight, outwards from the collision.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < stamps_s.size(); ++i) {
      const double time_s = Finite(course.launch.laws.Time(stamps_s[i]));
      if ((time_s >= collision_s) == is_after) order.emplace_back(time_s, i);
    }
    std::sort(order.begin(), order.end());
    if (!is_after) std::reverse(order.begin(), order.end());
    for (const auto& [time_s, i] : order) states[i] = course.At(stamps_s[i], time_s);
  }
  return states;
}

}  // namespace smash
