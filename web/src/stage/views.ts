// Where the camera stands: by name, so far away that everything is seen.

import { PerspectiveCamera, Sphere, Vector3 } from 'three';
import type { Model, Scene } from '../report';

export const VIEWS = ['overview', 'front', 'side', 'top', 'impulse', 'impact', 'follow'] as const;
export type View = (typeof VIEWS)[number];

export const VIEW_WORDS: Record<View, string> = {
  overview: 'Overview',
  front: 'Front',
  side: 'Side',
  top: 'Top',
  impulse: 'Along the impulse',
  impact: 'Close to the impact',
  follow: 'Follow the first body',
};

/** The direction from the middle to the camera. */
export function direction(view: View, scene: Scene, model: Model | null): Vector3 {
  const up = new Vector3(...scene.up).normalize();
  const right = levelMotion(scene, model, up);
  const front = new Vector3().crossVectors(right, up).normalize();
  if (view === 'front') return front;
  if (view === 'side') return right;
  // A little aside: straight from above the camera wouldn't know which way is up.
  if (view === 'top') return up.addScaledVector(front, 1e-3).normalize();
  const impulse = new Vector3(...(model?.result.impulse ?? [0, 0, 0]));
  if (view === 'impulse' && impulse.length() > 0) {
    return impulse.normalize().negate().addScaledVector(front, 1e-3).normalize();
  }
  return front.addScaledVector(up, 0.38).addScaledVector(right, 0.3).normalize();
}

/** The level part of the motion: from left to right in the front view. */
function levelMotion(scene: Scene, model: Model | null, up: Vector3): Vector3 {
  const [first, second] = model?.result.bodies ?? [];
  const motion = new Vector3(...(first?.velocity_before ?? [0, 0, 0]));
  if (second) motion.sub(new Vector3(...second.velocity_before));
  motion.addScaledVector(up, -motion.dot(up));
  if (motion.length() > 1e-9) return motion.normalize();
  const world = Math.abs(scene.up[0]) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 0, 1);
  return world.addScaledVector(up, -world.dot(up)).normalize();
}

/** How far away `ball` just fits into the picture. */
export function distance(camera: PerspectiveCamera, ball: Sphere): number {
  const vertical = (camera.fov * Math.PI) / 360;
  const horizontal = Math.atan(Math.tan(vertical) * camera.aspect);
  return (0.98 * ball.radius) / Math.sin(Math.min(vertical, horizontal));
}
