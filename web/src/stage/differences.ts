// What the model misses: from each measured centre to where the model has it, as much exaggerated
// as one says, and a line through the ends, which shows the misses' shape.

import { Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { stateAt } from '../motion';
import type { Body, BodyMotion, Segment, Vector } from '../report';
import type { Palette } from './palette';
import { line } from './trajectory';

export class Differences extends Group {
  constructor(body: Body, motion: BodyMotion, collisionTime: number, times: number, colours: Palette) {
    super();
    const sticks: number[] = [];
    const ends: Record<Segment, Vector[]> = { before: [], after: [] };
    for (const pose of body.observations) {
      const model = stateAt(motion, collisionTime, pose.time).position;
      const along = (i: number): number => pose.position[i] + times * (model[i] - pose.position[i]);
      const end: Vector = [along(0), along(1), along(2)];
      sticks.push(...pose.position, ...end);
      ends[pose.time < collisionTime ? 'before' : 'after'].push(end);
    }
    if (sticks.length === 0) return;
    const material = (width: number): LineMaterial =>
      new LineMaterial({ color: colours.difference, linewidth: width, depthTest: false, transparent: true });
    this.add(new LineSegments2(new LineSegmentsGeometry().setPositions(sticks), material(2.5)));
    for (const side of [ends.before, ends.after]) this.add(line(side, material(1)));
    for (const child of this.children) child.renderOrder = 2;
  }
}
