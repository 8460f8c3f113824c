#include "refined_blocks.h"

#include <algorithm>

namespace smash {
namespace {

// Two unit vectors across `direction`.
Eigen::Matrix<double, 3, 2> Across(const Vector3<double>& direction) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.normalized().cross(basis.col(0));
  return basis;
}

}  // namespace

// In the order that the bridge states.
RefinedBlocks::RefinedBlocks(const RefinedScene& scene, const RefinedProblem& problem)
    : contact(ContactFrameOf(scene, problem.start)), start_(problem.start) {
  const RefinedUnknowns& start = problem.start;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const RefinedMotion& m = start.bodies[i];
    std::vector<double> motion(m.position.begin(), m.position.end());
    motion.insert(motion.end(), m.velocity_before.begin(), m.velocity_before.end());
    motion.insert(motion.end(), m.spin_before.begin(), m.spin_before.end());
    BodyBlocks body;
    body.motion =
        Place(std::move(motion), scene.bodies[i].has_spin ? kMotionSize : kMotionSize - 3);
    body.orientation =
        Place({m.orientation.begin(), m.orientation.end()}, 3, scene.bodies[i].has_spin);
    bodies.push_back(std::move(body));
  }
  time = Place({start.collision_time_s}, 1, !problem.hold.collision_time);
  tilt = Place({start.tilt[0], start.tilt[1]}, 2, scene.gravity_m_s2 > 0);
  const Eigen::VectorXd j = contact.impulse_basis.transpose() * ToVector3(start.impulse);
  impulse = Place({j.data(), j.data() + j.size()}, static_cast<int>(j.size()));
  offset = Place({0.0, 0.0}, 2, AnySpin(scene));
  log_mass =
      Place({start.log_mass_ratio}, 1, scene.bodies.size() == 2 && !problem.hold.log_mass_ratio);
  for (std::size_t i = 0; i < start.parameters.size(); ++i) {
    parameters.push_back(Place({start.parameters[i]}, 1, !scene.parameters[i].held));
  }
}

Block RefinedBlocks::Place(std::vector<double> values, int tangent_size, bool is_free) {
  Block block{std::move(values), is_free ? size : -1, tangent_size};
  if (is_free) size += tangent_size;
  return block;
}

std::vector<Block*> RefinedBlocks::OfFlight(std::size_t body, bool is_after) {
  std::vector<Block*> blocks = {&bodies[body].motion, &bodies[body].orientation, &time, &tilt};
  if (!is_after) return blocks;
  blocks.insert(blocks.end(), {&impulse, &offset});
  if (body > 0) blocks.push_back(&log_mass);
  return blocks;
}

std::vector<Block*> RefinedBlocks::OfEffectFlight(std::size_t body, bool is_after,
                                                  const std::vector<std::size_t>& used) {
  std::vector<Block*> blocks = OfFlight(body, is_after);
  if (body > 0 && !is_after) blocks.push_back(&log_mass);
  for (const std::size_t parameter : used) blocks.push_back(&parameters[parameter]);
  return blocks;
}

std::vector<double*> ValuesOf(const std::vector<Block*>& blocks) {
  std::vector<double*> values;
  for (Block* block : blocks) values.push_back(block->values.data());
  return values;
}

bool RefinedBlocks::IsParameter(const Block& block) const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const Block& parameter) { return &parameter == &block; });
}

RefinedUnknowns RefinedBlocks::Unknowns() const {
  RefinedUnknowns unknowns = start_;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::vector<double>& motion = bodies[i].motion.values;
    RefinedMotion& m = unknowns.bodies[i];
    std::copy_n(motion.begin(), 3, m.position.begin());
    std::copy_n(motion.begin() + 3, 3, m.velocity_before.begin());
    std::copy_n(motion.begin() + 6, 3, m.spin_before.begin());
    std::copy_n(bodies[i].orientation.values.begin(), 4, m.orientation.begin());
  }
  unknowns.collision_time_s = time.values[0];
  std::copy_n(tilt.values.begin(), 2, unknowns.tilt.begin());
  const Eigen::Map<const Eigen::VectorXd> j(impulse.values.data(),
                                            static_cast<Eigen::Index>(impulse.values.size()));
  const Vector3<double> push = contact.impulse_basis * j;
  const Vector3<double> point =
      contact.contact_origin +
      contact.contact_basis * Eigen::Map<const Eigen::Vector2d>(offset.values.data());
  for (int i = 0; i < 3; ++i) {
    unknowns.impulse[i] = push[i];
    unknowns.contact_point[i] = point[i];
    unknowns.contact_basis[0][i] = contact.contact_basis(i, 0);
    unknowns.contact_basis[1][i] = contact.contact_basis(i, 1);
  }
  unknowns.log_mass_ratio = log_mass.values[0];
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    unknowns.parameters[i] = parameters[i].values[0];
  }
  return unknowns;
}

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

}  // namespace smash
