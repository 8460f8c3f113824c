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
#include "validate.h"

namespace smash {
namespace {

// Radians a step, at the body's fastest.
constexpr double kLargestStepRad = 0.12;

using MatrixX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A parameter block: where its numbers are, and where its tangent stands in the information.
struct Block {
  std::vector<double> values;
  // -1: held, and no part of the information.
  int place = -1;
  int tangent_size = 0;
};

class RefinedFit {
 public:
  RefinedFit(const RefinedScene& scene, const RefinedProblem& problem)
      : scene_(scene), problem_(problem), contact_(ContactFrameOf(scene, problem.start)) {
    FillBlocks();
    AddFlights();
    if (scene_.gravity_m_s2 > 0) {
      ceres_.AddResidualBlock(TiltPriorFunctor::Create(scene_.tilt_std_rad), nullptr,
                              tilt_.values.data());
    }
    if (any_spin()) AddContactPriors();
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
    solution.unknowns = Unknowns();
    solution.cost_initial = summary.initial_cost;
    solution.iterations = static_cast<std::uint32_t>(summary.iterations.size()) - 1;
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    Summarise(solution);
    return solution;
  }

  template <typename Visit>
  void VisitFlights(const Visit& visit) {
    for (const Flight& flight : flights_) {
      visit(*flight.cost, FlightValues(flight.body, flight.is_after));
    }
  }

 private:
  struct BodyBlocks {
    Block motion, orientation;
  };
  struct Flight {
    std::size_t body;
    bool is_after;
    FlightCost* cost;
  };

  bool has_spin(std::size_t body) const { return scene_.bodies[body].has_spin; }
  bool any_spin() const {
    return std::any_of(scene_.bodies.begin(), scene_.bodies.end(),
                       [](const RefinedBody& body) { return body.has_spin; });
  }

  Block Place(std::vector<double> values, int tangent_size, bool is_free = true) {
    Block block{std::move(values), is_free ? size_ : -1, tangent_size};
    if (is_free) size_ += tangent_size;
    return block;
  }

  // In the order that the bridge states.
  void FillBlocks() {
    const RefinedUnknowns& start = problem_.start;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const RefinedMotion& m = start.bodies[i];
      std::vector<double> motion(m.position.begin(), m.position.end());
      motion.insert(motion.end(), m.velocity_before.begin(), m.velocity_before.end());
      motion.insert(motion.end(), m.spin_before.begin(), m.spin_before.end());
      BodyBlocks body;
      body.motion = Place(std::move(motion), has_spin(i) ? kMotionSize : kMotionSize - 3);
      body.orientation = Place({m.orientation.begin(), m.orientation.end()}, 3, has_spin(i));
      bodies_.push_back(std::move(body));
    }
    time_ = Place({start.collision_time_s}, 1, !problem_.hold.collision_time);
    tilt_ = Place({start.tilt[0], start.tilt[1]}, 2, scene_.gravity_m_s2 > 0);
    const Eigen::VectorXd j = contact_.impulse_basis.transpose() * ToVector3(start.impulse);
    impulse_ = Place({j.data(), j.data() + j.size()}, static_cast<int>(j.size()));
    offset_ = Place({0.0, 0.0}, 2, any_spin());
    log_mass_ = Place({start.log_mass_ratio}, 1,
                      scene_.bodies.size() == 2 && !problem_.hold.log_mass_ratio);
  }

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
    const double step_s =
        LongestStep(inertia, ToQuaternion(problem_.start.bodies[index].orientation),
                    StartSpin(index, is_after));
    std::vector<int> pairs;
    double reached_s = is_after ? problem_.earliest_s : problem_.latest_s;
    for (const FlightPose& pose : poses) {
      pairs.push_back(FreeRotation::Pairs(pose.time_s - reached_s, step_s));
      reached_s = pose.time_s;
    }
    auto* cost = new FlightCost({inertia, body.has_spin, index == 0}, is_after, gravity, contact_,
                                std::move(poses), std::move(pairs));
    ceres_.AddResidualBlock(cost, nullptr, FlightValues(index, is_after));
    flights_.push_back({index, is_after, cost});
  }

  Vector3<double> StartSpin(std::size_t index, bool is_after) const {
    const RefinedMotion& motion = problem_.start.bodies[index];
    const Vector3<double> before = ToVector3(motion.spin_before);
    if (!is_after) return before;
    const double push = index == 0 ? 1.0 : -std::exp(-problem_.start.log_mass_ratio);
    const Vector3<double> lever = contact_.contact_origin - ToVector3(motion.position);
    return before + push * lever.cross(ToVector3(problem_.start.impulse));
  }

  // The blocks of a flight, in the order of FlightBlock.
  std::vector<Block*> FlightBlocks(std::size_t body, bool is_after) {
    std::vector<Block*> blocks = {&bodies_[body].motion, &bodies_[body].orientation, &time_,
                                  &tilt_};
    if (!is_after) return blocks;
    blocks.insert(blocks.end(), {&impulse_, &offset_});
    if (body > 0) blocks.push_back(&log_mass_);
    return blocks;
  }

  std::vector<double*> FlightValues(std::size_t body, bool is_after) {
    std::vector<double*> values;
    for (Block* block : FlightBlocks(body, is_after)) values.push_back(block->values.data());
    return values;
  }

  void AddContactPriors() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      ceres_.AddResidualBlock(ContactPriorFunctor::Create(contact_, ReachOf(i)), nullptr,
                              bodies_[i].motion.values.data(), offset_.values.data());
    }
  }

  double ReachOf(std::size_t body) const {
    return Reach(ToVector3(scene_.bodies[body].inertia_per_mass));
  }

  void AddRestitution() {
    const RestitutionPin& pin = problem_.restitution;
    RestitutionFunctor::Contact contact{contact_, ToVector3(scene_.plane_normal), {}};
    for (const RefinedBody& body : scene_.bodies) {
      contact.inertia_per_mass.push_back(ToVector3(body.inertia_per_mass));
      contact.has_spin.push_back(body.has_spin);
    }
    BodyBlocks& a = bodies_[0];
    auto* cost = RestitutionFunctor::Create(contact, pin.value, pin.weight);
    std::vector<double*> values = {a.motion.values.data(), a.orientation.values.data(),
                                   impulse_.values.data(), offset_.values.data()};
    if (bodies_.size() == 2) {
      BodyBlocks& b = bodies_[1];
      values.insert(values.end(),
                    {b.motion.values.data(), b.orientation.values.data(), log_mass_.values.data()});
    }
    ceres_.AddResidualBlock(cost, nullptr, values);
  }

  void HoldWhatIsKnown() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      double* q = bodies_[i].orientation.values.data();
      if (has_spin(i)) {
        ceres_.SetManifold(q, new ceres::QuaternionManifold);
        continue;
      }
      ceres_.SetManifold(bodies_[i].motion.values.data(),
                         new ceres::SubsetManifold(kMotionSize, {6, 7, 8}));
      ceres_.SetParameterBlockConstant(q);
    }
    for (Block* block : {&time_, &tilt_, &offset_, &log_mass_}) {
      double* values = block->values.data();
      if (block->place < 0 && ceres_.HasParameterBlock(values)) {
        ceres_.SetParameterBlockConstant(values);
      }
    }
    if (log_mass_.place >= 0 && ceres_.HasParameterBlock(log_mass_.values.data())) {
      ceres_.SetParameterLowerBound(log_mass_.values.data(), 0, -kLargestLogMassRatio);
      ceres_.SetParameterUpperBound(log_mass_.values.data(), 0, kLargestLogMassRatio);
    }
    if (time_.place < 0) return;
    ceres_.SetParameterLowerBound(time_.values.data(), 0, problem_.earliest_s);
    ceres_.SetParameterUpperBound(time_.values.data(), 0, problem_.latest_s);
  }

  RefinedUnknowns Unknowns() const {
    RefinedUnknowns unknowns = problem_.start;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const std::vector<double>& motion = bodies_[i].motion.values;
      RefinedMotion& m = unknowns.bodies[i];
      std::copy_n(motion.begin(), 3, m.position.begin());
      std::copy_n(motion.begin() + 3, 3, m.velocity_before.begin());
      std::copy_n(motion.begin() + 6, 3, m.spin_before.begin());
      std::copy_n(bodies_[i].orientation.values.begin(), 4, m.orientation.begin());
    }
    unknowns.collision_time_s = time_.values[0];
    std::copy_n(tilt_.values.begin(), 2, unknowns.tilt.begin());
    const Eigen::Map<const Eigen::VectorXd> j(impulse_.values.data(),
                                              static_cast<Eigen::Index>(impulse_.values.size()));
    const Vector3<double> impulse = contact_.impulse_basis * j;
    const Vector3<double> contact =
        contact_.contact_origin +
        contact_.contact_basis * Eigen::Map<const Eigen::Vector2d>(offset_.values.data());
    for (int i = 0; i < 3; ++i) {
      unknowns.impulse[i] = impulse[i];
      unknowns.contact_point[i] = contact[i];
      unknowns.contact_basis[0][i] = contact_.contact_basis(i, 0);
      unknowns.contact_basis[1][i] = contact_.contact_basis(i, 1);
    }
    unknowns.log_mass_ratio = log_mass_.values[0];
    return unknowns;
  }

  // Cost, residuals and information at the optimum, from one more evaluation of each flight.
  void Summarise(RefinedSolution& solution) {
    MatrixX position = MatrixX::Zero(size_, size_);
    MatrixX orientation = MatrixX::Zero(size_, size_);
    double chi2 = 0.0;
    std::vector<std::vector<RefinedResidual>> before(bodies_.size()), after(bodies_.size());
    for (const Flight& flight : flights_) {
      Eigen::VectorXd residuals(flight.cost->num_residuals());
      const MatrixX jacobian = TangentJacobian(flight, residuals);
      chi2 += residuals.squaredNorm();
      int row = 0;
      for (const FlightPose& pose : flight.cost->poses()) {
        Accumulate(jacobian.middleRows(row, 3), position);
        RefinedResidual residual{};
        for (int i = 0; i < 3; ++i)
          residual.position_m[i] = residuals[row + i] * pose.position_std_m;
        if (flight.cost->Rows(pose) == 6) {
          Accumulate(jacobian.middleRows(row + 3, 3), orientation);
          for (int i = 0; i < 3; ++i) {
            residual.turn_rad[i] = residuals[row + 3 + i] * pose.orientation_std_rad;
          }
        }
        (flight.is_after ? after : before)[flight.body].push_back(residual);
        row += flight.cost->Rows(pose);
      }
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      // A flight before the collision is kept outwards from it: backwards in time.
      for (auto r = before[i].rbegin(); r != before[i].rend(); ++r)
        solution.residuals.push_back(*r);
      for (const RefinedResidual& r : after[i]) solution.residuals.push_back(r);
    }
    const MatrixX prior = Prior(chi2);
    solution.cost = 0.5 * chi2;
    solution.size = static_cast<std::size_t>(size_);
    Copy(position, solution.position_information);
    Copy(orientation, solution.orientation_information);
    Copy(prior, solution.prior_information);
  }

  // What is known of the tilt beforehand. The contact point's prior is no knowledge: what it alone
  // determines is to be called undetermined.
  MatrixX Prior(double& chi2) const {
    MatrixX prior = MatrixX::Zero(size_, size_);
    if (tilt_.place >= 0) {
      const double weight = 1.0 / (scene_.tilt_std_rad * scene_.tilt_std_rad);
      const Eigen::Map<const Eigen::Vector2d> tilt(tilt_.values.data());
      chi2 += weight * tilt.squaredNorm();
      prior.block<2, 2>(tilt_.place, tilt_.place).diagonal().setConstant(weight);
    }
    return prior;
  }

  // The flight's derivatives by all unknowns, orientations as turns in the world.
  MatrixX TangentJacobian(const Flight& flight, Eigen::VectorXd& residuals) {
    const std::vector<Block*> blocks = FlightBlocks(flight.body, flight.is_after);
    const auto rows = residuals.size();
    std::vector<MatrixX> ambient;
    std::vector<double*> jacobians;
    for (const Block* block : blocks) {
      ambient.emplace_back(rows, static_cast<Eigen::Index>(block->values.size()));
    }
    for (MatrixX& matrix : ambient) jacobians.push_back(matrix.data());
    const std::vector<double*> values = FlightValues(flight.body, flight.is_after);
    if (!has_spin(flight.body)) jacobians[kOrientation] = nullptr;
    flight.cost->Evaluate(values.data(), residuals.data(), jacobians.data());
    MatrixX jacobian = MatrixX::Zero(rows, size_);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const Block& block = *blocks[i];
      if (block.place < 0) continue;
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

  template <typename Rows>
  static void Accumulate(const Rows& rows, MatrixX& information) {
    information.noalias() += rows.transpose() * rows;
  }

  static void Copy(const MatrixX& from, rust::Vec<double>& to) {
    to.reserve(static_cast<std::size_t>(from.size()));
    for (Eigen::Index i = 0; i < from.size(); ++i) to.push_back(from.data()[i]);
  }

  Eigen::Matrix<double, 3, 2> Across() const {
    Eigen::Matrix<double, 3, 2> across;
    across << ToVector3(scene_.across[0]), ToVector3(scene_.across[1]);
    return across;
  }

  const RefinedScene& scene_;
  const RefinedProblem& problem_;
  ContactFrame contact_;
  int size_ = 0;
  std::vector<BodyBlocks> bodies_;
  Block time_, tilt_, impulse_, offset_, log_mass_;
  std::vector<Flight> flights_;
  ceres::Problem ceres_;
};

// Two unit vectors across `direction`.
Eigen::Matrix<double, 3, 2> Across(const Vector3<double>& direction) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.normalized().cross(basis.col(0));
  return basis;
}

}  // namespace

ContactFrame ContactFrameOf(const RefinedScene& scene, const RefinedUnknowns& unknowns) {
  ContactFrame contact;
  const Vector3<double> normal = ToVector3(scene.plane_normal);
  contact.contact_origin = ToVector3(unknowns.contact_point);
  if (normal.norm() > 0) {
    contact.impulse_basis = normal;
    contact.contact_basis = Across(normal);
    return contact;
  }
  contact.impulse_basis = Matrix3::Identity();
  const Vector3<double> impulse = ToVector3(unknowns.impulse);
  // Without an impulse nothing depends on the contact point, and any basis will do.
  contact.contact_basis = Across(impulse.norm() > 0 ? impulse : Vector3<double>::UnitX());
  return contact;
}

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
  return RefinedFit(scene, problem).Solve();
}

void VisitFlights(
    const RefinedScene& scene, const RefinedProblem& problem,
    const std::function<void(const FlightCost&, const std::vector<double*>&)>& visit) {
  RefinedFit(scene, problem).VisitFlights(visit);
}

}  // namespace smash
