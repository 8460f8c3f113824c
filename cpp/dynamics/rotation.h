// Rotation without torque: constant angular momentum, explicit Euler steps (SMASH eq. 8 to 10).
#pragma once

#include <cmath>

#include "dynamics/vector.h"

namespace smash {

// Hamilton's product (0, v) q.
template <typename T>
Quaternion<T> MultiplyPure(const Vector3<T>& v, const Quaternion<T>& q) {
  const Vector3<T> u = q.template tail<3>();
  const Vector3<T> imaginary = q[0] * v + v.cross(u);
  return Quaternion<T>(-v.dot(u), imaginary[0], imaginary[1], imaginary[2]);
}

// v turned by the unit quaternion {w, u}: v + 2 u x (u x v + w v).
template <typename T>
Vector3<T> Rotate(const T& w, const Vector3<T>& u, const Vector3<T>& v) {
  const Vector3<T> inner = u.cross(v) + w * v;
  return v + T(2) * u.cross(inner);
}

// omega = R I0^-1 R^T k in the world (eq. 9), rad/s. `inverse_inertia`: of the principal moments,
// 1/(kg m^2).
template <typename T>
Vector3<T> AngularVelocity(const Quaternion<T>& world_from_body, const Vector3<T>& k_in_world,
                           const Vector3<T>& inverse_inertia) {
  const Vector3<T> axis = world_from_body.template tail<3>();
  const Vector3<T> conjugate_axis = -axis;
  const Vector3<T> k_in_body = Rotate(world_from_body[0], conjugate_axis, k_in_world);
  const Vector3<T> omega_in_body = k_in_body.cwiseProduct(inverse_inertia);
  return Rotate(world_from_body[0], axis, omega_in_body);
}

// `steps` equal Euler steps of eq. 10 over `duration_s` (negative: backwards). Unit length is
// restored after each: without it the error in the mass ratio is about 2.5 times larger.
template <typename T>
Quaternion<T> EulerRotation(Quaternion<T> world_from_body, const Vector3<T>& k_in_world,
                            const Vector3<T>& inertia, double duration_s, int steps) {
  const Vector3<T> inverse_inertia = inertia.cwiseInverse();
  const double half_step_s = 0.5 * duration_s / steps;
  for (int step = 0; step < steps; ++step) {
    const Vector3<T> omega = AngularVelocity(world_from_body, k_in_world, inverse_inertia);
    const Quaternion<T> moved =
        world_from_body + MultiplyPure(Vector3<T>(omega * T(half_step_s)), world_from_body);
    world_from_body = moved / moved.norm();
  }
  return world_from_body;
}

// The paper's number of steps: none longer than a quarter of a frame (section 4.2).
inline int EulerSteps(double frames) { return static_cast<int>(std::ceil(4.0 * std::abs(frames))); }

}  // namespace smash
