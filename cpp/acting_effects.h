// The laws of a scene's effects, body by body.
#pragma once

#include <cstddef>
#include <vector>

#include "functors/effect_flight.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

// What acts on one body.
struct ActingEffects {
  EffectBody body;
  // Which of all parameters its laws read, in the order that they know them by.
  std::vector<std::size_t> used_parameters;

  bool HasAny() const { return !body.laws.empty(); }
  // Whether any does more than strike at the collision.
  bool HasBeyondStrike() const;
};

// Of all bodies of a scene that has passed CheckRefinedProblem.
std::vector<ActingEffects> EffectBodies(const RefinedScene& scene);

TiltedGravity GravityOf(const RefinedScene& scene);

// The model's times of a body's poses: their stamps, or what effects make of them.
std::vector<double> PoseTimes(const RefinedScene& scene, const ActingEffects& effects,
                              std::size_t body, const RefinedUnknowns& unknowns);

// The bodies just after the collision.
std::vector<RefinedLaunch> Launches(const RefinedScene& scene, const RefinedUnknowns& unknowns);

// A body at poses with these stamps.
std::vector<FlownState> Flown(const RefinedScene& scene, const RefinedUnknowns& unknowns,
                              std::size_t body, rust::Slice<const double> stamps_s);

}  // namespace smash
