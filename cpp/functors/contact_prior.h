// Bodies touch where they are: the line of action passes through both.
#pragma once

#include "dynamics/vector.h"
#include "functors/flight.h"
#include "functors/functor.h"

namespace smash {

// The radius of a ball about the body that holds it: of a box with unit mass the half diagonal,
// sqrt(1.5 (I1 + I2 + I3)); a ball's is a little less.
inline double Reach(const Vector3<double>& inertia_per_mass) {
  return std::sqrt(1.5 * inertia_per_mass.sum());
}

// residual = (x_c - p) along the contact basis / reach. Weak beside any data: it only keeps the
// contact point finite where hardly an impulse tells it. Blocks: motion, contact.
class ContactPriorFunctor : public AutoDiffFunctor<ContactPriorFunctor, 2, kMotionSize, 2> {
 public:
  ContactPriorFunctor(const ContactFrame& contact, double reach_m)
      : contact_(contact), reach_m_(reach_m) {}

  template <typename T>
  bool operator()(const T* motion, const T* offset, T* residual) const {
    const Vector3<T> lever = contact_.contact_origin.cast<T>() - AsVector3(motion);
    for (int i = 0; i < 2; ++i) {
      const Vector3<T> axis = contact_.contact_basis.col(i).cast<T>();
      residual[i] = (axis.dot(lever) + offset[i]) / reach_m_;
    }
    return true;
  }

 private:
  ContactFrame contact_;
  double reach_m_;
};

}  // namespace smash
