// SMASH eq. 17: the parabolas' common gravity stays near the vertical of the scene.
#pragma once

#include "dynamics/parabola.h"
#include "functors/functor.h"

namespace smash {

// residual = g - R(0, tilt, heading) (0, g, 0) . (0, 1, 0) = g (1 - cos beta_x), in m/s^2: second
// order in the tilt. Block: tilt {beta_x, beta_y1}.
class GravityFunctor : public AutoDiffFunctor<GravityFunctor, 1, kTiltSize> {
 public:
  explicit GravityFunctor(double gravity_m_s2) : gravity_m_s2_(gravity_m_s2) {}

  template <typename T>
  bool operator()(const T* tilt, T* residual) const {
    const Vector3<T> down(T(0), T(gravity_m_s2_), T(0));
    residual[0] = T(gravity_m_s2_) - RotateYXY(T(0), tilt[0], tilt[1], down)[1];
    return true;
  }

 private:
  double gravity_m_s2_;
};

}  // namespace smash
