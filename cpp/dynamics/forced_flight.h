// A flight under any laws: gravity, accelerations, torques and further impulses, integrated by the
// classical Runge-Kutta method of order 4 on position, velocity, orientation and spin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "dynamics/body_laws.h"
#include "dynamics/free_turn.h"

namespace smash {

template <typename T>
class ForcedFlight {
 public:
  // From `start` at `start_s`, outwards: forwards in time after the collision, else backwards.
  // Without `turns` orientation and spin stay as they are. `laws` must outlive it.
  ForcedFlight(BodyLaws<T>& laws, const Vector3<T>& gravity, const Vector3<T>& inertia_per_mass,
               bool turns, bool is_after, const FlightState<T>& start, const T& start_s)
      : laws_(laws),
        gravity_(gravity),
        inertia_(inertia_per_mass),
        inverse_inertia_(inertia_per_mass.cwiseInverse()),
        turns_(turns),
        direction_(is_after ? 1.0 : -1.0),
        state_(start),
        time_s_(start_s) {
    for (std::size_t i = 0; i < laws.Events(); ++i) events_.push_back({i, laws.EventTime(i)});
    std::sort(events_.begin(), events_.end(), [this](const Event& a, const Event& b) {
      return (b.time_s - a.time_s) * T(direction_) > T(0);
    });
    // What happens on the collision's other side is the other flight's.
    while (next_ < events_.size() && !IsAhead(events_[next_].time_s)) ++next_;
  }

  const FlightState<T>& state() const { return state_; }
  Vector3<T> omega() const { return Omega(state_); }

  // On to `time_s` in `steps` steps, twice as many with an event between.
  void AdvanceTo(const T& time_s, int steps) {
    while (next_ < events_.size() && (time_s - events_[next_].time_s) * T(direction_) > T(0)) {
      const Event& event = events_[next_++];
      Integrate(event.time_s, steps);
      laws_.AddEvent(event.index, direction_, omega(), &state_);
    }
    Integrate(time_s, steps);
  }

 private:
  struct Event {
    std::size_t index;
    T time_s;
  };
  using Rate = FlightState<T>;

  bool IsAhead(const T& event_s) const {
    const T ahead_s = (event_s - time_s_) * T(direction_);
    return direction_ > 0 ? ahead_s >= T(0) : ahead_s > T(0);
  }

  Vector3<T> Omega(const FlightState<T>& state) const {
    if (!turns_) return Vector3<T>::Constant(T(0));
    return AngularVelocity(state.q, state.l, inverse_inertia_);
  }

  void Integrate(const T& time_s, int steps) {
    const T span_s = time_s - time_s_;
    const T step_s = span_s / T(steps);
    if (laws_.CouplesRotation()) {
      for (int step = 0; step < steps; ++step) Step(T(time_s_ + T(step) * step_s), step_s);
    } else {
      if (turns_) {
        state_.q = TurnFreely(state_.q, state_.l, inertia_, span_s, (steps + 1) / 2);
      }
      if (laws_.Has(Hook::kAcceleration)) {
        for (int step = 0; step < steps; ++step) StepPath(T(time_s_ + T(step) * step_s), step_s);
      } else {
        state_.p += span_s * (state_.v + (T(0.5) * span_s) * gravity_);
        state_.v += span_s * gravity_;
      }
    }
    time_s_ = time_s;
  }

  // Of the path alone, where no law looks at the rotation.
  void StepPath(const T& time_s, const T& step_s) {
    const T half_s = T(0.5) * step_s;
    const Vector3<T> omega = Vector3<T>::Constant(T(0));
    FlightState<T> at = state_;
    const auto rate = [&](const T& at_s, const Vector3<T>& p, const Vector3<T>& v) {
      at.p = p;
      at.v = v;
      return Vector3<T>(gravity_ + laws_.Acceleration(at_s, at, omega));
    };
    const Vector3<T> v1 = state_.v;
    const Vector3<T> a1 = rate(time_s, state_.p, v1);
    const Vector3<T> v2 = v1 + half_s * a1;
    const Vector3<T> a2 = rate(T(time_s + half_s), state_.p + half_s * v1, v2);
    const Vector3<T> v3 = v1 + half_s * a2;
    const Vector3<T> a3 = rate(T(time_s + half_s), state_.p + half_s * v2, v3);
    const Vector3<T> v4 = v1 + step_s * a3;
    const Vector3<T> a4 = rate(T(time_s + step_s), state_.p + step_s * v3, v4);
    const T sixth_s = step_s / T(6);
    state_.p += sixth_s * (v1 + T(2) * (v2 + v3) + v4);
    state_.v += sixth_s * (a1 + T(2) * (a2 + a3) + a4);
  }

  void Step(const T& time_s, const T& step_s) {
    const T half_s = T(0.5) * step_s;
    const Rate k1 = RateOf(time_s, state_);
    const Rate k2 = RateOf(T(time_s + half_s), Moved(state_, k1, half_s));
    const Rate k3 = RateOf(T(time_s + half_s), Moved(state_, k2, half_s));
    const Rate k4 = RateOf(T(time_s + step_s), Moved(state_, k3, step_s));
    const T sixth_s = step_s / T(6);
    state_.p += sixth_s * (k1.p + T(2) * (k2.p + k3.p) + k4.p);
    state_.v += sixth_s * (k1.v + T(2) * (k2.v + k3.v) + k4.v);
    if (!turns_) return;
    state_.l += sixth_s * (k1.l + T(2) * (k2.l + k3.l) + k4.l);
    state_.q += sixth_s * (k1.q + T(2) * (k2.q + k3.q) + k4.q);
    state_.q /= T(state_.q.norm());
  }

  FlightState<T> Moved(const FlightState<T>& from, const Rate& rate, const T& step_s) const {
    FlightState<T> to = from;
    to.p += step_s * rate.p;
    to.v += step_s * rate.v;
    if (!turns_) return to;
    to.q += step_s * rate.q;
    to.l += step_s * rate.l;
    return to;
  }

  Rate RateOf(const T& time_s, const FlightState<T>& state) const {
    const Vector3<T> omega = Omega(state);
    Rate rate;
    rate.p = state.v;
    rate.v = gravity_;
    if (laws_.Has(Hook::kAcceleration)) rate.v += laws_.Acceleration(time_s, state, omega);
    if (!turns_) return rate;
    rate.q = T(0.5) * MultiplyPure(omega, state.q);
    rate.l = laws_.Has(Hook::kTorque) ? laws_.Torque(time_s, state, omega)
                                      : Vector3<T>::Constant(T(0)).eval();
    return rate;
  }

  BodyLaws<T>& laws_;
  Vector3<T> gravity_, inertia_, inverse_inertia_;
  bool turns_;
  double direction_;
  FlightState<T> state_;
  T time_s_;
  std::vector<Event> events_;
  std::size_t next_ = 0;
};

}  // namespace smash
