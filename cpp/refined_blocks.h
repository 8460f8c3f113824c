// The refined solver's unknowns as Ceres' parameter blocks.
#pragma once

#include <cstddef>
#include <vector>

#include "functors/flight.h"
#include "smash/src/bridge/refined.rs.h"

namespace smash {

// A parameter block: its numbers, and where its tangent stands in the information.
struct Block {
  std::vector<double> values;
  // -1: held, and no part of the information.
  int place = -1;
  int tangent_size = 0;
};

struct BodyBlocks {
  Block motion, orientation;
};

// All blocks, at the problem's start until a solver moves them.
struct RefinedBlocks {
  RefinedBlocks(const RefinedScene& scene, const RefinedProblem& problem);

  // Of a flight without effects, in the order of FlightBlock.
  std::vector<Block*> OfFlight(std::size_t body, bool is_after);
  // Of a flight with effects, whose parameters are these, in the order of EffectBlocks.
  std::vector<Block*> OfEffectFlight(std::size_t body, bool is_after,
                                     const std::vector<std::size_t>& used);
  // Whether a block is one of `parameters`.
  bool IsParameter(const Block& block) const;
  // What the numbers stand for.
  RefinedUnknowns Unknowns() const;

  ContactFrame contact;
  std::vector<BodyBlocks> bodies;
  Block time, tilt, impulse, offset, log_mass;
  // Of the effects, one for each scalar.
  std::vector<Block> parameters;
  // Of the information.
  int size = 0;

 private:
  Block Place(std::vector<double> values, int tangent_size, bool is_free = true);

  RefinedUnknowns start_;
};

// Where the blocks' numbers are.
std::vector<double*> ValuesOf(const std::vector<Block*>& blocks);

// The few numbers that stand for the impulse and the contact point, from where `unknowns` has them.
ContactFrame ContactFrameOf(const RefinedScene& scene, const RefinedUnknowns& unknowns);

inline bool AnySpin(const RefinedScene& scene) {
  for (const RefinedBody& body : scene.bodies) {
    if (body.has_spin) return true;
  }
  return false;
}

}  // namespace smash
