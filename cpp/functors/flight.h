// One flight of a body, before or after the collision: all its poses against the exact law, in one
// integration outwards from the collision. Derivatives by hand; tests hold them against automatic
// ones.
#pragma once

#include <ceres/cost_function.h>

#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/free_rotation.h"

namespace smash {

// An annotated pose, with one standard deviation of each coordinate.
struct FlightPose {
  double time_s;
  Vector3<double> position;
  double position_std_m;
  Quaternion<double> world_from_body;
  double orientation_std_rad;
  bool has_orientation;
};

// Gravity, |g| along a direction that may be tilted: down + tilt[0] e0 + tilt[1] e1, made unit.
struct TiltedGravity {
  double strength_m_s2;
  Vector3<double> down;
  Eigen::Matrix<double, 3, 2> across;

  Vector3<double> Acceleration(const double* tilt) const {
    return strength_m_s2 * Direction(tilt).normalized();
  }
  Eigen::Matrix<double, 3, 2> Derivative(const double* tilt) const {
    const Vector3<double> direction = Direction(tilt);
    const Vector3<double> unit = direction.normalized();
    return (strength_m_s2 / direction.norm()) * (across - unit * (unit.transpose() * across));
  }

 private:
  Vector3<double> Direction(const double* tilt) const {
    return down + across * Eigen::Map<const Eigen::Vector2d>(tilt);
  }
};

// The impulse and the contact point as few numbers: J = impulse_basis j and
// x_c = contact_origin + contact_basis u.
struct ContactFrame {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> impulse_basis;
  Vector3<double> contact_origin;
  Eigen::Matrix<double, 3, 2> contact_basis;
};

// The parameter blocks of a flight, in this order; the last three only after the collision, and the
// last one only of body b.
enum FlightBlock { kMotion, kOrientation, kTime, kTilt, kImpulse, kContact, kLogMass };

// A body's block kMotion: p, v before and l before (per unit of its own mass), at the collision.
inline constexpr int kMotionSize = 9;

// Residuals: for each pose (model - observed position) / std, and, where one is annotated,
// Log(q_obs^-1 q) / std. After the collision v+ = v + s J/m and l+ = l + s (x_c - p) x J/m, with
// s = 1 for body a, -1 for b.
class FlightCost : public ceres::CostFunction {
 public:
  struct Body {
    Vector3<double> inertia_per_mass;
    bool has_spin;
    bool is_reference;
  };

  // `poses` outwards from the collision. `pairs[i]` pairs of steps lead to pose i from the one
  // before it, whatever the time of the collision is: the residuals are smooth in it.
  FlightCost(const Body& body, bool is_after, const TiltedGravity& gravity,
             const ContactFrame& contact, std::vector<FlightPose> poses, std::vector<int> pairs)
      : body_(body),
        is_after_(is_after),
        gravity_(gravity),
        contact_(contact),
        poses_(std::move(poses)),
        pairs_(std::move(pairs)) {
    int residuals = 0;
    for (const FlightPose& pose : poses_) residuals += Rows(pose);
    set_num_residuals(residuals);
    *mutable_parameter_block_sizes() = {kMotionSize, 4, 1, 2};
    if (!is_after_) return;
    mutable_parameter_block_sizes()->push_back(ImpulseSize());
    mutable_parameter_block_sizes()->push_back(2);
    if (!body_.is_reference) mutable_parameter_block_sizes()->push_back(1);
  }

  // How many residuals a pose has.
  int Rows(const FlightPose& pose) const { return SeesSpin(pose) ? 6 : 3; }
  const std::vector<FlightPose>& poses() const { return poses_; }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Launch launch = LaunchFrom(blocks);
    const Eigen::Matrix<double, 3, 2> gravity_by_tilt = gravity_.Derivative(blocks[kTilt]);
    const Vector3<double> gravity = gravity_.Acceleration(blocks[kTilt]);
    const double* q = blocks[kOrientation];
    FreeRotation rotation(body_.inertia_per_mass, Quaternion<double>(q[0], q[1], q[2], q[3]),
                          launch.spin);
    double rotated_s = blocks[kTime][0];
    int row = 0;
    int pairs = 0;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const FlightPose& pose = poses_[i];
      const double t = pose.time_s - blocks[kTime][0];
      const double weight = 1.0 / pose.position_std_m;
      const Vector3<double> position =
          launch.position + t * launch.velocity + (0.5 * t * t) * gravity;
      AsResidual(residuals + row) = weight * (position - pose.position);
      if (jacobians) {
        FillPosition(jacobians, row, weight, t, launch, gravity, gravity_by_tilt);
      }
      pairs += pairs_[i];
      if (SeesSpin(pose)) {
        rotation.Advance(pose.time_s - rotated_s, pairs,
                         jacobians ? FreeRotation::kState : FreeRotation::kNothing);
        rotated_s = pose.time_s;
        pairs = 0;
        const Vector3<double> turn =
            LogRotation(Multiply(Conjugate(pose.world_from_body), rotation.world_from_body()));
        const double per_rad = 1.0 / pose.orientation_std_rad;
        AsResidual(residuals + row + 3) = per_rad * turn;
        if (jacobians) {
          const Matrix3 by_turn = per_rad * InverseRightJacobian(turn) *
                                  ToMatrix(rotation.world_from_body()).transpose();
          FillOrientation(jacobians, row + 3, by_turn, rotation, launch, q);
        }
      }
      row += Rows(pose);
    }
    return true;
  }

 private:
  // Written for any scalar, on the same numbers.
  friend class FlightReference;

  // The flight's start, and how it follows from the blocks.
  struct Launch {
    Vector3<double> position, velocity, spin;
    // Of the impulse per unit of the body's own mass, with the body's sign.
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> velocity_by_impulse, spin_by_impulse;
    Vector3<double> velocity_by_log_mass, spin_by_log_mass;
    Matrix3 spin_by_position;
    Eigen::Matrix<double, 3, 2> spin_by_contact;
  };

  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  static Eigen::Map<Vector3<double>> AsResidual(double* values) {
    return Eigen::Map<Vector3<double>>(values);
  }

  int ImpulseSize() const { return static_cast<int>(contact_.impulse_basis.cols()); }
  bool SeesSpin(const FlightPose& pose) const { return body_.has_spin && pose.has_orientation; }

  Launch LaunchFrom(double const* const* blocks) const {
    const double* motion = blocks[kMotion];
    Launch launch;
    launch.position = Vector3<double>(motion[0], motion[1], motion[2]);
    launch.velocity = Vector3<double>(motion[3], motion[4], motion[5]);
    launch.spin = Vector3<double>(motion[6], motion[7], motion[8]);
    if (!is_after_) return launch;
    const double push = body_.is_reference ? 1.0 : -std::exp(-blocks[kLogMass][0]);
    const Eigen::Map<const Eigen::VectorXd> j(blocks[kImpulse], ImpulseSize());
    const Vector3<double> kick = push * (contact_.impulse_basis * j);
    const Vector3<double> contact =
        contact_.contact_origin +
        contact_.contact_basis * Eigen::Map<const Eigen::Vector2d>(blocks[kContact]);
    const Vector3<double> lever = contact - launch.position;
    launch.velocity += kick;
    launch.spin += lever.cross(kick);
    launch.velocity_by_impulse = push * contact_.impulse_basis;
    launch.spin_by_impulse = Skew(lever) * launch.velocity_by_impulse;
    launch.velocity_by_log_mass = -kick;
    launch.spin_by_log_mass = -lever.cross(kick);
    launch.spin_by_position = Skew(kick);
    launch.spin_by_contact = -Skew(kick) * contact_.contact_basis;
    return launch;
  }

  // Rows `row` to `row` + 2 of a block's Jacobian; nothing where Ceres doesn't want it.
  template <int kColumns, typename Expression>
  static void Put(double** jacobians, int block, int row, int columns,
                  const Eigen::MatrixBase<Expression>& value) {
    if (!jacobians[block]) return;
    Eigen::Map<
        Eigen::Matrix<double, 3, kColumns, kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor>>
        target(jacobians[block] + row * columns, 3, columns);
    target = value;
  }

  void FillPosition(double** jacobians, int row, double weight, double t, const Launch& launch,
                    const Vector3<double>& gravity,
                    const Eigen::Matrix<double, 3, 2>& gravity_by_tilt) const {
    Eigen::Matrix<double, 3, kMotionSize> by_motion = Eigen::Matrix<double, 3, kMotionSize>::Zero();
    by_motion.leftCols<3>().diagonal().setConstant(weight);
    by_motion.middleCols<3>(3).diagonal().setConstant(weight * t);
    Put<kMotionSize>(jacobians, kMotion, row, kMotionSize, by_motion);
    Put<4>(jacobians, kOrientation, row, 4, Eigen::Matrix<double, 3, 4>::Zero());
    Put<1>(jacobians, kTime, row, 1, -weight * (launch.velocity + t * gravity));
    Put<2>(jacobians, kTilt, row, 2, (0.5 * weight * t * t) * gravity_by_tilt);
    if (!is_after_) return;
    Put<Eigen::Dynamic>(jacobians, kImpulse, row, ImpulseSize(),
                        (weight * t) * launch.velocity_by_impulse);
    Put<2>(jacobians, kContact, row, 2, Eigen::Matrix<double, 3, 2>::Zero());
    if (body_.is_reference) return;
    Put<1>(jacobians, kLogMass, row, 1, (weight * t) * launch.velocity_by_log_mass);
  }

  // `by_turn`: of the residual by a small turn of the pose in the world.
  void FillOrientation(double** jacobians, int row, const Matrix3& by_turn,
                       const FreeRotation& rotation, const Launch& launch, const double* q) const {
    const Matrix3 by_spin = by_turn * rotation.psi();
    Eigen::Matrix<double, 3, kMotionSize> by_motion = Eigen::Matrix<double, 3, kMotionSize>::Zero();
    if (is_after_) by_motion.leftCols<3>() = by_spin * launch.spin_by_position;
    by_motion.rightCols<3>() = by_spin;
    Put<kMotionSize>(jacobians, kMotion, row, kMotionSize, by_motion);
    // A change dq of the quaternion is the turn 2 Im(dq q*).
    Eigen::Matrix<double, 3, 4> turn_by_q;
    turn_by_q.col(0) = -Vector3<double>(q[1], q[2], q[3]);
    turn_by_q.rightCols<3>() = q[0] * Matrix3::Identity() + Skew(Vector3<double>(q[1], q[2], q[3]));
    Put<4>(jacobians, kOrientation, row, 4,
           2.0 * (by_turn + by_spin * Skew(launch.spin)) * turn_by_q);
    Put<1>(jacobians, kTime, row, 1, -by_turn * rotation.omega());
    Put<2>(jacobians, kTilt, row, 2, Eigen::Matrix<double, 3, 2>::Zero());
    if (!is_after_) return;
    Put<Eigen::Dynamic>(jacobians, kImpulse, row, ImpulseSize(), by_spin * launch.spin_by_impulse);
    Put<2>(jacobians, kContact, row, 2, by_spin * launch.spin_by_contact);
    if (body_.is_reference) return;
    Put<1>(jacobians, kLogMass, row, 1, by_spin * launch.spin_by_log_mass);
  }

  Body body_;
  bool is_after_;
  TiltedGravity gravity_;
  ContactFrame contact_;
  std::vector<FlightPose> poses_;
  std::vector<int> pairs_;
};

}  // namespace smash
