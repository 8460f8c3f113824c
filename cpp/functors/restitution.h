// The restitution (SMASH eq. 15) as a residual, to hold the fit at a chosen one: how the interval
// of a profile likelihood is found.
#pragma once

#include <ceres/dynamic_autodiff_cost_function.h>

#include <vector>

#include "dynamics/rotation.h"
#include "functors/flight.h"

namespace smash {

// residual = weight (c - value). Blocks: motion and orientation of a, impulse, contact; with a body
// b also its motion, orientation and log mass.
class RestitutionFunctor {
 public:
  struct Contact {
    ContactFrame frame;
    // Zero between two bodies: the normal then is the impulse's direction.
    Vector3<double> plane_normal;
    std::vector<Vector3<double>> inertia_per_mass;
    // Of a ball without, the contact is central, and its spin plays no part.
    std::vector<bool> has_spin = {};
  };

  static ceres::CostFunction* Create(const Contact& contact, double value, double weight) {
    auto* cost = new ceres::DynamicAutoDiffCostFunction<RestitutionFunctor, 10>(
        new RestitutionFunctor(contact, value, weight));
    const int impulse_size = static_cast<int>(contact.frame.impulse_basis.cols());
    for (const int size : {kMotionSize, 4, impulse_size, 2}) cost->AddParameterBlock(size);
    if (contact.inertia_per_mass.size() == 2) {
      for (const int size : {kMotionSize, 4, 1}) cost->AddParameterBlock(size);
    }
    cost->SetNumResiduals(1);
    return cost;
  }

  template <typename T>
  bool operator()(T const* const* blocks, T* residual) const {
    using std::exp;
    Vector3<T> impulse = Vector3<T>::Zero();
    for (Eigen::Index i = 0; i < contact_.frame.impulse_basis.cols(); ++i) {
      impulse += contact_.frame.impulse_basis.col(i).cast<T>() * blocks[2][i];
    }
    const Vector3<T> point = contact_.frame.contact_origin.cast<T>() +
                             contact_.frame.contact_basis.col(0).cast<T>() * blocks[3][0] +
                             contact_.frame.contact_basis.col(1).cast<T>() * blocks[3][1];
    Vector3<T> normal = contact_.plane_normal.cast<T>();
    if (contact_.plane_normal.isZero()) normal = impulse.normalized();
    T before =
        NormalVelocity(0, blocks[0], blocks[1], point, normal, Vector3<T>(Vector3<T>::Zero()));
    T after = NormalVelocity(0, blocks[0], blocks[1], point, normal, impulse);
    if (contact_.inertia_per_mass.size() == 2) {
      const Vector3<T> kick = impulse * -exp(-blocks[6][0]);
      before -=
          NormalVelocity(1, blocks[4], blocks[5], point, normal, Vector3<T>(Vector3<T>::Zero()));
      after -= NormalVelocity(1, blocks[4], blocks[5], point, normal, kick);
    }
    residual[0] = (-after / before - value_) * weight_;
    return true;
  }

 private:
  RestitutionFunctor(const Contact& contact, double value, double weight)
      : contact_(contact), value_(value), weight_(weight) {}

  // Of the body's point at the contact after `kick`, an impulse per unit of its mass.
  template <typename T>
  T NormalVelocity(std::size_t body, const T* motion, const T* orientation, const Vector3<T>& point,
                   const Vector3<T>& normal, const Vector3<T>& kick) const {
    const Vector3<T> velocity = AsVector3(motion + 3) + kick;
    if (!contact_.has_spin[body]) return normal.dot(velocity);
    const Vector3<T> lever = point - AsVector3(motion);
    const Vector3<T> spin = AsVector3(motion + 6) + lever.cross(kick);
    const Vector3<T> inverse_inertia =
        contact_.inertia_per_mass[body].cwiseInverse().template cast<T>();
    const Vector3<T> omega =
        AngularVelocity(Quaternion<T>(AsQuaternion(orientation)), spin, inverse_inertia);
    return normal.dot(velocity + omega.cross(lever));
  }

  Contact contact_;
  double value_;
  double weight_;
};

}  // namespace smash
