// Rotation without torque over a span of time, for numbers and for jets. A jet carries derivatives
// by all unknowns of a problem; the rotation itself depends on eleven numbers. It is integrated
// with derivatives by those, and the chain rule leads to all unknowns at the end.
#pragma once

#include <ceres/jet.h>

#include "dynamics/free_rotation.h"

namespace smash {

// `steps` equal steps.
template <typename T>
Quaternion<T> TurnInSteps(Quaternion<T> q, const Vector3<T>& l, const Vector3<T>& inverse_inertia,
                          const T& duration_s, int steps) {
  const T step_s = duration_s / T(steps);
  for (int step = 0; step < steps; ++step) q = RungeKuttaStep(q, l, inverse_inertia, step_s);
  return q;
}

inline Quaternion<double> TurnFreely(const Quaternion<double>& q, const Vector3<double>& l,
                                     const Vector3<double>& inverse_inertia, double duration_s,
                                     int steps) {
  return TurnInSteps(q, l, inverse_inertia, duration_s, steps);
}

template <int kWide>
Quaternion<ceres::Jet<double, kWide>> TurnFreely(
    const Quaternion<ceres::Jet<double, kWide>>& q, const Vector3<ceres::Jet<double, kWide>>& l,
    const Vector3<ceres::Jet<double, kWide>>& inverse_inertia,
    const ceres::Jet<double, kWide>& duration_s, int steps) {
  using Narrow = ceres::Jet<double, 12>;
  const ceres::Jet<double, kWide>* inputs[11];
  Narrow narrow[11];
  int count = 0;
  const auto take = [&](const ceres::Jet<double, kWide>& input) {
    inputs[count] = &input;
    narrow[count] = Narrow(input.a, count);
    ++count;
  };
  for (int i = 0; i < 4; ++i) take(q[i]);
  for (int i = 0; i < 3; ++i) take(l[i]);
  take(duration_s);
  for (int i = 0; i < 3; ++i) take(inverse_inertia[i]);
  const Quaternion<Narrow> turned =
      TurnInSteps(Quaternion<Narrow>(narrow[0], narrow[1], narrow[2], narrow[3]),
                  Vector3<Narrow>(narrow[4], narrow[5], narrow[6]),
                  Vector3<Narrow>(narrow[8], narrow[9], narrow[10]), narrow[7], steps);
  Quaternion<ceres::Jet<double, kWide>> result;
  for (int i = 0; i < 4; ++i) {
    result[i].a = turned[i].a;
    result[i].v.setZero();
    for (int k = 0; k < 11; ++k) result[i].v += turned[i].v[k] * inputs[k]->v;
  }
  return result;
}

}  // namespace smash
