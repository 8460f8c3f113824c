// Rotation without torque, accurately: the angular momentum l per unit mass is constant in the
// world, the orientation follows from dq/dt = 1/2 (0, omega) q with omega = R I^-1 R^T l.
#pragma once

#include <cmath>

#include "dynamics/rotation_vector.h"

namespace smash {

// dq/dt = 1/2 q (0, I^-1 R^T l), the same with omega in the body. Written out: this is the solver's
// innermost loop.
template <typename T>
inline Quaternion<T> RotationRate(const Quaternion<T>& q, const Vector3<T>& l,
                                  const Vector3<T>& inverse_inertia) {
  const T &w = q[0], &x = q[1], &y = q[2], &z = q[3];
  // R^T l = l - 2 u x (w l - u x l) with u = (x, y, z).
  const T a = w * l[0] - (y * l[2] - z * l[1]);
  const T b = w * l[1] - (z * l[0] - x * l[2]);
  const T c = w * l[2] - (x * l[1] - y * l[0]);
  const T p = T(0.5) * inverse_inertia[0] * (l[0] - T(2) * (y * c - z * b));
  const T r = T(0.5) * inverse_inertia[1] * (l[1] - T(2) * (z * a - x * c));
  const T s = T(0.5) * inverse_inertia[2] * (l[2] - T(2) * (x * b - y * a));
  return Quaternion<T>(-(x * p + y * r + z * s), w * p + y * s - z * r, w * r + z * p - x * s,
                       w * s + x * r - y * p);
}

// The classical Runge-Kutta step of order 4 on the quaternion. Off the unit sphere the right-hand
// side is as smooth as on it; length is restored after the step.
template <typename T>
Quaternion<T> RungeKuttaStep(const Quaternion<T>& q, const Vector3<T>& l,
                             const Vector3<T>& inverse_inertia, const T& step_s) {
  const T half_s = step_s * T(0.5);
  const Quaternion<T> k1 = RotationRate(q, l, inverse_inertia);
  const Quaternion<T> k2 = RotationRate(Quaternion<T>(q + half_s * k1), l, inverse_inertia);
  const Quaternion<T> k3 = RotationRate(Quaternion<T>(q + half_s * k2), l, inverse_inertia);
  const Quaternion<T> k4 = RotationRate(Quaternion<T>(q + step_s * k3), l, inverse_inertia);
  const Quaternion<T> moved = q + (step_s / T(6)) * (k1 + T(2) * (k2 + k3) + k4);
  return moved / moved.norm();
}

// An orientation that moves on in time, with its derivatives by where it started.
//
// A small turn phi of the orientation and a change d of l obey dphi/dt = A (l x phi + d) with
// A = R I^-1 R^T. Hence phi(t) = (1 + Psi [l]x) phi(0) + Psi d, where dPsi/dt = A ([l]x Psi + 1)
// and Psi(0) = 0: one matrix tells both derivatives. It is integrated as X = R^T Psi, with
// dX/dt = I^-1 ([R^T l]x X + R^T) - [omega in body]x X. What moments of inertia do obeys the same
// with -diag(I^-1 omega in body) in the place of I^-1 R^T.
class FreeRotation {
 public:
  // What it is differentiated by.
  enum By { kNothing, kState, kStateAndInertia };

  FreeRotation(const Vector3<double>& inertia_per_mass, const Quaternion<double>& world_from_body,
               const Vector3<double>& l)
      : inverse_inertia_(inertia_per_mass.cwiseInverse()),
        isotropic_(inertia_per_mass[0] == inertia_per_mass[1] &&
                   inertia_per_mass[1] == inertia_per_mass[2]),
        q_(world_from_body),
        l_(l) {}

  // How many pairs of steps cover a duration with none longer than `longest_step_s`.
  static int Pairs(double duration_s, double longest_step_s) {
    return std::max(1, static_cast<int>(std::ceil(0.5 * std::abs(duration_s) / longest_step_s)));
  }

  const Quaternion<double>& world_from_body() const { return q_; }
  Matrix3 psi() const { return ToMatrix(q_) * x_; }
  // Of the turn in the world, by the moments of inertia.
  Matrix3 by_inertia() const { return ToMatrix(q_) * y_; }
  Vector3<double> omega() const { return AngularVelocity(q_, l_, inverse_inertia_); }

  // Moves on by `duration_s` (negative: back) in `pairs` pairs of steps. Derivatives are only
  // needed to the accuracy of a derivative: one step of their own for each pair. Where inertia is
  // isotropic the spin is constant, and all have a closed form.
  void Advance(double duration_s, int pairs, By by) {
    if (isotropic_) return AdvanceIsotropic(duration_s, by);
    const double step_s = 0.5 * duration_s / pairs;
    for (int pair = 0; pair < pairs; ++pair) {
      const Quaternion<double> middle = RungeKuttaStep(q_, l_, inverse_inertia_, step_s);
      const Quaternion<double> end = RungeKuttaStep(middle, l_, inverse_inertia_, step_s);
      if (by != kNothing) {
        const Frame frames[3] = {Frame(*this, q_), Frame(*this, middle), Frame(*this, end)};
        Step(frames, &Frame::by_spin, 2.0 * step_s, &x_);
        if (by == kStateAndInertia) Step(frames, &Frame::by_inertia, 2.0 * step_s, &y_);
      }
      q_ = end;
    }
  }

 private:
  // What rates need of an orientation; the last two drive the derivatives.
  struct Frame {
    Frame(const FreeRotation& rotation, const Quaternion<double>& q) {
      const Matrix3 body_from_world = ToMatrix(q).transpose();
      l = body_from_world * rotation.l_;
      omega = l.cwiseProduct(rotation.inverse_inertia_);
      by_spin = rotation.inverse_inertia_.asDiagonal() * body_from_world;
      by_inertia = -rotation.inverse_inertia_.cwiseProduct(omega).asDiagonal().toDenseMatrix();
    }
    Vector3<double> l, omega;
    Matrix3 by_spin, by_inertia;
  };

  Matrix3 Rate(const Frame& frame, const Matrix3& driven_by, const Matrix3& x) const {
    Matrix3 rate;
    for (int column = 0; column < 3; ++column) {
      const Vector3<double> at = x.col(column);
      rate.col(column) = inverse_inertia_.cwiseProduct(frame.l.cross(at)) + driven_by.col(column) -
                         frame.omega.cross(at);
    }
    return rate;
  }

  void Step(const Frame (&frames)[3], Matrix3 Frame::*driven_by, double step_s, Matrix3* x) const {
    const auto rate = [&](const Frame& frame, const Matrix3& at) {
      return Rate(frame, frame.*driven_by, at);
    };
    const Matrix3 k1 = rate(frames[0], *x);
    const Matrix3 k2 = rate(frames[1], *x + 0.5 * step_s * k1);
    const Matrix3 k3 = rate(frames[1], *x + 0.5 * step_s * k2);
    const Matrix3 k4 = rate(frames[2], *x + step_s * k3);
    *x += (step_s / 6.0) * (k1 + 2.0 * (k2 + k3) + k4);
  }

  void AdvanceIsotropic(double duration_s, By by) {
    const Vector3<double> turn = (inverse_inertia_[0] * duration_s) * l_;
    const Matrix3 psi_before = psi();
    q_ = Multiply(ExpRotation(turn), q_);
    if (by == kNothing) return;
    // The spin is constant in the body, too.
    y_.diagonal() -= (duration_s * inverse_inertia_[0]) * (ToMatrix(q_).transpose() * omega());
    // Psi(s + t) = exp([omega] t) Psi(s) + (t / I) J_l(omega t).
    x_ = ToMatrix(q_).transpose() * (ToMatrix(ExpRotation(turn)) * psi_before +
                                     (inverse_inertia_[0] * duration_s) * LeftJacobian(turn));
  }

  Vector3<double> inverse_inertia_;
  bool isotropic_;
  Quaternion<double> q_;
  Vector3<double> l_;
  Matrix3 x_ = Matrix3::Zero(), y_ = Matrix3::Zero();
};

}  // namespace smash
