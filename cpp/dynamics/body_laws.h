// All laws that act on one body, with the numbers of their parameters.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/law.h"

namespace smash {

// A law on a body: its parameters are consecutive ones of the body's; -1 turns its sign about.
struct ActingOn {
  Law law;
  // Laws of one effect belong together.
  int effect;
  int first_parameter, parameters;
  double sign;
};

// What doesn't move.
struct Surroundings {
  Vector3<double> up, gravity, camera, normal, size;
  Vector3<double> across[2];
};

// A body in flight; l is its angular momentum per unit of its own mass.
template <typename T>
struct FlightState {
  Vector3<T> p, v;
  Quaternion<T> q;
  Vector3<T> l;
};

// The collision as a law sees it.
template <typename T>
struct Strike {
  // Of the contact, on this body, per unit mass of a.
  Vector3<T> impulse;
  // On the reference body.
  Vector3<T> impulse_on_a;
  Vector3<T> contact_point, normal;
};

template <typename T>
class BodyLaws {
 public:
  BodyLaws(const std::vector<ActingOn>& laws, const Surroundings& around, const T* parameters,
           const T& mass, const T& collision_time_s) {
    for (const ActingOn& acting : laws) {
      Acting run{LawRun<T>(acting.law), acting.sign, acting.effect};
      LawRun<T>& r = run.run;
      r.SetVector(kInputUp, around.up.cast<T>());
      r.SetVector(kInputGravity, around.gravity.cast<T>());
      r.SetVector(kInputCamera, around.camera.cast<T>());
      r.SetVector(kInputNormal, around.normal.cast<T>());
      r.SetVector(kInputSize, around.size.cast<T>());
      r.SetVector(kInputAcross1, around.across[0].cast<T>());
      r.SetVector(kInputAcross2, around.across[1].cast<T>());
      r.Set(kInputMass, mass);
      r.Set(kInputCollisionTime, collision_time_s);
      for (int i = 0; i < acting.parameters; ++i) {
        r.Set(kInputs + i, parameters[acting.first_parameter + i]);
      }
      runs_[static_cast<int>(acting.law.hook)].push_back(std::move(run));
    }
  }

  bool Has(Hook hook) const { return !runs_[static_cast<int>(hook)].empty(); }
  bool HasForces() const { return Has(Hook::kAcceleration) || Has(Hook::kTorque); }
  // Whether the rotation isn't free, or the path depends on it.
  bool CouplesRotation() const {
    if (Has(Hook::kTorque)) return true;
    for (const Acting& acting : runs_[static_cast<int>(Hook::kAcceleration)]) {
      const Law& law = acting.run.law();
      if (law.Uses(kInputOrientation, 4) || law.Uses(kInputOmega, 3) || law.Uses(kInputSpin, 3)) {
        return true;
      }
    }
    return false;
  }

  Vector3<T> Acceleration(const T& time_s, const FlightState<T>& state, const Vector3<T>& omega) {
    return Sum(Hook::kAcceleration, time_s, state, omega);
  }
  Vector3<T> Torque(const T& time_s, const FlightState<T>& state, const Vector3<T>& omega) {
    return Sum(Hook::kTorque, time_s, state, omega);
  }

  // The factors on the solid's principal moments.
  Vector3<T> InertiaFactor() {
    Vector3<T> factor = Vector3<T>::Constant(T(1));
    for (Acting& acting : Runs(Hook::kInertia)) {
      factor = factor.cwiseProduct(acting.run.Vector()).eval();
    }
    return factor;
  }

  // The time at which a pose with this stamp was seen.
  T Time(double stamp_s) {
    T time_s(stamp_s);
    for (Acting& acting : Runs(Hook::kTime)) {
      acting.run.Set(kInputTime, time_s);
      time_s = acting.run.Scalar();
    }
    return time_s;
  }

  // Where the centre is annotated.
  Vector3<T> Seen(double stamp_s, const FlightState<T>& state) {
    Vector3<T> seen = state.p;
    for (Acting& acting : Runs(Hook::kPosition)) {
      acting.run.Set(kInputTime, T(stamp_s));
      acting.run.SetVector(kInputPosition, seen);
      acting.run.SetQuaternion(kInputOrientation, state.q);
      seen = acting.run.Vector();
    }
    return seen;
  }

  // The rotation vector by which the annotation is turned off, in the body's frame.
  Vector3<T> Turn(double stamp_s, const FlightState<T>& state) {
    Vector3<T> turn = Vector3<T>::Constant(T(0));
    for (Acting& acting : Runs(Hook::kOrientation)) {
      acting.run.Set(kInputTime, T(stamp_s));
      acting.run.SetVector(kInputPosition, state.p);
      acting.run.SetQuaternion(kInputOrientation, state.q);
      turn += acting.run.Vector();
    }
    return turn;
  }

  // Adds the further impulses of the collision to a state just before it, whose angular velocity is
  // omega: those at a point belong to the contact, the others are a third party's.
  void Strike(const smash::Strike<T>& strike, const FlightState<T>& before, const Vector3<T>& omega,
              const T& mass, bool with_third_parties, FlightState<T>* after) {
    for (Acting& acting : Runs(Hook::kImpulse)) {
      Acting* point = Partner(Hook::kImpulsePoint, acting.effect);
      if (!point && !with_third_parties) continue;
      const Vector3<T> kick = Value(acting, strike, before, omega) / mass;
      after->v += kick;
      if (!point) continue;
      const Vector3<T> at = AtStrike(*point, strike, before, omega).run.Vector();
      after->l += Vector3<T>(at - before.p).cross(kick);
    }
    if (!with_third_parties) return;
    for (Acting& acting : Runs(Hook::kAngularImpulse)) {
      after->l += Value(acting, strike, before, omega) / mass;
    }
  }

  // The further impulses at times of their own.
  std::size_t Events() const { return runs_[static_cast<int>(Hook::kEventTime)].size(); }
  T EventTime(std::size_t event) { return Runs(Hook::kEventTime)[event].run.Scalar(); }
  // Adds `sign` times the event's impulses to a state whose angular velocity is omega.
  void AddEvent(std::size_t event, double sign, const Vector3<T>& omega, FlightState<T>* state) {
    const int effect = Runs(Hook::kEventTime)[event].effect;
    const FlightState<T> at = *state;
    if (Acting* kick = Partner(Hook::kEventImpulse, effect)) {
      Load(kick->run, at, omega);
      state->v += T(sign) * kick->run.Vector();
    }
    if (Acting* kick = Partner(Hook::kEventAngularImpulse, effect)) {
      Load(kick->run, at, omega);
      state->l += T(sign) * kick->run.Vector();
    }
  }

 private:
  struct Acting {
    LawRun<T> run;
    double sign;
    int effect;
  };

  // The law of the same effect for another hook, or none.
  Acting* Partner(Hook hook, int effect) {
    for (Acting& acting : Runs(hook)) {
      if (acting.effect == effect) return &acting;
    }
    return nullptr;
  }

  std::vector<Acting>& Runs(Hook hook) { return runs_[static_cast<int>(hook)]; }

  static void Load(LawRun<T>& run, const FlightState<T>& state, const Vector3<T>& omega) {
    run.SetVector(kInputPosition, state.p);
    run.SetVector(kInputVelocity, state.v);
    run.SetQuaternion(kInputOrientation, state.q);
    run.SetVector(kInputSpin, state.l);
    run.SetVector(kInputOmega, omega);
  }

  Vector3<T> Sum(Hook hook, const T& time_s, const FlightState<T>& state, const Vector3<T>& omega) {
    Vector3<T> sum = Vector3<T>::Constant(T(0));
    for (Acting& acting : Runs(hook)) {
      acting.run.Set(kInputTime, time_s);
      Load(acting.run, state, omega);
      sum += acting.run.Vector();
    }
    return sum;
  }

  Acting& AtStrike(Acting& acting, const smash::Strike<T>& strike, const FlightState<T>& before,
                   const Vector3<T>& omega) {
    Load(acting.run, before, omega);
    acting.run.SetVector(kInputImpulse, acting.sign < 0 ? strike.impulse_on_a : strike.impulse);
    acting.run.SetVector(kInputContact, strike.contact_point);
    acting.run.SetVector(kInputNormal, strike.normal);
    const Vector3<T> touching = before.v + omega.cross(Vector3<T>(strike.contact_point - before.p));
    acting.run.SetVector(kInputSlip,
                         Vector3<T>(touching - strike.normal * touching.dot(strike.normal)));
    return acting;
  }

  Vector3<T> Value(Acting& acting, const smash::Strike<T>& strike, const FlightState<T>& before,
                   const Vector3<T>& omega) {
    return T(acting.sign) * AtStrike(acting, strike, before, omega).run.Vector();
  }

  std::array<std::vector<Acting>, kHooks> runs_;
};

}  // namespace smash
