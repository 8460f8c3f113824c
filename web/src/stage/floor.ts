// A grid: on the static plane, or, without one, below everything to tell depths by.

import {
  BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  Quaternion,
  Sphere,
  Vector3,
} from 'three';
import type { Scene } from '../report';
import type { Palette } from './palette';

const SQUARES = 16;

export class Floor extends Group {
  /** The side of a square, m. */
  readonly square: number;

  constructor(scene: Scene, all: Sphere, colours: Palette) {
    super();
    this.square = roundLength((2.4 * all.radius) / SQUARES);
    const plane = scene.plane;
    const normal = new Vector3(...(plane?.normal ?? scene.up)).normalize();
    const height = plane ? plane.height : all.center.dot(normal) - all.radius;
    const middle = all.center.clone().addScaledVector(normal, height - all.center.dot(normal));
    this.position.copy(middle);
    this.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal));
    this.add(this.grid(colours));
    if (plane) this.add(this.sheet(colours));
  }

  private grid(colours: Palette): LineSegments {
    const half = (SQUARES / 2) * this.square;
    const points: number[] = [];
    for (let i = 0; i <= SQUARES; i += 1) {
      const at = i * this.square - half;
      points.push(at, -half, 0, at, half, 0, -half, at, 0, half, at, 0);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
    return new LineSegments(
      geometry,
      new LineBasicMaterial({ color: colours.faint, transparent: true, opacity: 0.35 }),
    );
  }

  private sheet(colours: Palette): Mesh {
    const side = SQUARES * this.square;
    const material = new MeshBasicMaterial({
      color: colours.faint,
      transparent: true,
      opacity: 0.1,
      side: DoubleSide,
      depthWrite: false,
    });
    return new Mesh(new PlaneGeometry(side, side), material);
  }
}

/** 1, 2 or 5 times a power of ten, the next above. */
function roundLength(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * ([1, 2, 5].find((step) => step * power >= length) ?? 10);
}
