// The collision between four flights that are known already: which impulse, line of action and mass
// ratio make the jumps in velocity and angular momentum (SMASH eq. 11 to 14)?
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "dynamics/vector.h"

namespace smash {

// How a body's flights differ at the collision, per unit of its own mass, each weighted with the
// inverse square root of its covariance.
struct BodyJump {
  Vector3<double> position;
  Vector3<double> velocity;
  Eigen::Matrix3d velocity_weight;
  // Zero where the spin isn't measured.
  Vector3<double> spin;
  Eigen::Matrix3d spin_weight;
};

// Unknowns: the impulse's numbers (three or, along a plane's normal, the first alone), the contact
// point's two across it, and ln m. Residuals: of each body's velocity and spin. For
// ceres::TinySolver, which leaves alone what no residual depends on.
class JumpFunctor {
 public:
  static constexpr int kUnknowns = 6;

  // `impulse_basis`, `contact_basis`: see ContactFrame; a basis of one vector is padded with zeros.
  JumpFunctor(std::vector<BodyJump> bodies, const Eigen::Matrix3d& impulse_basis,
              const Vector3<double>& contact_origin,
              const Eigen::Matrix<double, 3, 2>& contact_basis)
      : bodies_(std::move(bodies)),
        impulse_basis_(impulse_basis),
        contact_origin_(contact_origin),
        contact_basis_(contact_basis) {}

  int NumResiduals() const { return 6 * static_cast<int>(bodies_.size()); }

  template <typename T>
  bool operator()(const T* unknowns, T* residuals) const {
    using std::exp;
    const Vector3<T> impulse = impulse_basis_.cast<T>() * AsVector3(unknowns);
    const Eigen::Map<const Eigen::Matrix<T, 2, 1>> across(unknowns + 3);
    const Vector3<T> contact = contact_origin_.cast<T>() + contact_basis_.cast<T>() * across;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyJump& body = bodies_[i];
      const Vector3<T> kick = i == 0 ? impulse : Vector3<T>(impulse * -exp(-unknowns[5]));
      const Vector3<T> lever = contact - body.position.cast<T>();
      Store(body.velocity_weight.cast<T>() * (kick - body.velocity.cast<T>()), residuals + 6 * i);
      Store(body.spin_weight.cast<T>() * (lever.cross(kick) - body.spin.cast<T>()),
            residuals + 6 * i + 3);
    }
    return true;
  }

 private:
  std::vector<BodyJump> bodies_;
  Eigen::Matrix3d impulse_basis_;
  Vector3<double> contact_origin_;
  Eigen::Matrix<double, 3, 2> contact_basis_;
};

}  // namespace smash
