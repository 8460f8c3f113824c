#include "paper_problem.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <stdexcept>
#include <string>

#include "ceres_compat.h"
#include "functors/gravity.h"
#include "functors/impulse.h"
#include "functors/momentum.h"
#include "functors/orientation.h"
#include "functors/position.h"
#include "validate.h"

namespace smash {
namespace {

// SMASH section 4.1.
constexpr double kMomentumWeight = 0.1;
constexpr double kImpulseWeight = 0.1;
constexpr double kGravityWeight = 1.0;
constexpr double kPositionWeight = 4.0;
constexpr double kOrientationWeight = 4.0;

// Builds the problem over a copy of the start values, which the solver then moves.
class PaperProblem {
 public:
  PaperProblem(const PaperScene& scene, double collision_frames, PaperPhase phase,
               const PaperUnknowns& start)
      : scene_(scene), collision_frames_(collision_frames), phase_(phase), unknowns_(start) {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) AddBody(i);
    AddWeighted(GravityFunctor::Create(scene_.gravity_m_s2), kGravityWeight, tilt());
    if (has_partner()) AddMomentum();
    if (phase_ != PaperPhase::Trajectories) AddImpulse();
  }

  PaperSolution Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.preconditioner_type = ceres::JACOBI;
    options.num_threads = 1;
    options.max_num_iterations = 100;
    // The paper names no limits. With Ceres' own tolerance of 1e-6 the mass ratio of exact scenes
    // is three times further off; below 1e-8 it gains nothing.
    options.function_tolerance = 1e-8;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) {
      throw std::runtime_error("no usable solution: " + summary.message);
    }
    PaperSolution solution;
    solution.unknowns = unknowns_;
    solution.cost_initial = summary.initial_cost;
    solution.cost_final = summary.final_cost;
    solution.iterations =
        static_cast<std::uint32_t>(summary.num_successful_steps + summary.num_unsuccessful_steps);
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    return solution;
  }

 private:
  bool has_partner() const { return scene_.bodies.size() == 2; }
  double* tilt() { return unknowns_.tilt.data(); }
  double* impulse() { return unknowns_.impulse.data(); }
  double* mass_ratio() { return &unknowns_.mass_ratio; }

  // Weighted as in eq. 16: 1/2 w |f|^2.
  template <typename... Blocks>
  void AddWeighted(ceres::CostFunction* cost, double weight, Blocks*... blocks) {
    auto* loss = new ceres::ScaledLoss(nullptr, weight, ceres::TAKE_OWNERSHIP);
    problem_.AddResidualBlock(cost, loss, blocks...);
  }

  void AddBody(std::size_t index) {
    const PaperBody& body = scene_.bodies[index];
    PaperBodyUnknowns& unknown = unknowns_.bodies[index];
    if (body.has_spin) {
      problem_.AddParameterBlock(unknown.orientation.data(), 4, new ceres::QuaternionManifold);
    }
    if (index == 1) {
      problem_.AddParameterBlock(mass_ratio(), 1);
      problem_.SetParameterLowerBound(mass_ratio(), 0, kSmallestMassRatio);
      problem_.SetParameterUpperBound(mass_ratio(), 0, kLargestMassRatio);
    }
    for (const PaperObservation& observation : body.observations) {
      AddObservation(index, observation);
    }
  }

  void AddObservation(std::size_t index, const PaperObservation& observation) {
    PaperBodyUnknowns& unknown = unknowns_.bodies[index];
    const double fps = scene_.frames_per_second;
    const double frames = observation.time_frames - collision_frames_;
    PaperFlight& flight = frames < 0 ? unknown.before : unknown.after;
    AddWeighted(PositionFunctor::Create(scene_.gravity_m_s2 / (fps * fps), frames,
                                        ToVector3(observation.position)),
                kPositionWeight, flight.parabola.data(), tilt(), unknown.position.data());
    const PaperBody& body = scene_.bodies[index];
    if (!body.has_spin || !observation.has_orientation) return;
    const OrientationFunctor orientation(ToVector3(body.inertia_per_mass), frames, fps,
                                         ToQuaternion(observation.orientation));
    double* q = unknown.orientation.data();
    double* k = flight.angular_momentum.data();
    if (index == 0) {
      AddWeighted(OrientationFunctor::Create(orientation), kOrientationWeight, q, k);
    } else {
      AddWeighted(OrientationWithMassFunctor::Create(orientation), kOrientationWeight, q, k,
                  mass_ratio());
    }
  }

  void AddMomentum() {
    PaperBodyUnknowns& a = unknowns_.bodies[0];
    PaperBodyUnknowns& b = unknowns_.bodies[1];
    AddWeighted(LinearMomentumFunctor::Create(scene_.frames_per_second), kMomentumWeight,
                a.before.parabola.data(), a.after.parabola.data(), b.before.parabola.data(),
                b.after.parabola.data(), tilt(), mass_ratio());
    // Where a spin isn't measured, eq. 12 would only define it.
    if (!scene_.bodies[0].has_spin || !scene_.bodies[1].has_spin) return;
    AddWeighted(AngularMomentumFunctor::Create(scene_.frames_per_second), kMomentumWeight,
                a.before.parabola.data(), a.after.parabola.data(), b.before.parabola.data(),
                b.after.parabola.data(), tilt(), a.position.data(), b.position.data(),
                a.before.angular_momentum.data(), a.after.angular_momentum.data(),
                b.before.angular_momentum.data(), b.after.angular_momentum.data(), mass_ratio());
  }

  void AddImpulse() {
    PaperBodyUnknowns& a = unknowns_.bodies[0];
    AddWeighted(LinearImpulseFunctor::Create(scene_.frames_per_second), kImpulseWeight,
                a.before.parabola.data(), a.after.parabola.data(), tilt(), impulse());
    AddAngularImpulse(0, 1.0);
    if (!has_partner()) return;
    PaperBodyUnknowns& b = unknowns_.bodies[1];
    AddWeighted(LinearImpulseWithMassFunctor::Create(scene_.frames_per_second), kImpulseWeight,
                b.before.parabola.data(), b.after.parabola.data(), tilt(), impulse(), mass_ratio());
    AddAngularImpulse(1, -1.0);
  }

  void AddAngularImpulse(std::size_t index, double sign) {
    if (!scene_.bodies[index].has_spin) return;
    PaperBodyUnknowns& own = unknowns_.bodies[index];
    double* k_before = own.before.angular_momentum.data();
    double* k_after = own.after.angular_momentum.data();
    double* b4 = own.position.data();
    if (phase_ == PaperPhase::ContactPoint) {
      AddWeighted(AngularImpulseFunctor::Create(sign), kImpulseWeight, k_before, k_after, b4,
                  unknowns_.contact_point.data(), impulse());
    } else if (has_partner()) {
      AddWeighted(AngularImpulseAtMidpointFunctor::Create(sign), kImpulseWeight, k_before, k_after,
                  b4, unknowns_.bodies[1 - index].position.data(), impulse());
    } else {
      AddWeighted(AngularImpulseOnPlaneFunctor::Create(ToVector3(scene_.plane_normal),
                                                       scene_.plane_height_m),
                  kImpulseWeight, k_before, k_after, b4, impulse());
    }
  }

  const PaperScene& scene_;
  double collision_frames_;
  PaperPhase phase_;
  PaperUnknowns unknowns_;
  ceres::Problem problem_;
};

}  // namespace

PaperSolution SolvePaperPhase(const PaperScene& scene, double collision_frames, PaperPhase phase,
                              const PaperUnknowns& start) {
  return PaperProblem(scene, collision_frames, phase, start).Solve();
}

}  // namespace smash
