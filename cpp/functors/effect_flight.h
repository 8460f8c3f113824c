// One flight of a body with effects: the model of FlightCost with the laws that act on the body,
// for any scalar. Automatic differentiation follows the integration.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/forced_flight.h"
#include "functors/flight.h"

namespace smash {

// A body's flights as effects see them.
struct EffectBody {
  Vector3<double> inertia_per_mass;
  bool has_spin;
  bool is_reference;
  std::vector<ActingOn> laws;
  // How many scalars the laws' parameters have.
  int parameters;
  Surroundings around;
  // Whether the contact's normal is that of a plane.
  bool has_plane;
};

// The parameter blocks are those of the flight, and then one for each scalar of a parameter; the
// mass ratio's is there before the collision, too, since laws may depend on it.
template <typename T>
struct EffectBlocks {
  EffectBlocks(const EffectBody& body, bool is_after, T const* const* blocks)
      : motion(blocks[kMotion]),
        orientation(blocks[kOrientation]),
        time(blocks[kTime]),
        tilt(blocks[kTilt]) {
    int next = kTilt + 1;
    if (is_after) {
      impulse = blocks[next++];
      contact = blocks[next++];
    }
    if (!body.is_reference) log_mass = blocks[next++];
    for (int i = 0; i < body.parameters; ++i) parameters.push_back(blocks[next + i][0]);
  }

  const T *motion, *orientation, *time, *tilt;
  const T *impulse = nullptr, *contact = nullptr, *log_mass = nullptr;
  std::vector<T> parameters;
};

// The body's laws and its state where a flight starts.
template <typename T>
struct EffectLaunch {
  EffectLaunch(const EffectBody& body, bool is_after, const ContactFrame& frame,
               const EffectBlocks<T>& blocks)
      : mass(Mass(blocks)),
        laws(body.laws, body.around, blocks.parameters.data(), mass, blocks.time[0]) {
    inertia_per_mass = body.inertia_per_mass.cast<T>().cwiseProduct(laws.InertiaFactor());
    before.p = AsVector3(blocks.motion);
    before.v = AsVector3(blocks.motion + 3);
    before.l = AsVector3(blocks.motion + 6);
    before.q = AsQuaternion(blocks.orientation);
    contact_after = after = before;
    if (is_after) Kick(body, frame, blocks);
  }

  T mass;
  BodyLaws<T> laws;
  Vector3<T> inertia_per_mass;
  // After the collision, and after what the contact alone does.
  FlightState<T> before, after, contact_after;

 private:
  static T Mass(const EffectBlocks<T>& blocks) {
    using std::exp;
    return blocks.log_mass ? T(exp(blocks.log_mass[0])) : T(1);
  }

  void Kick(const EffectBody& body, const ContactFrame& frame, const EffectBlocks<T>& blocks) {
    Strike<T> strike;
    strike.impulse_on_a = Vector3<T>::Constant(T(0));
    for (Eigen::Index i = 0; i < frame.impulse_basis.cols(); ++i) {
      strike.impulse_on_a += blocks.impulse[i] * frame.impulse_basis.col(i).cast<T>();
    }
    strike.impulse = body.is_reference ? strike.impulse_on_a : Vector3<T>(-strike.impulse_on_a);
    strike.contact_point = frame.contact_origin.cast<T>();
    for (int i = 0; i < 2; ++i) {
      strike.contact_point += blocks.contact[i] * frame.contact_basis.col(i).cast<T>();
    }
    strike.normal = body.around.normal.cast<T>();
    if (!body.has_plane) {
      const T square = strike.impulse_on_a.squaredNorm();
      using std::sqrt;
      if (square > T(0)) strike.normal = strike.impulse_on_a / T(sqrt(square));
    }
    const Vector3<T> kick = strike.impulse / mass;
    const Vector3<T> lever = strike.contact_point - before.p;
    after.v += kick;
    after.l += lever.cross(kick);
    contact_after = after;
    Vector3<T> omega = Vector3<T>::Constant(T(0));
    if (body.has_spin) {
      omega = AngularVelocity(before.q, before.l, Vector3<T>(inertia_per_mass.cwiseInverse()));
    }
    laws.Strike(strike, before, omega, mass, false, &contact_after);
    laws.Strike(strike, before, omega, mass, true, &after);
  }
};

// q Exp(turn), for any scalar.
template <typename T>
Quaternion<T> Turned(const Quaternion<T>& q, const Vector3<T>& turn) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T square = turn.squaredNorm();
  T real = T(1) - square / T(8);
  T scale = T(0.5) - square / T(48);
  if (square > T(kSmallAngleRad * kSmallAngleRad)) {
    const T angle = sqrt(square);
    real = cos(T(0.5) * angle);
    scale = sin(T(0.5) * angle) / angle;
  }
  return Multiply(q, Quaternion<T>(real, scale * turn[0], scale * turn[1], scale * turn[2]));
}

// As ceres::DynamicAutoDiffCostFunction wants it. Residuals as FlightCost has them.
class EffectFlight {
 public:
  // `poses` outwards from the collision; `steps[i]` steps lead to pose i from the one before it,
  // whatever the unknowns are: the residuals are smooth.
  EffectFlight(const EffectBody& body, bool is_after, const TiltedGravity& gravity,
               const ContactFrame& contact, const std::vector<FlightPose>& poses,
               std::vector<int> steps)
      : body_(body),
        is_after_(is_after),
        gravity_(gravity),
        contact_(contact),
        poses_(poses),
        steps_(std::move(steps)) {}

  template <typename T>
  bool operator()(T const* const* values, T* residuals) const {
    const EffectBlocks<T> blocks(body_, is_after_, values);
    EffectLaunch<T> launch(body_, is_after_, contact_, blocks);
    ForcedFlight<T> flight(launch.laws, Gravity(blocks.tilt), launch.inertia_per_mass,
                           body_.has_spin, is_after_, launch.after, blocks.time[0]);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const FlightPose& pose = poses_[i];
      flight.AdvanceTo(launch.laws.Time(pose.time_s), steps_[i]);
      const FlightState<T>& state = flight.state();
      const Vector3<T> seen = launch.laws.Seen(pose.time_s, state);
      Store((seen - pose.position.cast<T>()) / T(pose.position_std_m), residuals);
      residuals += 3;
      if (!body_.has_spin || !pose.has_orientation) continue;
      Quaternion<T> q = state.q;
      if (launch.laws.Has(Hook::kOrientation)) {
        q = Turned(q, launch.laws.Turn(pose.time_s, state));
      }
      const Quaternion<T> inverse = Conjugate(pose.world_from_body).template cast<T>();
      Store(LogRotation(Multiply(inverse, q)) / T(pose.orientation_std_rad), residuals);
      residuals += 3;
    }
    return true;
  }

 private:
  template <typename T>
  Vector3<T> Gravity(const T* tilt) const {
    Vector3<T> direction = gravity_.down.cast<T>();
    for (int i = 0; i < 2; ++i) direction += tilt[i] * gravity_.across.col(i).cast<T>();
    return T(gravity_.strength_m_s2) * (direction / T(direction.norm()));
  }

  const EffectBody& body_;
  bool is_after_;
  TiltedGravity gravity_;
  ContactFrame contact_;
  std::vector<FlightPose> poses_;
  std::vector<int> steps_;
};

}  // namespace smash
