// A body of the model: lit, moved along the reconstructed motion, with its spin as an arrow.

import {
  BoxGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  BufferGeometry,
  Float32BufferAttribute,
  Mesh,
  MeshStandardMaterial,
  SphereGeometry,
  Vector3,
} from 'three';
import { stateAt, threeTurn } from '../motion';
import type { Body, BodyMotion } from '../report';
import { Arrow } from './arrow';
import { reach } from './extent';
import { outlinePoints } from './outline';

export class Solid extends Group {
  readonly spin: Arrow;
  private readonly flesh = new Group();
  private readonly fastest: number;

  constructor(
    private readonly body: Body,
    private readonly motion: BodyMotion,
    private readonly collisionTime: number,
    colour: string,
  ) {
    super();
    const shape = body.shape;
    const geometry =
      shape.type === 'sphere' ? new SphereGeometry(shape.radius, 40, 24) : new BoxGeometry(...shape.size);
    const material = new MeshStandardMaterial({
      color: colour,
      roughness: 0.65,
      metalness: 0,
      // Outlines that lie on a face must not sink into it.
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.flesh.add(new Mesh(geometry, material));
    if (motion.before.orientations) this.flesh.add(seams(body));
    this.spin = new Arrow(colour, 0.08 * reach(body));
    const speeds = [...(motion.before.spins ?? []), ...(motion.after.spins ?? [])];
    this.fastest = Math.max(0, ...speeds.map((spin) => Math.hypot(...spin)));
    this.add(this.flesh);
  }

  /** Where its centre is now. */
  get centre(): Vector3 {
    return this.flesh.position;
  }

  showAt(time: number): void {
    const state = stateAt(this.motion, this.collisionTime, time);
    this.flesh.position.set(...state.position);
    if (state.orientation) this.flesh.quaternion.copy(threeTurn(state.orientation));
    // The fastest spin is two bodies long.
    const scale = this.fastest > 0 ? (2.2 * reach(this.body)) / this.fastest : 0;
    this.spin.point(this.flesh.position, new Vector3(...(state.spin ?? [0, 0, 0])).multiplyScalar(scale));
  }
}

/** Edges of the solid itself, so that one sees a ball turn. */
function seams(body: Body): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(outlinePoints(body.shape), 3));
  return new LineSegments(
    geometry,
    new LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.35 }),
  );
}
