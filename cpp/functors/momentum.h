// SMASH eq. 11 and 12: the collision conserves linear and angular momentum.
#pragma once

#include "dynamics/parabola.h"
#include "functors/functor.h"

namespace smash {

// residual = (v_a + m v_b) after - before, in kg m/s with m_a = 1 (eq. 11).
// Blocks: flights a before, a after, b before, b after; tilt; mass ratio m.
class LinearMomentumFunctor
    : public AutoDiffFunctor<LinearMomentumFunctor, 3, kFlightSize, kFlightSize, kFlightSize,
                             kFlightSize, kTiltSize, 1> {
 public:
  explicit LinearMomentumFunctor(double frames_per_second)
      : frames_per_second_(frames_per_second) {}

  template <typename T>
  bool operator()(const T* a_before, const T* a_after, const T* b_before, const T* b_after,
                  const T* tilt, const T* mass_ratio, T* residual) const {
    const Vector3<T> change_a = VelocityChange(a_before, a_after, tilt);
    const Vector3<T> change_b = VelocityChange(b_before, b_after, tilt);
    Store(change_a + mass_ratio[0] * change_b, residual);
    return true;
  }

  template <typename T>
  Vector3<T> VelocityChange(const T* before, const T* after, const T* tilt) const {
    return CollisionVelocity(after, tilt, frames_per_second_) -
           CollisionVelocity(before, tilt, frames_per_second_);
  }

 private:
  double frames_per_second_;
};

// residual = (p_a x v_a + k_a + m p_b x v_b + k_b) after - before, about the origin, in kg m^2/s
// (eq. 12). k_b holds the mass of b already: no further m.
// Blocks: flights as above; tilt; b4 of a, of b; k a before, a after, b before, b after; m.
class AngularMomentumFunctor
    : public AutoDiffFunctor<AngularMomentumFunctor, 3, kFlightSize, kFlightSize, kFlightSize,
                             kFlightSize, kTiltSize, 3, 3, 3, 3, 3, 3, 1> {
 public:
  explicit AngularMomentumFunctor(double frames_per_second) : linear_(frames_per_second) {}

  template <typename T>
  bool operator()(const T* a_before, const T* a_after, const T* b_before, const T* b_after,
                  const T* tilt, const T* b4_a, const T* b4_b, const T* k_a_before,
                  const T* k_a_after, const T* k_b_before, const T* k_b_after, const T* mass_ratio,
                  T* residual) const {
    const Vector3<T> position_a = AsVector3(b4_a);
    const Vector3<T> position_b = AsVector3(b4_b);
    const Vector3<T> orbital_a = position_a.cross(linear_.VelocityChange(a_before, a_after, tilt));
    const Vector3<T> orbital_b = position_b.cross(linear_.VelocityChange(b_before, b_after, tilt));
    const Vector3<T> spin =
        AsVector3(k_a_after) - AsVector3(k_a_before) + AsVector3(k_b_after) - AsVector3(k_b_before);
    Store(orbital_a + mass_ratio[0] * orbital_b + spin, residual);
    return true;
  }

 private:
  LinearMomentumFunctor linear_;
};

}  // namespace smash
