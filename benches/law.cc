// What an interpreted law costs: a flight with quadratic drag as `effects/quadratic_drag.toml` has
// it, against the same flight with the drag written by hand. `scripts/bench-law` builds and runs
// it; quote the ratio, since times differ from machine to machine.

#include <ceres/dynamic_autodiff_cost_function.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "functors/effect_flight.h"

namespace {

using namespace smash;

constexpr int kPoses = 30;
constexpr int kStepsAPose = 4;
constexpr double kInterval_s = 0.05;
const Vector3<double> kInertia(0.01, 0.02, 0.03);
const Vector3<double> kGravity(0.0, -9.81, 0.0);

// -k * norm(v) * v, as the compiler of laws has it.
Law QuadraticDrag() {
  constexpr int kFirst = kInputs + 1;
  Law law{Hook::kAcceleration,
          kFirst + 6,
          kFirst + 3,
          {{Operation::kNegate, kFirst, kInputs, 0, 0.0},
           {Operation::kNorm, kFirst + 1, kInputVelocity, 0, 0.0},
           {Operation::kMultiply, kFirst + 2, kFirst, kFirst + 1, 0.0},
           {Operation::kScaleVector, kFirst + 3, kFirst + 2, kInputVelocity, 0.0}}};
  law.FindUsed();
  return law;
}

std::vector<FlightPose> Poses() {
  std::vector<FlightPose> poses;
  for (int i = 0; i < kPoses; ++i) {
    poses.push_back({kInterval_s * (i + 1), {0.1 * i, 1.0, 0.0}, 0.002, {1, 0, 0, 0}, 0.01, true});
  }
  return poses;
}

// The blocks of EffectFlight before the collision would be the same; these are after it, on body a.
struct HandWrittenFlight {
  std::vector<FlightPose> poses = Poses();
  Eigen::Matrix<double, 3, 2> across = Eigen::Matrix<double, 3, 2>::Identity();

  template <typename T>
  struct State {
    Vector3<T> p, v;
    Quaternion<T> q;
    Vector3<T> l;
  };

  template <typename T>
  static State<T> RateOf(const State<T>& at, const Vector3<T>& gravity, const T& k) {
    using std::sqrt;
    const T square = at.v.squaredNorm();
    const T speed = square > T(0) ? T(sqrt(square)) : T(0);
    const Vector3<T> omega =
        AngularVelocity(at.q, at.l, Vector3<T>(kInertia.cwiseInverse().cast<T>()));
    return {at.v, gravity - (k * speed) * at.v, T(0.5) * MultiplyPure(omega, at.q),
            Vector3<T>::Constant(T(0))};
  }

  template <typename T>
  static State<T> Moved(const State<T>& from, const State<T>& rate, const T& step_s) {
    return {from.p + step_s * rate.p, from.v + step_s * rate.v, from.q + step_s * rate.q,
            from.l + step_s * rate.l};
  }

  template <typename T>
  static void Step(State<T>& s, const Vector3<T>& gravity, const T& k, const T& step_s) {
    const T half_s = T(0.5) * step_s, sixth_s = step_s / T(6);
    const State<T> k1 = RateOf(s, gravity, k);
    const State<T> k2 = RateOf(Moved(s, k1, half_s), gravity, k);
    const State<T> k3 = RateOf(Moved(s, k2, half_s), gravity, k);
    const State<T> k4 = RateOf(Moved(s, k3, step_s), gravity, k);
    s.p += sixth_s * (k1.p + T(2) * (k2.p + k3.p) + k4.p);
    s.v += sixth_s * (k1.v + T(2) * (k2.v + k3.v) + k4.v);
    s.l += sixth_s * (k1.l + T(2) * (k2.l + k3.l) + k4.l);
    s.q += sixth_s * (k1.q + T(2) * (k2.q + k3.q) + k4.q);
    s.q /= T(s.q.norm());
  }

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    const T k = blocks[kContact + 1][0];
    Vector3<T> direction = kGravity.normalized().cast<T>();
    for (int i = 0; i < 2; ++i) direction += blocks[kTilt][i] * across.col(i).cast<T>();
    const Vector3<T> gravity = T(kGravity.norm()) * (direction / T(direction.norm()));
    State<T> s{AsVector3(blocks[kMotion]), AsVector3(blocks[kMotion] + 3),
               AsQuaternion(blocks[kOrientation]), AsVector3(blocks[kMotion] + 6)};
    const Vector3<T> kick = AsVector3(blocks[kImpulse]);
    Vector3<T> contact = Vector3<T>::Constant(T(0));
    for (int i = 0; i < 2; ++i) contact[i] = blocks[kContact][i];
    s.l += Vector3<T>(contact - s.p).cross(kick);
    s.v += kick;
    T time_s = blocks[kTime][0];
    for (const FlightPose& pose : poses) {
      const T step_s = (T(pose.time_s) - time_s) / T(kStepsAPose);
      for (int step = 0; step < kStepsAPose; ++step) Step(s, gravity, k, step_s);
      time_s = T(pose.time_s);
      Store((s.p - pose.position.cast<T>()) / T(pose.position_std_m), residuals);
      const Quaternion<T> inverse = Conjugate(pose.world_from_body).cast<T>();
      Store(LogRotation(Multiply(inverse, s.q)) / T(pose.orientation_std_rad), residuals + 3);
      residuals += 6;
    }
    return true;
  }
};

template <typename Functor>
struct Cost {
  explicit Cost(Functor* functor) : cost(functor) {
    for (const int size : {kMotionSize, 4, 1, 2, 3, 2, 1}) cost.AddParameterBlock(size);
    cost.SetNumResiduals(6 * kPoses);
  }

  // With all derivatives, in microseconds: the least of many, which nothing disturbed.
  double Microseconds(std::vector<double>& residuals) {
    std::vector<std::vector<double>> values = {{0, 1, 0, 2, 3, 1, 0.02, 0.03, -0.05},
                                               {1, 0, 0, 0},
                                               {0.0},
                                               {0.01, -0.02},
                                               {1, 2, -1},
                                               {0.1, 0.9},
                                               {0.2}};
    std::vector<double*> at, jacobians;
    std::vector<std::vector<double>> rows;
    for (auto& block : values) rows.emplace_back(6 * kPoses * block.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      at.push_back(values[i].data());
      jacobians.push_back(rows[i].data());
    }
    residuals.resize(6 * kPoses);
    double least = 1e9;
    for (int run = 0; run < 300; ++run) {
      const auto start = std::chrono::steady_clock::now();
      cost.Evaluate(at.data(), residuals.data(), jacobians.data());
      const std::chrono::duration<double, std::micro> taken =
          std::chrono::steady_clock::now() - start;
      least = std::min(least, taken.count());
    }
    return least;
  }

  ceres::DynamicAutoDiffCostFunction<Functor, 20> cost;
};

}  // namespace

int main() {
  const Surroundings around{-kGravity.normalized(),
                            kGravity,
                            {},
                            {},
                            {},
                            {Vector3<double>::UnitX(), Vector3<double>::UnitY()}};
  const EffectBody body{kInertia, true, true, {{QuadraticDrag(), 0, 0, 1, 1.0}}, 1, around, false};
  const HandWrittenFlight hand;
  const TiltedGravity gravity{kGravity.norm(), kGravity.normalized(), hand.across};
  ContactFrame frame;
  frame.impulse_basis = Eigen::Matrix3d::Identity();
  frame.contact_origin.setZero();
  frame.contact_basis = hand.across;
  Cost<EffectFlight> interpreted(
      new EffectFlight(body, true, gravity, frame, Poses(), std::vector<int>(kPoses, kStepsAPose)));
  Cost<HandWrittenFlight> by_hand(new HandWrittenFlight);
  std::vector<double> one, other;
  const double interpreted_us = interpreted.Microseconds(one);
  const double by_hand_us = by_hand.Microseconds(other);
  double apart = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    apart = std::max(apart, std::abs(one[i] - other[i]));
  }
  std::printf("interpreted %.0f us, by hand %.0f us: ratio %.2f (residuals differ by %.1e)\n",
              interpreted_us, by_hand_us, interpreted_us / by_hand_us, apart);
  return apart < 1e-6 ? 0 : 1;
}
