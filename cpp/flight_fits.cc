#include "flight_fits.h"

#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <vector>

#include "functors/jump.h"
#include "refined_problem.h"

namespace smash {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The orientation residuals of the first `count` poses of a flight over six unknowns: a turn of the
// start's orientation in the world, and l. As ceres::TinySolver wants it.
class SpinResiduals {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 6 };

  SpinResiduals(const Vector3<double>& inertia, double collision_s, double longest_step_s,
                const Quaternion<double>& start, const std::vector<FlightPose>& poses,
                std::size_t count)
      : inertia_(inertia),
        collision_s_(collision_s),
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
    double reached_s = collision_s_;
    for (std::size_t i = 0; i < count_; ++i) {
      const FlightPose& pose = poses_[i];
      const double duration_s = pose.time_s - reached_s;
      rotation.Advance(duration_s, FreeRotation::Pairs(duration_s, longest_step_s_),
                       jacobian != nullptr);
      reached_s = pose.time_s;
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
  double collision_s_;
  double longest_step_s_;
  Quaternion<double> start_;
  const std::vector<FlightPose>& poses_;
  std::size_t count_;
};

// The rotation at the collision that leads to `pose` with the angular momentum `l`.
FreeRotation BackToCollision(const Vector3<double>& inertia, const FlightPose& pose,
                             const Vector3<double>& l, double step_s, double collision_s) {
  FreeRotation rotation(inertia, pose.world_from_body, l);
  const double duration_s = collision_s - pose.time_s;
  rotation.Advance(duration_s, FreeRotation::Pairs(duration_s, step_s), false);
  return rotation;
}

Eigen::Matrix3d ToMatrix3(const std::array<double, 9>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

}  // namespace

SpinFit FitSpin(const SpinFlight& flight) {
  std::vector<FlightPose> poses;
  for (const RefinedPose& pose : flight.poses) {
    if (pose.has_orientation) poses.push_back(ToFlightPose(pose));
  }
  const Vector3<double> inertia = ToVector3(flight.inertia_per_mass);
  const Vector3<double> l = ToVector3(flight.spin);
  const double step_s = LongestStep(inertia, poses[0].world_from_body, l);
  Quaternion<double> start =
      BackToCollision(inertia, poses[0], l, step_s, flight.collision_time_s).world_from_body();
  Vector6 unknowns;
  unknowns << 0, 0, 0, l;
  SpinFit fit;
  for (std::size_t count = std::min<std::size_t>(2, poses.size());;) {
    const SpinResiduals residuals(inertia, flight.collision_time_s, step_s, start, poses, count);
    ceres::TinySolver<SpinResiduals> solver;
    solver.options.max_num_iterations = 20;
    solver.options.function_tolerance = count == poses.size() ? 1e-8 : 1e-3;
    solver.Solve(residuals, &unknowns);
    start = Multiply(ExpRotation(unknowns.head<3>()), start);
    unknowns.head<3>().setZero();
    if (count == poses.size()) break;
    count = std::min(2 * count, poses.size());
  }
  const SpinResiduals residuals(inertia, flight.collision_time_s, step_s, start, poses,
                                poses.size());
  Eigen::VectorXd values(residuals.NumResiduals());
  Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(residuals.NumResiduals(), 6);
  residuals(unknowns.data(), values.data(), jacobian.data());
  start.normalize();
  std::copy_n(start.data(), 4, fit.orientation.begin());
  std::copy_n(unknowns.data() + 3, 3, fit.spin.begin());
  fit.cost = 0.5 * values.squaredNorm();
  Eigen::Map<Matrix6>(fit.information.data()) = jacobian.transpose() * jacobian;
  return fit;
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
