#include "refined_problem.h"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "acting_effects.h"
#include "ceres_compat.h"
#include "flight_steps.h"
#include "functors/contact_prior.h"
#include "functors/effect_flight.h"
#include "functors/restitution.h"
#include "functors/tilt_prior.h"
#include "refined_summary.h"
#include "validate.h"

namespace smash {
namespace {

// An integrator's error larger than this share of a deviation, or of what the fit misses where that
// is more, could be taken for physics.
constexpr double kLargestError = 0.02;
// Deviations; what misses more may be on its way beyond all numbers.
constexpr double kMostMissed = 100.0;
constexpr int kFinest = 16;
// In a row, with a free collision time at an end of its segment.
constexpr int kMostIterationsAtAnEnd = 4;

// Ends the search where the collision time stays at an end of its segment: there steps are cut
// short, and most often the optimum is in the next segment.
class StaysAtAnEnd : public ceres::IterationCallback {
 public:
  StaysAtAnEnd(const RefinedProblem& problem, const double* time_s)
      : problem_(problem), time_s_(time_s) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    const bool is_at_an_end = *time_s_ <= problem_.earliest_s || *time_s_ >= problem_.latest_s;
    iterations_ = is_at_an_end && !problem_.hold.collision_time ? iterations_ + 1 : 0;
    return iterations_ < kMostIterationsAtAnEnd ? ceres::SOLVER_CONTINUE
                                                : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const RefinedProblem& problem_;
  const double* time_s_;
  int iterations_ = 0;
};

class RefinedFit {
 public:
  // `fineness`: how many times finer than usual effects' flights are integrated.
  RefinedFit(const RefinedScene& scene, const RefinedProblem& problem, int fineness)
      : scene_(scene),
        problem_(problem),
        fineness_(fineness),
        steps_(scene, problem),
        blocks_(scene, problem),
        effects_(EffectBodies(scene)) {
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
    RefinedSolution solution{};
    if (problem_.most_iterations > 0) Minimise(solution);
    solution.unknowns = blocks_.Unknowns();
    Summarise(scene_, flights_, blocks_, problem_.jacobian, solution);
    if (problem_.most_iterations == 0) solution.cost_initial = solution.cost;
    return solution;
  }

  // Whether the integrator's error counts beside what the fit misses.
  bool IsInexact(double cost) const {
    double numbers = 0.0;
    for (const Flight& flight : flights_) numbers += flight.cost->num_residuals();
    const double missed = std::sqrt(2.0 * cost / numbers);
    return IntegrationError() > kLargestError * std::min(kMostMissed, std::max(1.0, missed));
  }

  // Whether a body turns much faster than at the start.
  bool IsTooCoarse(const RefinedUnknowns& unknowns) const { return steps_.AreTooLong(unknowns); }

  const std::vector<Flight>& flights() const { return flights_; }

 private:
  void Minimise(RefinedSolution& solution) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.num_threads = 1;
    options.max_num_iterations = static_cast<int>(problem_.most_iterations);
    options.function_tolerance = 1e-8;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-12;
    // Where nothing tells the contact point a step can lead to a spin beyond all numbers: shorten
    // it.
    options.max_num_consecutive_invalid_steps = 50;
    options.logging_type = ceres::SILENT;
    StaysAtAnEnd stays_at_an_end(problem_, blocks_.time.values.data());
    options.callbacks.push_back(&stays_at_an_end);
    options.update_state_every_iteration = true;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    if (!summary.IsSolutionUsable()) {
      throw std::runtime_error("no usable solution: " + summary.message);
    }
    solution.cost_initial = summary.initial_cost;
    solution.iterations = static_cast<std::uint32_t>(summary.iterations.size()) - 1;
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
  }

  bool has_spin(std::size_t body) const { return scene_.bodies[body].has_spin; }

  void AddFlights() {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const RefinedBody& body = scene_.bodies[i];
      const std::vector<double> times_s = PoseTimes(scene_, effects_[i], i, problem_.start);
      std::vector<FlightPose> before, after;
      for (std::size_t k = 0; k < times_s.size(); ++k) {
        const bool is_before = 2.0 * times_s[k] < problem_.earliest_s + problem_.latest_s;
        (is_before ? before : after).push_back(ToFlightPose(body.poses[k]));
      }
      std::reverse(before.begin(), before.end());
      AddFlight(i, false, std::move(before));
      AddFlight(i, true, std::move(after));
    }
  }

  bool HasEffects(std::size_t body, bool is_after) const {
    return is_after ? effects_[body].HasAny() : effects_[body].HasBeyondStrike();
  }

  void AddFlight(std::size_t index, bool is_after, std::vector<FlightPose> poses) {
    if (poses.empty()) return;
    Flight flight{index, is_after, nullptr, std::move(poses), {}};
    if (HasEffects(index, is_after)) {
      flight.blocks = blocks_.OfEffectFlight(index, is_after, effects_[index].used_parameters);
      flight.cost = EffectCost(flight);
    } else {
      flight.blocks = blocks_.OfFlight(index, is_after);
      flight.cost = PlainCost(flight);
    }
    ceres_.AddResidualBlock(flight.cost, nullptr, ValuesOf(flight.blocks));
    flights_.push_back(std::move(flight));
  }

  ceres::CostFunction* PlainCost(const Flight& flight) const {
    const RefinedBody& body = scene_.bodies[flight.body];
    return new FlightCost({ToVector3(body.inertia_per_mass), body.has_spin, flight.body == 0},
                          flight.is_after, Gravity(), blocks_.contact, flight.poses,
                          steps_.Pairs(flight));
  }

  ceres::CostFunction* EffectCost(const Flight& flight) const {
    auto functor = std::make_unique<EffectFlight>(effects_[flight.body].body, flight.is_after,
                                                  Gravity(), blocks_.contact, flight.poses,
                                                  steps_.WithEffects(flight, fineness_));
    // One pass takes so many derivatives.
    if (flight.blocks.size() <= 8) return DynamicCost<20>(std::move(functor), flight);
    return DynamicCost<28>(std::move(functor), flight);
  }

  template <int kStride>
  ceres::CostFunction* DynamicCost(std::unique_ptr<EffectFlight> functor,
                                   const Flight& flight) const {
    auto* cost = new ceres::DynamicAutoDiffCostFunction<EffectFlight, kStride>(functor.release());
    for (const Block* block : flight.blocks) {
      cost->AddParameterBlock(static_cast<int>(block->values.size()));
    }
    int residuals = 0;
    for (const FlightPose& pose : flight.poses) residuals += flight.Rows(scene_, pose);
    cost->SetNumResiduals(residuals);
    return cost;
  }

  // How much residuals of effects' flights change when they are integrated twice as finely, in
  // their deviations.
  double IntegrationError() const {
    double largest = 0.0;
    for (const Flight& flight : flights_) {
      if (!HasEffects(flight.body, flight.is_after)) continue;
      const std::vector<double*> values = ValuesOf(flight.blocks);
      const std::vector<int> steps = steps_.WithEffects(flight, fineness_);
      std::vector<int> finer = steps;
      for (int& count : finer) count *= 2;
      const Eigen::VectorXd difference =
          ResidualsOf(flight, steps, values) - ResidualsOf(flight, finer, values);
      largest = std::max(largest, difference.lpNorm<Eigen::Infinity>());
    }
    return largest;
  }

  Eigen::VectorXd ResidualsOf(const Flight& flight, const std::vector<int>& steps,
                              const std::vector<double*>& values) const {
    const EffectFlight functor(effects_[flight.body].body, flight.is_after, Gravity(),
                               blocks_.contact, flight.poses, steps);
    Eigen::VectorXd residuals(flight.cost->num_residuals());
    functor(values.data(), residuals.data());
    return residuals;
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
      HoldIfPlaceless(*block);
    }
    for (std::size_t i = 0; i < blocks_.parameters.size(); ++i) {
      Block& block = blocks_.parameters[i];
      double* value = block.values.data();
      HoldIfPlaceless(block);
      if (block.place < 0 || !ceres_.HasParameterBlock(value)) continue;
      ceres_.SetParameterLowerBound(value, 0, scene_.parameters[i].low);
      ceres_.SetParameterUpperBound(value, 0, scene_.parameters[i].high);
    }
    if (blocks_.log_mass.place >= 0 && ceres_.HasParameterBlock(blocks_.log_mass.values.data())) {
      ceres_.SetParameterLowerBound(blocks_.log_mass.values.data(), 0, -kLargestLogMassRatio);
      ceres_.SetParameterUpperBound(blocks_.log_mass.values.data(), 0, kLargestLogMassRatio);
    }
    if (blocks_.time.place < 0) return;
    ceres_.SetParameterLowerBound(blocks_.time.values.data(), 0, problem_.earliest_s);
    ceres_.SetParameterUpperBound(blocks_.time.values.data(), 0, problem_.latest_s);
  }

  void HoldIfPlaceless(Block& block) {
    double* values = block.values.data();
    if (block.place < 0 && ceres_.HasParameterBlock(values)) {
      ceres_.SetParameterBlockConstant(values);
    }
  }

  TiltedGravity Gravity() const { return GravityOf(scene_); }

  const RefinedScene& scene_;
  const RefinedProblem& problem_;
  int fineness_;
  FlightSteps steps_;
  RefinedBlocks blocks_;
  std::vector<ActingEffects> effects_;
  std::vector<Flight> flights_;
  ceres::Problem ceres_;
};

}  // namespace

FlightPose ToFlightPose(const RefinedPose& pose) {
  return {pose.time_s,
          ToVector3(pose.position),
          pose.position_std_m,
          ToQuaternion(pose.orientation),
          pose.orientation_std_rad,
          pose.has_orientation};
}

RefinedSolution SolveRefined(const RefinedScene& scene, const RefinedProblem& problem) {
  int fineness = 1;
  RefinedProblem from = problem;
  bool is_first = true;
  double cost_initial = 0.0;
  for (;;) {
    RefinedFit fit(scene, from, fineness);
    RefinedSolution solution = fit.Solve();
    if (is_first) cost_initial = solution.cost_initial;
    solution.cost_initial = cost_initial;
    // The steps were chosen by the start's spins.
    const bool is_coarse = is_first && fit.IsTooCoarse(solution.unknowns);
    const bool is_inexact = fit.IsInexact(solution.cost);
    if (!is_coarse && !is_inexact) return solution;
    if (is_inexact && (fineness *= 2) > kFinest) {
      throw std::runtime_error("an effect's law changes too fast along the flight");
    }
    is_first = false;
    from.start = solution.unknowns;
  }
}

void VisitFlights(const RefinedScene& scene, const RefinedProblem& problem,
                  const std::function<void(const Flight&)>& visit) {
  RefinedFit fit(scene, problem, 1);
  for (const Flight& flight : fit.flights()) visit(flight);
}

}  // namespace smash
