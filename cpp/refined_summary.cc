#include "refined_summary.h"

#include <stdexcept>

#include "ceres_compat.h"

namespace smash {
namespace {

using MatrixX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename Rows>
void Accumulate(const Rows& rows, MatrixX& information) {
  information.noalias() += rows.transpose() * rows;
}

void Copy(const MatrixX& from, rust::Vec<double>& to) {
  to.reserve(to.size() + static_cast<std::size_t>(from.size()));
  for (Eigen::Index i = 0; i < from.size(); ++i) to.push_back(from.data()[i]);
}

// The flight's derivatives by all unknowns, orientations as turns in the world.
MatrixX TangentJacobian(const RefinedScene& scene, const Flight& flight, const RefinedBlocks& all,
                        JacobianBy by, Eigen::VectorXd& residuals) {
  const auto rows = residuals.size();
  std::vector<MatrixX> ambient(flight.blocks.size());
  std::vector<double*> jacobians(flight.blocks.size(), nullptr);
  for (std::size_t i = 0; i < flight.blocks.size(); ++i) {
    const Block& block = *flight.blocks[i];
    const bool is_spin = i == kOrientation && !scene.bodies[flight.body].has_spin;
    const bool counts = by != JacobianBy::Parameters || all.IsParameter(block);
    if (block.place < 0 || is_spin || !counts) continue;
    ambient[i].resize(rows, static_cast<Eigen::Index>(block.values.size()));
    jacobians[i] = ambient[i].data();
  }
  const std::vector<double*> values = ValuesOf(flight.blocks);
  flight.cost->Evaluate(values.data(), residuals.data(), jacobians.data());
  MatrixX jacobian = MatrixX::Zero(rows, all.size);
  for (std::size_t i = 0; i < flight.blocks.size(); ++i) {
    if (!jacobians[i]) continue;
    const Block& block = *flight.blocks[i];
    auto target = jacobian.middleCols(block.place, block.tangent_size);
    if (i == kOrientation) {
      Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
      ceres::QuaternionManifold().PlusJacobian(block.values.data(), plus.data());
      // Ceres' tangent is half the angle.
      target = 0.5 * ambient[i] * plus;
    } else {
      target = ambient[i].leftCols(block.tangent_size);
    }
  }
  return jacobian;
}

// What is known of the tilt beforehand. The contact point's prior is no knowledge: what it alone
// determines is to be called undetermined.
MatrixX Prior(const RefinedScene& scene, const RefinedBlocks& blocks, double& chi2) {
  MatrixX prior = MatrixX::Zero(blocks.size, blocks.size);
  if (blocks.tilt.place >= 0) {
    const double weight = 1.0 / (scene.tilt_std_rad * scene.tilt_std_rad);
    const Eigen::Map<const Eigen::Vector2d> tilt(blocks.tilt.values.data());
    chi2 += weight * tilt.squaredNorm();
    prior.block<2, 2>(blocks.tilt.place, blocks.tilt.place).diagonal().setConstant(weight);
  }
  return prior;
}

}  // namespace

// With a Jacobian the information follows from it: the channels' are left at zero.
void Summarise(const RefinedScene& scene, const std::vector<Flight>& flights,
               const RefinedBlocks& blocks, JacobianBy jacobian_by, RefinedSolution& solution) {
  const bool with_jacobian = jacobian_by != JacobianBy::Nothing;
  MatrixX position = MatrixX::Zero(blocks.size, blocks.size);
  MatrixX orientation = MatrixX::Zero(blocks.size, blocks.size);
  double chi2 = 0.0;
  // A pose's residual and its rows of the Jacobian.
  struct Seen {
    RefinedResidual residual;
    MatrixX rows;
  };
  std::vector<std::vector<Seen>> before(blocks.bodies.size()), after(blocks.bodies.size());
  for (const Flight& flight : flights) {
    Eigen::VectorXd residuals(flight.cost->num_residuals());
    const MatrixX jacobian = TangentJacobian(scene, flight, blocks, jacobian_by, residuals);
    if (!residuals.allFinite() || !jacobian.allFinite()) {
      throw std::runtime_error("no usable solution: it leads beyond all numbers");
    }
    chi2 += residuals.squaredNorm();
    int row = 0;
    for (const FlightPose& pose : flight.poses) {
      const int count = flight.Rows(scene, pose);
      if (!with_jacobian) Accumulate(jacobian.middleRows(row, 3), position);
      Seen seen{};
      for (int i = 0; i < 3; ++i) {
        seen.residual.position_m[i] = residuals[row + i] * pose.position_std_m;
      }
      if (count == 6) {
        if (!with_jacobian) Accumulate(jacobian.middleRows(row + 3, 3), orientation);
        for (int i = 0; i < 3; ++i) {
          seen.residual.turn_rad[i] = residuals[row + 3 + i] * pose.orientation_std_rad;
        }
      }
      if (with_jacobian) seen.rows = jacobian.middleRows(row, count);
      (flight.is_after ? after : before)[flight.body].push_back(std::move(seen));
      row += count;
    }
  }
  const auto push = [&](const Seen& seen) {
    solution.residuals.push_back(seen.residual);
    Copy(seen.rows, solution.jacobian);
  };
  for (std::size_t i = 0; i < blocks.bodies.size(); ++i) {
    // A flight before the collision is kept outwards from it: backwards in time.
    for (auto r = before[i].rbegin(); r != before[i].rend(); ++r) push(*r);
    for (const Seen& seen : after[i]) push(seen);
  }
  const MatrixX prior = Prior(scene, blocks, chi2);
  solution.cost = 0.5 * chi2;
  solution.size = static_cast<std::size_t>(blocks.size);
  Copy(position, solution.position_information);
  Copy(orientation, solution.orientation_information);
  Copy(prior, solution.prior_information);
}

}  // namespace smash
