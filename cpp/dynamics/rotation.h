// Rotation without torque: constant angular momentum, explicit Euler steps (SMASH eq. 8 to 10).
#pragma once

#include <cmath>

#include "dynamics/vector.h"

namespace smash {

// Hamilton's product p q.
template <typename T>
Quaternion<T> Multiply(const Quaternion<T>& p, const Quaternion<T>& q) {
  return Quaternion<T>(p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
                       p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                       p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
                       p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]);
}

// v turned by the unit quaternion {w, u}: v + 2 u x (u x v + w v).
template <typename T>
Vector3<T> Rotate(const T& w, const Vector3<T>& u, const Vector3<T>& v) {
  const Vector3<T> inner = u.cross(v) + w * v;
  return v + T(2) * u.cross(inner);
}

// omega = R I0^-1 R^T k in the world (eq. 9), rad/s. `inertia`: principal moments in kg m^2.
template <typename T>
Vector3<T> AngularVelocity(const Quaternion<T>& world_from_body, const Vector3<T>& k_in_world,
                           const Vector3<T>& inertia) {
  const Vector3<T> axis = world_from_body.template tail<3>();
  const Vector3<T> conjugate_axis = -axis;
  const Vector3<T> k_in_body = Rotate(world_from_body[0], conjugate_axis, k_in_world);
  const Vector3<T> omega_in_body = k_in_body.cwiseQuotient(inertia);
  return Rotate(world_from_body[0], axis, omega_in_body);
}

// `steps` equal Euler steps of eq. 10 over `duration_s` (negative: backwards). Unit length is
// restored after each: without it the error in the mass ratio is about 2.5 times larger.
template <typename T>
Quaternion<T> EulerRotation(Quaternion<T> world_from_body, const Vector3<T>& k_in_world,
                            const Vector3<T>& inertia, double duration_s, int steps) {
  const double half_step_s = 0.5 * duration_s / steps;
  for (int step = 0; step < steps; ++step) {
    const Vector3<T> omega = AngularVelocity(world_from_body, k_in_world, inertia);
    const Quaternion<T> spin(T(0), omega[0], omega[1], omega[2]);
    const Quaternion<T> moved = world_from_body + T(half_step_s) * Multiply(spin, world_from_body);
    world_from_body = moved / moved.norm();
  }
  return world_from_body;
}

// The paper's number of steps: none longer than a quarter of a frame (section 4.2).
inline int EulerSteps(double frames) { return static_cast<int>(std::ceil(4.0 * std::abs(frames))); }

}  // namespace smash
