// What is known of the direction of gravity before any pose is seen.
#pragma once

#include "functors/functor.h"

namespace smash {

// residual = tilt / std: the stated up is right to within `std_rad` about each horizontal axis.
class TiltPriorFunctor : public AutoDiffFunctor<TiltPriorFunctor, 2, 2> {
 public:
  explicit TiltPriorFunctor(double std_rad) : std_rad_(std_rad) {}

  template <typename T>
  bool operator()(const T* tilt, T* residual) const {
    residual[0] = tilt[0] / std_rad_;
    residual[1] = tilt[1] / std_rad_;
    return true;
  }

 private:
  double std_rad_;
};

}  // namespace smash
