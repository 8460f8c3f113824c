// What all cost functors share: sizes stated once, and the factory that Ceres needs.
#pragma once

#include <ceres/autodiff_cost_function.h>

#include <utility>

namespace smash {

// Derive as `struct F : AutoDiffFunctor<F, residuals, block sizes...>`; F::Create(...) then makes
// the cost function from F's constructor arguments.
template <typename Functor, int kResiduals, int... kBlockSizes>
struct AutoDiffFunctor {
  template <typename... Arguments>
  static ceres::CostFunction* Create(Arguments&&... arguments) {
    return new ceres::AutoDiffCostFunction<Functor, kResiduals, kBlockSizes...>(
        new Functor(std::forward<Arguments>(arguments)...));
  }
};

}  // namespace smash
