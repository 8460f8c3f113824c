// Small vectors over any scalar: double, or a Ceres jet that carries derivatives.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

namespace smash {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// Quaternions are [w, x, y, z] everywhere on this side, as in Ceres' rotation.h and in the files.
template <typename T>
using Quaternion = Eigen::Matrix<T, 4, 1>;

// A parameter block of Ceres seen as a vector, without a copy.
template <typename T>
Eigen::Map<const Vector3<T>> AsVector3(const T* block) {
  return Eigen::Map<const Vector3<T>>(block);
}

template <typename T>
Eigen::Map<const Quaternion<T>> AsQuaternion(const T* block) {
  return Eigen::Map<const Quaternion<T>>(block);
}

// Writes a residual out; its size is that of the expression.
template <typename Expression, typename T>
void Store(const Eigen::MatrixBase<Expression>& value, T* residual) {
  Eigen::Map<Eigen::Matrix<T, Expression::RowsAtCompileTime, 1>> target(residual);
  target = value;
}

inline Vector3<double> ToVector3(const std::array<double, 3>& a) {
  return Vector3<double>(a[0], a[1], a[2]);
}

inline Quaternion<double> ToQuaternion(const std::array<double, 4>& a) {
  return Quaternion<double>(a[0], a[1], a[2], a[3]);
}

}  // namespace smash
