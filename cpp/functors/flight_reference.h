// The residuals of FlightCost once more, for any scalar: automatic differentiation of them is the
// reference that tests hold the hand-made derivatives against. Only tests use it.
#pragma once

#include <ceres/rotation.h>

#include "functors/flight.h"

namespace smash {

// As ceres::DynamicAutoDiffCostFunction wants it; the blocks are those of `cost`, which must
// outlive it. It takes the same steps, so that the values are the same to rounding.
class FlightReference {
 public:
  explicit FlightReference(const FlightCost& cost) : cost_(cost) {}

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    const T collision_s = blocks[kTime][0];
    const Vector3<T> gravity = Gravity(blocks[kTilt]);
    const Vector3<T> position = AsVector3(blocks[kMotion]);
    Vector3<T> velocity = AsVector3(blocks[kMotion] + 3);
    Vector3<T> spin = AsVector3(blocks[kMotion] + 6);
    if (cost_.is_after_) {
      const Vector3<T> kick = Kick(blocks);
      velocity += kick;
      spin += Vector3<T>(ContactPoint(blocks[kContact]) - position).cross(kick);
    }
    Quaternion<T> q = AsQuaternion(blocks[kOrientation]);
    T rotated_s = collision_s;
    int pairs = 0;
    for (std::size_t i = 0; i < cost_.poses_.size(); ++i) {
      const FlightPose& pose = cost_.poses_[i];
      const T t = T(pose.time_s) - collision_s;
      const Vector3<T> moved = position + t * velocity + (T(0.5) * t * t) * gravity;
      Store((moved - pose.position.cast<T>()) / T(pose.position_std_m), residuals);
      residuals += 3;
      pairs += cost_.pairs_[i];
      if (!cost_.SeesSpin(pose)) continue;
      q = Advanced(q, spin, T(pose.time_s) - rotated_s, pairs);
      rotated_s = T(pose.time_s);
      pairs = 0;
      const Quaternion<T> inverse = Conjugate(pose.world_from_body).cast<T>();
      Store(LogRotation(Multiply(inverse, q)) / T(pose.orientation_std_rad), residuals);
      residuals += 3;
    }
    return true;
  }

 private:
  template <typename T>
  Vector3<T> Gravity(const T* tilt) const {
    const TiltedGravity& gravity = cost_.gravity_;
    const Vector3<T> direction =
        gravity.down.cast<T>() +
        gravity.across.cast<T>() * Eigen::Map<const Eigen::Matrix<T, 2, 1>>(tilt);
    return T(gravity.strength_m_s2) * (direction / direction.norm());
  }

  // The jump in velocity.
  template <typename T>
  Vector3<T> Kick(T const* const* blocks) const {
    using std::exp;
    const T push = cost_.body_.is_reference ? T(1.0) : T(-exp(-blocks[kLogMass][0]));
    Vector3<T> impulse = Vector3<T>::Zero();
    for (int i = 0; i < cost_.ImpulseSize(); ++i) {
      impulse += blocks[kImpulse][i] * cost_.contact_.impulse_basis.col(i).cast<T>();
    }
    return push * impulse;
  }

  template <typename T>
  Vector3<T> ContactPoint(const T* offset) const {
    return cost_.contact_.contact_origin.cast<T>() +
           cost_.contact_.contact_basis.cast<T>() *
               Eigen::Map<const Eigen::Matrix<T, 2, 1>>(offset);
  }

  // A constant spin where inertia is isotropic, as rotations by an axis and an angle; else the
  // steps themselves.
  template <typename T>
  Quaternion<T> Advanced(Quaternion<T> q, const Vector3<T>& spin, const T& duration_s,
                         int pairs) const {
    const Vector3<double> inverse = cost_.body_.inertia_per_mass.cwiseInverse();
    if (inverse[0] == inverse[1] && inverse[1] == inverse[2]) {
      const Vector3<T> turn = (T(inverse[0]) * duration_s) * spin;
      Quaternion<T> turned;
      ceres::AngleAxisToQuaternion(turn.data(), turned.data());
      return Multiply(turned, q);
    }
    const Vector3<T> inverse_inertia = inverse.cast<T>();
    const T step_s = duration_s / T(2.0 * pairs);
    for (int step = 0; step < 2 * pairs; ++step) {
      q = RungeKuttaStep(q, spin, inverse_inertia, step_s);
    }
    return q;
  }

  const FlightCost& cost_;
};

}  // namespace smash
