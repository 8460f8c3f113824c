#include <cmath>

#include "validate.h"

namespace smash {
namespace {

// A flight of more frames would take a number of Euler steps that no int holds.
constexpr double kLongestFlightFrames = 1e8;

void CheckBody(const PaperBody& body) {
  for (const double moment : body.inertia_per_mass) {
    if (!(moment > 0 && std::isfinite(moment))) Refuse("a moment of inertia isn't positive");
  }
  if (body.observations.empty()) Refuse("a body without observations");
  for (const PaperObservation& observation : body.observations) {
    if (!std::isfinite(observation.time_frames) || !AllFinite(observation.position) ||
        !AllFinite(observation.orientation)) {
      Refuse("an observation that isn't finite");
    }
  }
}

}  // namespace

void CheckDuration(double frames) {
  if (!(std::abs(frames) <= kLongestFlightFrames)) Refuse("a flight is too long or not finite");
}

void CheckPaperInput(const PaperScene& scene, double collision_frames,
                     const PaperUnknowns& unknowns) {
  if (scene.bodies.empty() || scene.bodies.size() > 2) Refuse("there must be one or two bodies");
  if (unknowns.bodies.size() != scene.bodies.size()) Refuse("unknowns and bodies differ in number");
  if (!(scene.frames_per_second > 0 && std::isfinite(scene.frames_per_second))) {
    Refuse("the frame rate isn't positive");
  }
  if (!(scene.gravity_m_s2 >= 0 && std::isfinite(scene.gravity_m_s2))) {
    Refuse("gravity is negative or not finite");
  }
  if (!std::isfinite(collision_frames) || !AllFinite(scene.plane_normal) ||
      !std::isfinite(scene.plane_height_m)) {
    Refuse("the collision time or the plane isn't finite");
  }
  for (const PaperBody& body : scene.bodies) {
    CheckBody(body);
    for (const PaperObservation& observation : body.observations) {
      CheckDuration(observation.time_frames - collision_frames);
    }
  }
  for (const PaperBodyUnknowns& body : unknowns.bodies) {
    if (!IsUnit(body.orientation)) Refuse("a start orientation isn't a unit quaternion");
  }
  if (!(unknowns.mass_ratio >= kSmallestMassRatio && unknowns.mass_ratio <= kLargestMassRatio)) {
    Refuse("the start mass ratio is out of its bounds");
  }
}

}  // namespace smash
