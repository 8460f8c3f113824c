// SMASH eq. 18: an annotated position against its parabola.
#pragma once

#include "dynamics/parabola.h"
#include "functors/functor.h"

namespace smash {

// residual = p(t) - p_obs, in m, in the gravity frame.
// Blocks: flight {b2, b3, beta_y0}, tilt {beta_x, beta_y1}, b4.
class PositionFunctor : public AutoDiffFunctor<PositionFunctor, 3, kFlightSize, kTiltSize, 3> {
 public:
  PositionFunctor(double b1, double frames, const Vector3<double>& observed)
      : b1_(b1), frames_(frames), observed_(observed) {}

  template <typename T>
  bool operator()(const T* flight, const T* tilt, const T* b4, T* residual) const {
    const Vector3<T> predicted =
        ParabolaPosition(flight, tilt, Vector3<T>(AsVector3(b4)), b1_, frames_);
    Store(predicted - observed_.template cast<T>(), residual);
    return true;
  }

 private:
  double b1_;      // gravity, m/frame^2
  double frames_;  // from the collision, negative before it
  Vector3<double> observed_;
};

}  // namespace smash
