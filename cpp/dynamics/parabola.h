// The path of a centre of mass in flight (SMASH eq. 5 to 7), in the gravity frame: y points along
// gravity. Lengths in m, the parabola's time in frames from the collision.
#pragma once

#include <cmath>

#include "dynamics/vector.h"

namespace smash {

// R = R_y(heading) R_x(tilt) R_y(azimuth) applied to v, the azimuth first: the only order in which
// all parabolas share the direction of gravity, R e_y.
template <typename T>
Vector3<T> RotateYXY(const T& azimuth, const T& tilt, const T& heading, const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  const auto about_y = [](const T& angle, const Vector3<T>& u) {
    const T c = cos(angle), s = sin(angle);
    return Vector3<T>(c * u[0] + s * u[2], u[1], c * u[2] - s * u[0]);
  };
  const Vector3<T> turned = about_y(azimuth, v);
  const T c = cos(tilt), s = sin(tilt);
  const Vector3<T> tilted(turned[0], c * turned[1] - s * turned[2], s * turned[1] + c * turned[2]);
  return about_y(heading, tilted);
}

// The unknowns of one flight, as one parameter block: {b2, b3, beta_y0}.
inline constexpr int kFlightSize = 3;
// The angles that all flights share, as one parameter block: {beta_x, beta_y1}.
inline constexpr int kTiltSize = 2;

// p(t) of eq. 5: `b1` in m/frame^2, `frames` since the collision, `b4` the position there.
template <typename T>
Vector3<T> ParabolaPosition(const T* flight, const T* tilt, const Vector3<T>& b4, double b1,
                            double frames) {
  const T along = flight[1] * frames;
  const T down = T(0.5 * b1 * frames * frames) + flight[0] * frames;
  return RotateYXY(flight[2], tilt[0], tilt[1], Vector3<T>(along, down, T(0))) + b4;
}

// v(t_c) = fps R (b3, b2, 0) in m/s: the derivative of eq. 5 at the collision, with the order of
// eq. 5 (eq. 7 swaps the two).
template <typename T>
Vector3<T> CollisionVelocity(const T* flight, const T* tilt, double frames_per_second) {
  return RotateYXY(flight[2], tilt[0], tilt[1],
                   Vector3<T>(flight[1] * frames_per_second, flight[0] * frames_per_second, T(0)));
}

}  // namespace smash
