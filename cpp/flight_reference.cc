#include "flight_reference.h"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/manifold.h>

#include <algorithm>
#include <stdexcept>

#include "functors/flight_reference.h"
#include "refined_problem.h"
#include "smash/src/bridge/flight_reference.rs.h"
#include "validate.h"

namespace smash {
namespace {

using MatrixX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Evaluation {
  Eigen::VectorXd residuals;
  // By each block; by the tangent of the orientation, since off the unit sphere there is no right
  // and wrong.
  std::vector<MatrixX> jacobians;
};

Evaluation Evaluate(const ceres::CostFunction& cost, const std::vector<double*>& values) {
  Evaluation evaluation;
  evaluation.residuals.resize(cost.num_residuals());
  std::vector<double*> targets;
  for (const int size : cost.parameter_block_sizes()) {
    evaluation.jacobians.emplace_back(cost.num_residuals(), size);
  }
  for (MatrixX& jacobian : evaluation.jacobians) targets.push_back(jacobian.data());
  cost.Evaluate(values.data(), evaluation.residuals.data(), targets.data());
  bool finite = evaluation.residuals.allFinite();
  for (const MatrixX& jacobian : evaluation.jacobians) finite = finite && jacobian.allFinite();
  if (!finite) throw std::runtime_error("a flight whose residuals or derivatives aren't finite");
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
  ceres::QuaternionManifold().PlusJacobian(values[kOrientation], plus.data());
  evaluation.jacobians[kOrientation] = evaluation.jacobians[kOrientation] * plus;
  return evaluation;
}

Evaluation EvaluateReference(const FlightCost& cost, const std::vector<double*>& values) {
  ceres::DynamicAutoDiffCostFunction<FlightReference> reference(new FlightReference(cost));
  for (const int size : cost.parameter_block_sizes()) reference.AddParameterBlock(size);
  reference.SetNumResiduals(cost.num_residuals());
  return Evaluate(reference, values);
}

// Central differences by one block, the orientation's along its tangent.
MatrixX Differences(const ceres::CostFunction& cost, const std::vector<double*>& values,
                    std::size_t block) {
  // Rounding, 1e-16 of some hundred deviations over the step, and curvature, the step's square,
  // both stay below a millionth.
  constexpr double kStep = 1e-5;
  const int size = cost.parameter_block_sizes()[block];
  const int tangent = block == kOrientation ? 3 : size;
  const std::vector<double> start(values[block], values[block] + size);
  const auto residuals_at = [&](int column, double step) {
    std::vector<double> moved = start;
    if (block == kOrientation) {
      Eigen::Vector3d turn = Eigen::Vector3d::Zero();
      turn[column] = step;
      ceres::QuaternionManifold().Plus(start.data(), turn.data(), moved.data());
    } else {
      moved[static_cast<std::size_t>(column)] += step;
    }
    std::vector<double*> at = values;
    at[block] = moved.data();
    Eigen::VectorXd residuals(cost.num_residuals());
    cost.Evaluate(at.data(), residuals.data(), nullptr);
    return residuals;
  };
  MatrixX differences(cost.num_residuals(), tangent);
  for (int column = 0; column < tangent; ++column) {
    differences.col(column) =
        (residuals_at(column, kStep) - residuals_at(column, -kStep)) / (2.0 * kStep);
  }
  return differences;
}

// The largest difference of two columns over the largest number in the second; 0 where both vanish.
double ColumnDifference(const Eigen::VectorXd& column, const Eigen::VectorXd& reference) {
  const double difference = (column - reference).lpNorm<Eigen::Infinity>();
  return difference == 0.0 ? 0.0 : difference / reference.lpNorm<Eigen::Infinity>();
}

}  // namespace

FlightDifference compare_flights(const RefinedScene& scene, const RefinedProblem& problem) {
  CheckRefinedProblem(scene, problem);
  FlightDifference largest{};
  VisitFlights(scene, problem, [&](const Flight& flight) {
    const auto& cost = dynamic_cast<const FlightCost&>(*flight.cost);
    const std::vector<double*> values = ValuesOf(flight.blocks);
    const Evaluation by_hand = Evaluate(cost, values);
    const Evaluation reference = EvaluateReference(cost, values);
    const double value = (by_hand.residuals - reference.residuals).lpNorm<Eigen::Infinity>();
    largest.value = std::max(largest.value, value);
    for (std::size_t block = 0; block < values.size(); ++block) {
      for (Eigen::Index column = 0; column < reference.jacobians[block].cols(); ++column) {
        const double derivative = ColumnDifference(by_hand.jacobians[block].col(column),
                                                   reference.jacobians[block].col(column));
        largest.derivative = std::max(largest.derivative, derivative);
      }
    }
    ++largest.flights;
  });
  return largest;
}

FlightDifference difference_effects(const RefinedScene& scene, const RefinedProblem& problem) {
  CheckRefinedProblem(scene, problem);
  FlightDifference largest{};
  VisitFlights(scene, problem, [&](const Flight& flight) {
    if (dynamic_cast<const FlightCost*>(flight.cost)) return;
    const std::vector<double*> values = ValuesOf(flight.blocks);
    const Evaluation automatic = Evaluate(*flight.cost, values);
    for (std::size_t block = 0; block < values.size(); ++block) {
      // What is held may be discrete.
      if (flight.blocks[block]->place < 0) continue;
      const MatrixX reference = Differences(*flight.cost, values, block);
      for (Eigen::Index column = 0; column < reference.cols(); ++column) {
        const double apart = (automatic.jacobians[block].col(column) - reference.col(column))
                                 .lpNorm<Eigen::Infinity>();
        // Of a column that is below one deviation a unit nobody would see anything.
        const double size = std::max(1.0, reference.col(column).lpNorm<Eigen::Infinity>());
        largest.derivative = std::max(largest.derivative, apart / size);
      }
    }
    ++largest.flights;
  });
  return largest;
}

}  // namespace smash
