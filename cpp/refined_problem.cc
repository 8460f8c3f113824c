#include "refined_problem.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "ceres_compat.h"
#include "functors/contact_prior.h"
#include "functors/restitution.h"
#include "functors/tilt_prior.h"
#include "refined_summary.h"
#include "validate.h"

namespace smash {
namespace {

// Radians a step, at the body's fastest.
constexpr double kLargestStepRad = 0.12;

class RefinedFit {
 public:
  RefinedFit(const RefinedScene& scene, const RefinedProblem& problem)
      : scene_(scene), problem_(problem), blocks_(scene, problem) {
    AddFlights();
    if (scene_.gravity_m_s2 > 0) {
      ceres_.AddResidualBlock(TiltPriorFunctor::Create(scene_.tilt_std_rad), nullptr,
                              blocks_.tilt.values.data());
    }
    if (AnySpin(scene_)) AddContactPriors();
    if (problem_.restitution.weight > 0) AddRestitution();
    HoldWhatIsKnown();
  }

  RefinedSolution Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.num_threads = 1;
    options.max_num_iterations = 50;
    options.function_tolerance = 1e-8;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-12;
    // Where nothing tells the contact point a step can lead to a spin beyond all numbers: shorten
    // it.
    options.max_num_consecutive_invalid_steps = 50;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    if (!summary.IsSolutionUsable()) {
      throw std::runtime_error("no usable solution: " + summary.message);
    }
    RefinedSolution solution;
    solution.unknowns = blocks_.Unknowns();
    solution.cost_initial = summary.initial_cost;
    solution.iterations = static_cast<std::uint32_t>(summary.iterations.size()) - 1;
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    Summarise(scene_, flights_, blocks_, solution);
    return solution;
  }

  // Whether a body turns much faster than at the start, so that its steps are too long.
  bool IsTooCoarse(const RefinedUnknowns& unknowns) const {
    for (const Flight& flight : flights_) {
      const double used_s = StepOf(flight.body, flight.is_after, problem_.start);
      if (StepOf(flight.body, flight.is_after, unknowns) < 0.7 * used_s) return true;
    }
    return false;
  }

  template <typename Visit>
  void VisitFlights(const Visit& visit) {
    for (const Flight& flight : flights_) {
      visit(*flight.cost, blocks_.ValuesOfFlight(flight.body, flight.is_after));
    }
  }

 private:
  bool has_spin(std::size_t body) const { return scene_.bodies[body].has_spin; }

  void AddFlights() {
    const TiltedGravity gravity{scene_.gravity_m_s2, ToVector3(scene_.down), Across()};
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const RefinedBody& body = scene_.bodies[i];
      const auto split =
          std::partition_point(body.poses.begin(), body.poses.end(), [&](const RefinedPose& pose) {
            return 2.0 * pose.time_s < problem_.earliest_s + problem_.latest_s;
          });
      std::vector<FlightPose> before, after;
      for (auto pose = split; pose != body.poses.begin();) before.push_back(ToFlightPose(*--pose));
      for (auto pose = split; pose != body.poses.end(); ++pose) {
        after.push_back(ToFlightPose(*pose));
      }
      AddFlight(i, false, gravity, std::move(before));
      AddFlight(i, true, gravity, std::move(after));
    }
  }

  void AddFlight(std::size_t index, bool is_after, const TiltedGravity& gravity,
                 std::vector<FlightPose> poses) {
    if (poses.empty()) return;
    const RefinedBody& body = scene_.bodies[index];
    const Vector3<double> inertia = ToVector3(body.inertia_per_mass);
    const double step_s = StepOf(index, is_after, problem_.start);
    std::vector<int> pairs;
    double reached_s = is_after ? problem_.earliest_s : problem_.latest_s;
    for (const FlightPose& pose : poses) {
      pairs.push_back(FreeRotation::Pairs(pose.time_s - reached_s, step_s));
      reached_s = pose.time_s;
    }
    auto* cost = new FlightCost({inertia, body.has_spin, index == 0}, is_after, gravity,
                                blocks_.contact, std::move(poses), std::move(pairs));
    ceres_.AddResidualBlock(cost, nullptr, blocks_.ValuesOfFlight(index, is_after));
    flights_.push_back({index, is_after, cost});
  }

  // The longest step of a flight that starts as `unknowns` say.
  double StepOf(std::size_t index, bool is_after, const RefinedUnknowns& unknowns) const {
    const RefinedMotion& motion = unknowns.bodies[index];
    Vector3<double> spin = ToVector3(motion.spin_before);
    if (is_after) {
      const double push = index == 0 ? 1.0 : -std::exp(-unknowns.log_mass_ratio);
      const Vector3<double> lever = ToVector3(unknowns.contact_point) - ToVector3(motion.position);
      spin += push * lever.cross(ToVector3(unknowns.impulse));
    }
    return LongestStep(ToVector3(scene_.bodies[index].inertia_per_mass),
                       ToQuaternion(motion.orientation), spin);
  }

  void AddContactPriors() {
    for (std::size_t i = 0; i < blocks_.bodies.size(); ++i) {
      ceres_.AddResidualBlock(ContactPriorFunctor::Create(blocks_.contact, ReachOf(i)), nullptr,
                              blocks_.bodies[i].motion.values.data(), blocks_.offset.values.data());
    }
  }

  double ReachOf(std::size_t body) const {
    return Reach(ToVector3(scene_.bodies[body].inertia_per_mass));
  }

  void AddRestitution() {
    const RestitutionPin& pin = problem_.restitution;
    RestitutionFunctor::Contact contact{blocks_.contact, ToVector3(scene_.plane_normal), {}};
    for (const RefinedBody& body : scene_.bodies) {
      contact.inertia_per_mass.push_back(ToVector3(body.inertia_per_mass));
      contact.has_spin.push_back(body.has_spin);
    }
    BodyBlocks& a = blocks_.bodies[0];
    auto* cost = RestitutionFunctor::Create(contact, pin.value, pin.weight);
    std::vector<double*> values = {a.motion.values.data(), a.orientation.values.data(),
                                   blocks_.impulse.values.data(), blocks_.offset.values.data()};
    if (blocks_.bodies.size() == 2) {
      BodyBlocks& b = blocks_.bodies[1];
      values.insert(values.end(), {b.motion.values.data(), b.orientation.values.data(),
                                   blocks_.log_mass.values.data()});
    }
    ceres_.AddResidualBlock(cost, nullptr, values);
  }

  void HoldWhatIsKnown() {
    for (std::size_t i = 0; i < blocks_.bodies.size(); ++i) {
      double* q = blocks_.bodies[i].orientation.values.data();
      if (has_spin(i)) {
        ceres_.SetManifold(q, new ceres::QuaternionManifold);
        continue;
      }
      ceres_.SetManifold(blocks_.bodies[i].motion.values.data(),
                         new ceres::SubsetManifold(kMotionSize, {6, 7, 8}));
      ceres_.SetParameterBlockConstant(q);
    }
    for (Block* block : {&blocks_.time, &blocks_.tilt, &blocks_.offset, &blocks_.log_mass}) {
      double* values = block->values.data();
      if (block->place < 0 && ceres_.HasParameterBlock(values)) {
        ceres_.SetParameterBlockConstant(values);
      }
    }
    if (blocks_.log_mass.place >= 0 && ceres_.HasParameterBlock(blocks_.log_mass.values.data())) {
      ceres_.SetParameterLowerBound(blocks_.log_mass.values.data(), 0, -kLargestLogMassRatio);
      ceres_.SetParameterUpperBound(blocks_.log_mass.values.data(), 0, kLargestLogMassRatio);
    }
    if (blocks_.time.place < 0) return;
    ceres_.SetParameterLowerBound(blocks_.time.values.data(), 0, problem_.earliest_s);
    ceres_.SetParameterUpperBound(blocks_.time.values.data(), 0, problem_.latest_s);
  }

  Eigen::Matrix<double, 3, 2> Across() const {
    Eigen::Matrix<double, 3, 2> across;
    across << ToVector3(scene_.across[0]), ToVector3(scene_.across[1]);
    return across;
  }

  const RefinedScene& scene_;
  const RefinedProblem& problem_;
  RefinedBlocks blocks_;
  std::vector<Flight> flights_;
  ceres::Problem ceres_;
};

}  // namespace

double LongestStep(const Vector3<double>& inertia_per_mass, const Quaternion<double>& q,
                   const Vector3<double>& l) {
  // The energy l.omega is constant: omega^2 is at most l.omega / I_min.
  const Vector3<double> omega =
      AngularVelocity(q, l, Vector3<double>(inertia_per_mass.cwiseInverse()));
  const double fastest = std::sqrt(std::max(0.0, l.dot(omega)) / inertia_per_mass.minCoeff());
  return kLargestStepRad / std::max(fastest, 1e-6);
}

FlightPose ToFlightPose(const RefinedPose& pose) {
  return {pose.time_s,
          ToVector3(pose.position),
          pose.position_std_m,
          ToQuaternion(pose.orientation),
          pose.orientation_std_rad,
          pose.has_orientation};
}

RefinedSolution SolveRefined(const RefinedScene& scene, const RefinedProblem& problem) {
  RefinedFit fit(scene, problem);
  RefinedSolution solution = fit.Solve();
  // The steps were chosen by the start's spins.
  if (!fit.IsTooCoarse(solution.unknowns)) return solution;
  RefinedProblem again = problem;
  again.start = solution.unknowns;
  return RefinedFit(scene, again).Solve();
}

void VisitFlights(
    const RefinedScene& scene, const RefinedProblem& problem,
    const std::function<void(const FlightCost&, const std::vector<double*>&)>& visit) {
  RefinedFit(scene, problem).VisitFlights(visit);
}

}  // namespace smash
