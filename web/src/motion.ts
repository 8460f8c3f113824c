// Where the model has a body, and how it moves there, at any time.

import { Quaternion as Turn } from 'three';
import type { BodyMotion, Quaternion, Track, Vector } from './report';

export interface State {
  position: Vector;
  orientation: Quaternion | null;
  velocity: Vector;
  spin: Vector | null;
}

/** Before and after meet at the collision; beyond the first and last pose a body stands still. */
export function stateAt(body: BodyMotion, collisionTime: number, time: number): State {
  const track = time < (body.after.times[0] ?? collisionTime) ? body.before : body.after;
  const later = track.times.findIndex((sample) => sample >= time);
  if (later === 0) return sample(track, 0);
  if (later < 0) return sample(track, track.times.length - 1);
  const [from, to] = [sample(track, later - 1), sample(track, later)];
  const span = track.times[later] - track.times[later - 1];
  const share = span > 0 ? (time - track.times[later - 1]) / span : 1;
  return {
    position: hermite(from, to, span, share),
    orientation: turned(from.orientation, to.orientation, share),
    velocity: mixed(from.velocity, to.velocity, share),
    spin: from.spin && to.spin ? mixed(from.spin, to.spin, share) : null,
  };
}

function sample(track: Track, index: number): State {
  return {
    position: track.positions[index],
    orientation: track.orientations?.[index] ?? null,
    velocity: track.velocities[index],
    spin: track.spins?.[index] ?? null,
  };
}

/** The cubic through both positions with both velocities. */
function hermite(from: State, to: State, span: number, s: number): Vector {
  const along = (i: number): number =>
    from.position[i] * (1 + 2 * s) * (1 - s) ** 2 +
    to.position[i] * s * s * (3 - 2 * s) +
    span * s * (1 - s) * (from.velocity[i] * (1 - s) - to.velocity[i] * s);
  return [along(0), along(1), along(2)];
}

function mixed(from: Vector, to: Vector, share: number): Vector {
  const along = (i: number): number => from[i] + share * (to[i] - from[i]);
  return [along(0), along(1), along(2)];
}

function turned(from: Quaternion | null, to: Quaternion | null, share: number): Quaternion | null {
  if (from === null || to === null) return from ?? to;
  const turn = threeTurn(from).slerp(threeTurn(to), share);
  return [turn.w, turn.x, turn.y, turn.z];
}

/** Files count w first, three.js counts it last. */
export function threeTurn([w, x, y, z]: Quaternion): Turn {
  return new Turn(x, y, z, w).normalize();
}
