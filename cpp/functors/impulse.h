// SMASH eq. 13 and 14: one impulse J = jn at one point explains the jumps of both bodies. J acts
// on a, -J on b.
#pragma once

#include "dynamics/parabola.h"
#include "functors/functor.h"

namespace smash {

// residual = v_after - v_before - J for the reference body, in m/s (eq. 13, first line).
// Blocks: flight before, flight after, tilt, J.
class LinearImpulseFunctor
    : public AutoDiffFunctor<LinearImpulseFunctor, 3, kFlightSize, kFlightSize, kTiltSize, 3> {
 public:
  explicit LinearImpulseFunctor(double frames_per_second) : frames_per_second_(frames_per_second) {}

  template <typename T>
  bool operator()(const T* before, const T* after, const T* tilt, const T* impulse,
                  T* residual) const {
    return Evaluate(before, after, tilt, Vector3<T>(AsVector3(impulse)), residual);
  }

  template <typename T>
  bool Evaluate(const T* before, const T* after, const T* tilt, const Vector3<T>& velocity_jump,
                T* residual) const {
    Store(CollisionVelocity(after, tilt, frames_per_second_) -
              CollisionVelocity(before, tilt, frames_per_second_) - velocity_jump,
          residual);
    return true;
  }

 private:
  double frames_per_second_;
};

// The same for b: the jump is -J/m (eq. 13, second line). A fifth block: the mass ratio m.
class LinearImpulseWithMassFunctor
    : public AutoDiffFunctor<LinearImpulseWithMassFunctor, 3, kFlightSize, kFlightSize, kTiltSize,
                             3, 1> {
 public:
  explicit LinearImpulseWithMassFunctor(double frames_per_second) : linear_(frames_per_second) {}

  template <typename T>
  bool operator()(const T* before, const T* after, const T* tilt, const T* impulse,
                  const T* mass_ratio, T* residual) const {
    const Vector3<T> jump = AsVector3(impulse) / (-mass_ratio[0]);
    return linear_.Evaluate(before, after, tilt, jump, residual);
  }

 private:
  LinearImpulseFunctor linear_;
};

// residual = k_after - k_before -+ (x_c - b4) x J, in kg m^2/s (eq. 14), minus for a and plus for
// b. Blocks: k before, k after, b4, x_c, J. Phase 3: the contact point is free.
class AngularImpulseFunctor : public AutoDiffFunctor<AngularImpulseFunctor, 3, 3, 3, 3, 3, 3> {
 public:
  // `sign`: +1 for a, which feels J; -1 for b, which feels -J.
  explicit AngularImpulseFunctor(double sign) : sign_(sign) {}

  template <typename T>
  bool operator()(const T* k_before, const T* k_after, const T* b4, const T* contact_point,
                  const T* impulse, T* residual) const {
    const Vector3<T> lever = AsVector3(contact_point) - AsVector3(b4);
    return Evaluate(k_before, k_after, lever, impulse, residual);
  }

  template <typename T>
  bool Evaluate(const T* k_before, const T* k_after, const Vector3<T>& lever, const T* impulse,
                T* residual) const {
    const Vector3<T> torque = lever.cross(Vector3<T>(AsVector3(impulse)));
    Store(AsVector3(k_after) - AsVector3(k_before) - T(sign_) * torque, residual);
    return true;
  }

 private:
  double sign_;
};

// Phase 2, two bodies: the contact point follows the unknowns, midway between the centres.
// Blocks: k before, k after, own b4, the other body's b4, J.
class AngularImpulseAtMidpointFunctor
    : public AutoDiffFunctor<AngularImpulseAtMidpointFunctor, 3, 3, 3, 3, 3, 3> {
 public:
  explicit AngularImpulseAtMidpointFunctor(double sign) : angular_(sign) {}

  template <typename T>
  bool operator()(const T* k_before, const T* k_after, const T* b4, const T* b4_other,
                  const T* impulse, T* residual) const {
    const Vector3<T> lever = T(0.5) * (AsVector3(b4_other) - AsVector3(b4));
    return angular_.Evaluate(k_before, k_after, lever, impulse, residual);
  }

 private:
  AngularImpulseFunctor angular_;
};

// Phase 2, one body: the contact point is the foot of b4 on the plane normal . x = height. A zero
// normal, where no plane is known, leaves it at b4. Blocks: k before, k after, b4, J.
class AngularImpulseOnPlaneFunctor
    : public AutoDiffFunctor<AngularImpulseOnPlaneFunctor, 3, 3, 3, 3, 3> {
 public:
  AngularImpulseOnPlaneFunctor(const Vector3<double>& normal, double height)
      : angular_(1.0), normal_(normal), height_(height) {}

  template <typename T>
  bool operator()(const T* k_before, const T* k_after, const T* b4, const T* impulse,
                  T* residual) const {
    const Vector3<T> normal = normal_.template cast<T>();
    const Vector3<T> lever = (T(height_) - normal.dot(AsVector3(b4))) * normal;
    return angular_.Evaluate(k_before, k_after, lever, impulse, residual);
  }

 private:
  AngularImpulseFunctor angular_;
  Vector3<double> normal_;  // unit, in the gravity frame
  double height_;
};

}  // namespace smash
