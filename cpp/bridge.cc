#include "bridge.h"

#include <ceres/version.h>
#include <glog/logging.h>

#include <array>
#include <stdexcept>

#include "dynamics/parabola.h"
#include "dynamics/rotation.h"
#include "paper_problem.h"
#include "validate.h"

namespace smash {

PaperSolution solve_paper_phase(const PaperScene& scene, double collision_frames, PaperPhase phase,
                                const PaperUnknowns& start) {
  CheckPaperInput(scene, collision_frames, start);
  return SolvePaperPhase(scene, collision_frames, phase, start);
}

rust::Vec<PaperPose> predict_paper_poses(const PaperScene& scene, double collision_frames,
                                         const PaperUnknowns& unknowns, std::size_t body,
                                         rust::Slice<const double> times_frames) {
  CheckPaperInput(scene, collision_frames, unknowns);
  if (body >= scene.bodies.size()) throw std::invalid_argument("there is no such body");
  const double fps = scene.frames_per_second;
  const double mass = body == 0 ? 1.0 : unknowns.mass_ratio;
  const Vector3<double> inertia = mass * ToVector3(scene.bodies[body].inertia_per_mass);
  const PaperBodyUnknowns& unknown = unknowns.bodies[body];
  rust::Vec<PaperPose> poses;
  for (const double time : times_frames) {
    const double frames = time - collision_frames;
    CheckDuration(frames);
    const PaperFlight& flight = frames < 0 ? unknown.before : unknown.after;
    const Vector3<double> position =
        ParabolaPosition(flight.parabola.data(), unknowns.tilt.data(), ToVector3(unknown.position),
                         scene.gravity_m_s2 / (fps * fps), frames);
    const Quaternion<double> q =
        EulerRotation(ToQuaternion(unknown.orientation), ToVector3(flight.angular_momentum),
                      inertia, frames / fps, EulerSteps(frames));
    poses.push_back(PaperPose{{position[0], position[1], position[2]}, {q[0], q[1], q[2], q[3]}});
  }
  return poses;
}

PaperVelocities paper_collision_velocities(const PaperScene& scene, const PaperUnknowns& unknowns,
                                           std::size_t body) {
  CheckPaperInput(scene, 0.0, unknowns);
  if (body >= scene.bodies.size()) throw std::invalid_argument("there is no such body");
  const auto velocity = [&](const PaperFlight& flight) {
    const Vector3<double> v =
        CollisionVelocity(flight.parabola.data(), unknowns.tilt.data(), scene.frames_per_second);
    return std::array<double, 3>{v[0], v[1], v[2]};
  };
  const PaperBodyUnknowns& unknown = unknowns.bodies[body];
  return PaperVelocities{velocity(unknown.before), velocity(unknown.after)};
}

rust::String ceres_version() { return CERES_VERSION_STRING; }

void silence_ceres_log() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace smash
