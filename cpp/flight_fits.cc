#include "flight_fits.h"

#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flight_steps.h"
#include "functors/jump.h"
#include "refined_problem.h"

namespace smash {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The orientation residuals of the first `count` poses of a flight over six unknowns at the first
// of them: a turn of the start's orientation in the world, and l. As ceres::TinySolver wants it.
class SpinResiduals {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 6 };

  SpinResiduals(const Vector3<double>& inertia, double longest_step_s,
                const Quaternion<double>& start, const std::vector<FlightPose>& poses,
                std::size_t count)
      : inertia_(inertia),
        longest_step_s_(longest_step_s),
        start_(start),
        poses_(poses),
        count_(count) {}

  int NumResiduals() const { return 3 * static_cast<int>(count_); }

  bool operator()(const double* unknowns, double* residuals, double* jacobian) const {
    const Vector3<double> turn(unknowns[0], unknowns[1], unknowns[2]);
    const Vector3<double> l(unknowns[3], unknowns[4], unknowns[5]);
    const Matrix3 start_by_turn = LeftJacobian(turn);
    FreeRotation rotation(inertia_, Multiply(ExpRotation(turn), start_), l);
    for (std::size_t i = 0; i < count_; ++i) {
      const FlightPose& pose = poses_[i];
      if (i > 0) {
        const double duration_s = pose.time_s - poses_[i - 1].time_s;
        rotation.Advance(duration_s, FreeRotation::Pairs(duration_s, longest_step_s_),
                         jacobian ? FreeRotation::kState : FreeRotation::kNothing);
      }
      const double per_rad = 1.0 / pose.orientation_std_rad;
      const Vector3<double> error =
          LogRotation(Multiply(Conjugate(pose.world_from_body), rotation.world_from_body()));
      Eigen::Map<Vector3<double>> residual(residuals + 3 * i);
      residual = per_rad * error;
      if (!jacobian) continue;
      // TinySolver's Jacobian is column by column.
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6>> all(jacobian, NumResiduals(), 6);
      const Matrix3 by_turn =
          per_rad * InverseRightJacobian(error) * ToMatrix(rotation.world_from_body()).transpose();
      const Matrix3 by_spin = by_turn * rotation.psi();
      all.block<3, 3>(3 * static_cast<Eigen::Index>(i), 0) =
          (by_turn + by_spin * Skew(l)) * start_by_turn;
      all.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3) = by_spin;
    }
    return true;
  }

 private:
  Vector3<double> inertia_;
  double longest_step_s_;
  Quaternion<double> start_;
  const std::vector<FlightPose>& poses_;
  std::size_t count_;
};

Eigen::Matrix3d ToMatrix3(const std::array<double, 9>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

// A spin that nobody wants to know more of.
SpinFit Hopeless() {
  SpinFit fit{};
  fit.orientation[0] = 1.0;
  fit.cost = std::numeric_limits<double>::max();
  return fit;
}

// Whether a fit to half of these poses misses one of the others as no right spin would: by more
// than a radian, and by more than noise can do.
bool IsFarOff(const SpinResiduals& residuals, const Vector6& unknowns,
              const std::vector<FlightPose>& poses) {
  constexpr double kFarRad = 1.2;
  constexpr double kFarDeviations = 8.0;
  Eigen::VectorXd values(residuals.NumResiduals());
  residuals(unknowns.data(), values.data(), nullptr);
  for (Eigen::Index i = 0; 3 * i < values.size(); ++i) {
    const double deviations = values.segment<3>(3 * i).norm();
    const double angle = deviations * poses[static_cast<std::size_t>(i)].orientation_std_rad;
    if (angle > kFarRad && deviations > kFarDeviations) return true;
  }
  return false;
}

// The fit as it is at the collision, from what it is at the first pose: phi(0) there depends on a
// turn and l here by 1 + Psi [l]x and Psi.
SpinFit AtCollision(const SpinFlight& flight, double step_s, Quaternion<double> orientation,
                    const Vector6& unknowns, const std::vector<FlightPose>& poses) {
  const Vector3<double> inertia = ToVector3(flight.inertia_per_mass);
  const Vector3<double> l = unknowns.tail<3>();
  const SpinResiduals residuals(inertia, step_s, orientation, poses, poses.size());
  Eigen::VectorXd values(residuals.NumResiduals());
  Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(residuals.NumResiduals(), 6);
  residuals(unknowns.data(), values.data(), jacobian.data());
  const double duration_s = poses[0].time_s - flight.collision_time_s;
  const int pairs = FreeRotation::Pairs(duration_s, step_s);
  orientation.normalize();
  FreeRotation back(inertia, orientation, l);
  back.Advance(-duration_s, pairs, FreeRotation::kNothing);
  FreeRotation forth(inertia, back.world_from_body(), l);
  forth.Advance(duration_s, pairs, FreeRotation::kState);
  Matrix6 first_by_collision = Matrix6::Identity();
  first_by_collision.topLeftCorner<3, 3>() += forth.psi() * Skew(l);
  first_by_collision.topRightCorner<3, 3>() = forth.psi();
  const Eigen::Matrix<double, Eigen::Dynamic, 6> at_collision = jacobian * first_by_collision;
  SpinFit fit;
  const Quaternion<double> q = back.world_from_body();
  std::copy_n(q.data(), 4, fit.orientation.begin());
  std::copy_n(l.data(), 3, fit.spin.begin());
  fit.cost = 0.5 * values.squaredNorm();
  Eigen::Map<Matrix6>(fit.information.data()) = at_collision.transpose() * at_collision;
  return fit;
}

}  // namespace

SpinFit FitSpin(const SpinFlight& flight) {
  std::vector<FlightPose> poses;
  for (const RefinedPose& pose : flight.poses) {
    if (pose.has_orientation) poses.push_back(ToFlightPose(pose));
  }
  const Vector3<double> inertia = ToVector3(flight.inertia_per_mass);
  Quaternion<double> orientation = poses[0].world_from_body;
  Vector6 unknowns;
  unknowns << 0, 0, 0, ToVector3(flight.spin);
  // A start need not be exact: with steps four times as long the error is 256 times 5e-7 rad.
  const double step_s = 4.0 * LongestStep(inertia, orientation, unknowns.tail<3>());
  const double rough_step_s = 2.0 * step_s;
  for (std::size_t count = std::min<std::size_t>(2, poses.size());;) {
    const bool is_first = count <= 2;
    const bool is_last = count == poses.size();
    const SpinResiduals residuals(inertia, is_last ? step_s : rough_step_s, orientation, poses,
                                  count);
    if (!is_first && std::isfinite(flight.hopeless_cost) && IsFarOff(residuals, unknowns, poses)) {
      return Hopeless();
    }
    ceres::TinySolver<SpinResiduals> solver;
    // From the turn between two poses it is a long way; from there on each fit is near the next.
    // On the way a deviation is near enough; at the end a thousandth.
    solver.options.max_num_iterations = is_first ? 20 : 6;
    solver.options.function_tolerance = is_last ? 1e-6 : 1e-3;
    solver.options.cost_threshold = is_last ? 1e-6 : 0.1;
    solver.Solve(residuals, &unknowns);
    orientation = Multiply(ExpRotation(unknowns.head<3>()), orientation);
    unknowns.head<3>().setZero();
    if (solver.summary.final_cost > flight.hopeless_cost) return Hopeless();
    if (is_last) break;
    count = std::min(2 * count, poses.size());
  }
  return AtCollision(flight, step_s, orientation, unknowns, poses);
}

JumpFit FitJump(const RefinedScene& scene, rust::Slice<const Jump> jumps,
                const RefinedUnknowns& start) {
  const ContactFrame contact = ContactFrameOf(scene, start);
  std::vector<BodyJump> bodies;
  for (const Jump& jump : jumps) {
    bodies.push_back({ToVector3(jump.position), ToVector3(jump.velocity),
                      ToMatrix3(jump.velocity_weight), ToVector3(jump.spin),
                      ToMatrix3(jump.spin_weight)});
  }
  Eigen::Matrix3d impulse_basis = Eigen::Matrix3d::Zero();
  impulse_basis.leftCols(contact.impulse_basis.cols()) = contact.impulse_basis;
  const JumpFunctor functor(bodies, impulse_basis, contact.contact_origin, contact.contact_basis);
  using Function =
      ceres::TinySolverAutoDiffFunction<JumpFunctor, Eigen::Dynamic, JumpFunctor::kUnknowns>;
  const Function function(functor);
  Vector6 unknowns = Vector6::Zero();
  unknowns.head<3>() = impulse_basis.transpose() * ToVector3(start.impulse);
  unknowns[5] = start.log_mass_ratio;
  ceres::TinySolver<Function> solver;
  solver.Solve(function, &unknowns);
  const Vector3<double> impulse = impulse_basis * unknowns.head<3>();
  const Vector3<double> point =
      contact.contact_origin + contact.contact_basis * unknowns.segment<2>(3);
  JumpFit fit;
  std::copy_n(impulse.data(), 3, fit.impulse.begin());
  std::copy_n(point.data(), 3, fit.contact_point.begin());
  fit.log_mass_ratio = unknowns[5];
  fit.cost = solver.summary.final_cost;
  return fit;
}

}  // namespace smash
