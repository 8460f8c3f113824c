// Everything that is drawn of one model of a scene, moved to any time.

import { Group, Mesh, MeshBasicMaterial, Sphere, SphereGeometry, Vector3 } from 'three';
import { singleOutliers } from '../outliers';
import type { Model, Scene } from '../report';
import { Arrow } from './arrow';
import { Differences } from './differences';
import { dispose } from './dispose';
import { reach } from './extent';
import { Floor } from './floor';
import type { Palette } from './palette';
import { Poses } from './poses';
import type { IsMarked } from './poses';
import { Solid } from './solid';
import { Trajectory } from './trajectory';

export const LAYERS = ['poses', 'model', 'paths', 'impulse', 'spins'] as const;
export type Layer = (typeof LAYERS)[number];

export interface Tag {
  text: string;
  at: () => Vector3;
  layer: Layer;
}

export class Collision extends Group {
  readonly floor: Floor;
  /** What is named in the picture, and where that is. */
  readonly tags: Tag[] = [];
  private readonly drawn: Record<Layer, Group>;
  private readonly poses: Poses[];
  private readonly solids: Solid[] = [];
  private differences: Differences[] = [];

  constructor(
    private readonly scene: Scene,
    private readonly model: Model | null,
    all: Sphere,
    private readonly colours: Palette,
    isMarked: IsMarked | null,
  ) {
    super();
    this.floor = new Floor(scene, all, colours);
    this.drawn = {
      poses: new Group(),
      model: new Group(),
      paths: new Group(),
      impulse: new Group(),
      spins: new Group(),
    };
    this.add(this.floor, ...Object.values(this.drawn));
    this.poses = scene.bodies.map(
      (body) => new Poses(body, model ? singleOutliers(model) : [], colours, isMarked),
    );
    this.drawn.poses.add(...this.poses);
    this.addMotion(all.radius);
    this.addImpulse(all.radius);
  }

  showAt(time: number): void {
    for (const moved of [...this.poses, ...this.solids]) moved.showAt(time);
  }

  show(layer: Layer, visible: boolean): void {
    this.drawn[layer].visible = visible;
  }

  isShown(layer: Layer): boolean {
    return this.drawn[layer].visible;
  }

  /** Draws what the model misses `times` as large; 0 hides it. */
  exaggerate(times: number): void {
    for (const old of this.differences) dispose(old);
    this.remove(...this.differences);
    this.differences = [];
    const motion = this.model?.motion;
    if (!motion || times === 0) return;
    for (const body of this.scene.bodies) {
      const moved = motion.bodies.find((one) => one.name === body.name);
      if (!moved) continue;
      this.differences.push(new Differences(body, moved, motion.collision_time, times, this.colours));
    }
    this.add(...this.differences);
  }

  /** Where the first body is now; null where the model has no motion. */
  get followed(): Vector3 | null {
    return this.solids[0]?.centre ?? null;
  }

  private addMotion(size: number): void {
    const motion = this.model?.motion;
    if (!motion) return;
    this.scene.bodies.forEach((body, index) => {
      const moved = motion.bodies.find((one) => one.name === body.name);
      if (!moved) return;
      const solid = new Solid(body, moved, motion.collision_time, this.colours.bodies[index % 2]);
      this.solids.push(solid);
      this.drawn.model.add(solid);
      this.drawn.spins.add(solid.spin);
      this.drawn.paths.add(new Trajectory(moved, this.colours, size));
      this.tags.push({ text: body.name, at: () => solid.centre, layer: 'model' });
    });
  }

  private addImpulse(size: number): void {
    const result = this.model?.result;
    if (!result) return;
    const smallest = Math.min(...this.scene.bodies.map(reach));
    const at = result.contact_point ?? result.bodies[0]?.position ?? null;
    if (at === null) return;
    const contact = new Vector3(...at);
    if (result.contact_point) this.drawn.impulse.add(dot(contact, 0.12 * smallest, this.colours.ink));
    const impulse = new Vector3(...result.impulse);
    if (!(impulse.length() > 0)) return;
    const length = Math.max(0.3 * size, 1.5 * smallest);
    const tip = impulse.normalize().multiplyScalar(length);
    const arrow = new Arrow(this.colours.ink, Math.min(0.014 * size, 0.3 * smallest));
    arrow.point(contact, tip);
    this.drawn.impulse.add(arrow);
    const end = contact.clone().add(tip);
    this.tags.push({ text: 'J', at: () => end, layer: 'impulse' });
  }
}

function dot(at: Vector3, radius: number, colour: string): Mesh {
  const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const made = new Mesh(new SphereGeometry(radius, 16, 12), material);
  made.position.copy(at);
  made.renderOrder = 4;
  return made;
}
