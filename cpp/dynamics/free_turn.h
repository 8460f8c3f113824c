// Rotation without torque over a span of time, for numbers and for jets: what a jet carries is led
// on by the rotation's own derivatives.
#pragma once

#include <ceres/jet.h>

#include "dynamics/free_rotation.h"

namespace smash {

inline Quaternion<double> TurnFreely(const Quaternion<double>& q, const Vector3<double>& l,
                                     const Vector3<double>& inertia, double duration_s, int pairs) {
  FreeRotation rotation(inertia, q, l);
  rotation.Advance(duration_s, pairs, FreeRotation::kNothing);
  return rotation.world_from_body();
}

// 2 Im(dq q*), the small turn in the world that leads from q to q + dq, by dq.
inline Eigen::Matrix<double, 3, 4> TurnByQuaternion(const Quaternion<double>& q) {
  Eigen::Matrix<double, 3, 4> turn;
  turn.col(0) = -q.tail<3>();
  turn.rightCols<3>() = q[0] * Matrix3::Identity() + Skew(q.tail<3>());
  return 2.0 * turn;
}

template <int kSize>
Quaternion<ceres::Jet<double, kSize>> TurnFreely(const Quaternion<ceres::Jet<double, kSize>>& q,
                                                 const Vector3<ceres::Jet<double, kSize>>& l,
                                                 const Vector3<ceres::Jet<double, kSize>>& inertia,
                                                 const ceres::Jet<double, kSize>& duration_s,
                                                 int pairs) {
  const Quaternion<double> start(q[0].a, q[1].a, q[2].a, q[3].a);
  const Vector3<double> spin(l[0].a, l[1].a, l[2].a);
  FreeRotation rotation(Vector3<double>(inertia[0].a, inertia[1].a, inertia[2].a), start, spin);
  bool moves_inertia = false;
  for (int i = 0; i < 3; ++i) moves_inertia |= !inertia[i].v.isZero(0.0);
  rotation.Advance(duration_s.a, pairs,
                   moves_inertia ? FreeRotation::kStateAndInertia : FreeRotation::kState);

  // By q, l, the duration and the inertia.
  Eigen::Matrix<double, 3, 11> turn;
  turn.leftCols<4>() =
      (Matrix3::Identity() + rotation.psi() * Skew(spin)) * TurnByQuaternion(start);
  turn.middleCols<3>(4) = rotation.psi();
  turn.col(7) = rotation.omega();
  turn.rightCols<3>() = rotation.by_inertia();
  const Quaternion<double>& end = rotation.world_from_body();
  // A small turn moves q by half of what TurnByQuaternion takes of it, transposed: unit columns.
  const Eigen::Matrix<double, 4, 11> by = 0.25 * TurnByQuaternion(end).transpose() * turn;
  const ceres::Jet<double, kSize>* inputs[11] = {&q[0],       &q[1],       &q[2],      &q[3],
                                                 &l[0],       &l[1],       &l[2],      &duration_s,
                                                 &inertia[0], &inertia[1], &inertia[2]};
  const int count = moves_inertia ? 11 : 8;
  Quaternion<ceres::Jet<double, kSize>> result;
  for (int i = 0; i < 4; ++i) {
    result[i].a = end[i];
    result[i].v.setZero();
    for (int k = 0; k < count; ++k) result[i].v += by(i, k) * inputs[k]->v;
  }
  return result;
}

}  // namespace smash
