// SMASH eq. 19: an annotated orientation against the Euler steps of eq. 10 from the collision.
#pragma once

#include "dynamics/rotation.h"
#include "functors/functor.h"

namespace smash {

// residual = q(t) - q_obs, component by component, where q_obs takes the sign nearer to q(t): both
// signs are the same pose. Blocks: q at the collision, k of the flight. For the reference body,
// whose mass is 1.
class OrientationFunctor : public AutoDiffFunctor<OrientationFunctor, 4, 4, 3> {
 public:
  // `inertia_per_mass`: principal moments of unit mass in m^2. `frames`: from the collision.
  OrientationFunctor(const Vector3<double>& inertia_per_mass, double frames,
                     double frames_per_second, const Quaternion<double>& observed)
      : inertia_per_mass_(inertia_per_mass),
        duration_s_(frames / frames_per_second),
        steps_(EulerSteps(frames)),
        observed_(observed) {}

  template <typename T>
  bool operator()(const T* q, const T* k, T* residual) const {
    const T unit_mass(1);
    return Evaluate(q, k, unit_mass, residual);
  }

  template <typename T>
  bool Evaluate(const T* q, const T* k, const T& mass, T* residual) const {
    const Vector3<T> inertia = inertia_per_mass_.template cast<T>() * mass;
    const Quaternion<T> predicted = EulerRotation(
        Quaternion<T>(AsQuaternion(q)), Vector3<T>(AsVector3(k)), inertia, duration_s_, steps_);
    const Quaternion<T> observed = observed_.template cast<T>();
    const T sign(predicted.dot(observed) < T(0) ? -1.0 : 1.0);
    Store(predicted - sign * observed, residual);
    return true;
  }

 private:
  Vector3<double> inertia_per_mass_;
  double duration_s_;
  int steps_;
  Quaternion<double> observed_;
};

// The same for body b, whose inertia scales with the mass ratio: a third block.
class OrientationWithMassFunctor : public AutoDiffFunctor<OrientationWithMassFunctor, 4, 4, 3, 1> {
 public:
  explicit OrientationWithMassFunctor(const OrientationFunctor& orientation)
      : orientation_(orientation) {}

  template <typename T>
  bool operator()(const T* q, const T* k, const T* mass_ratio, T* residual) const {
    return orientation_.Evaluate(q, k, mass_ratio[0], residual);
  }

 private:
  OrientationFunctor orientation_;
};

}  // namespace smash
