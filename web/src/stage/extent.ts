// How large a scene is, and where its middle is.

import { Box3, Sphere, Vector3 } from 'three';
import type { Body, Model, Scene } from '../report';

/** The radius of the ball around a body's centre that holds it. */
export function reach(body: Body): number {
  return body.shape.type === 'sphere' ? body.shape.radius : Math.hypot(...body.shape.size) / 2;
}

/** A ball that holds all poses and the model's motion. */
export function extent(scene: Scene, model: Model | null): Sphere {
  const box = new Box3();
  for (const body of scene.bodies) {
    const motion = model?.motion?.bodies.find((moved) => moved.name === body.name);
    const tracks = motion ? [...motion.before.positions, ...motion.after.positions] : [];
    const margin = reach(body);
    for (const position of [...body.observations.map((pose) => pose.position), ...tracks]) {
      if (!position.every(Number.isFinite)) continue;
      box.union(
        new Box3().setFromCenterAndSize(new Vector3(...position), new Vector3().setScalar(2 * margin)),
      );
    }
  }
  if (box.isEmpty()) return new Sphere(new Vector3(), 1);
  const ball = box.getBoundingSphere(new Sphere());
  return new Sphere(ball.center, Math.max(ball.radius, 1e-6));
}
