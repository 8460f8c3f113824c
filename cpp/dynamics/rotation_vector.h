// Rotation vectors (axis times angle): the way from and to quaternions, and their derivatives
// (Sola, Deray & Atchuthan, "A micro Lie theory for state estimation in robotics", 2018, section on
// SO(3)).
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "dynamics/rotation.h"
#include "dynamics/vector.h"

namespace smash {

using Matrix3 = Eigen::Matrix3d;

// Below this angle the series are exact to double precision.
inline constexpr double kSmallAngleRad = 1e-4;

// [v]x, with [v]x u = v x u.
inline Matrix3 Skew(const Vector3<double>& v) {
  Matrix3 m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

// The matrix of the unit quaternion.
inline Matrix3 ToMatrix(const Quaternion<double>& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

// Hamilton's product p q.
template <typename T>
Quaternion<T> Multiply(const Quaternion<T>& p, const Quaternion<T>& q) {
  const Vector3<T> v = p.template tail<3>();
  return p[0] * q + MultiplyPure(v, q);
}

template <typename T>
Quaternion<T> Conjugate(const Quaternion<T>& q) {
  return Quaternion<T>(q[0], -q[1], -q[2], -q[3]);
}

// The quaternion of a rotation vector.
inline Quaternion<double> ExpRotation(const Vector3<double>& turn) {
  const double angle = turn.norm();
  const double half = 0.5 * angle;
  const double scale = angle < kSmallAngleRad ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  return Quaternion<double>(std::cos(half), scale * turn[0], scale * turn[1], scale * turn[2]);
}

// The rotation vector of a unit quaternion, of at most half a turn: q and -q are the same.
template <typename T>
Vector3<T> LogRotation(const Quaternion<T>& q) {
  using std::atan2;
  using std::sqrt;
  const T sign(q[0] < T(0) ? -1.0 : 1.0);
  const Vector3<T> axis = sign * q.template tail<3>();
  const T square = axis.squaredNorm();
  if (square < T(kSmallAngleRad * kSmallAngleRad)) {
    // angle / sin(angle / 2) = 2 (1 + s^2 / 6 + ...) with s = sin(angle / 2).
    return axis * (T(2) + square / T(3));
  }
  const T sine = sqrt(square);
  return axis * (T(2) * atan2(sine, sign * q[0]) / sine);
}

// d Log(R Exp(x)) / dx at x = 0, where Log(R) = turn: the inverse of the right Jacobian.
inline Matrix3 InverseRightJacobian(const Vector3<double>& turn) {
  const double square = turn.squaredNorm();
  const double angle = std::sqrt(square);
  const double factor = angle < 1e-3 ? 1.0 / 12.0 + square / 720.0
                                     : 1.0 / square - 0.5 / (angle * std::tan(0.5 * angle));
  const Matrix3 skew = Skew(turn);
  return Matrix3::Identity() + 0.5 * skew + factor * skew * skew;
}

// d(Exp(turn + x) Exp(-turn)) / dx at x = 0, as a rotation vector: the left Jacobian, which also is
// the mean over s from 0 to 1 of the matrix of Exp(s turn).
inline Matrix3 LeftJacobian(const Vector3<double>& turn) {
  const double square = turn.squaredNorm();
  const double angle = std::sqrt(square);
  const bool small = angle < 1e-3;
  const double first = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double second =
      small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
  const Matrix3 skew = Skew(turn);
  return Matrix3::Identity() + first * skew + second * skew * skew;
}

}  // namespace smash
