// The path of a body's centre: drawn through before the collision, dashed after it.

import { Group } from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import type { BodyMotion, Vector } from '../report';
import type { Palette } from './palette';

export class Trajectory extends Group {
  constructor(motion: BodyMotion, colours: Palette, size: number) {
    super();
    const before = new LineMaterial({ color: colours.before, linewidth: 2.5 });
    const after = new LineMaterial({
      color: colours.after,
      linewidth: 2.5,
      dashed: true,
      dashSize: 0.02 * size,
      gapSize: 0.012 * size,
    });
    this.add(line(motion.before.positions, before), line(motion.after.positions, after));
  }
}

export function line(points: Vector[], material: LineMaterial): Line2 {
  const made = new Line2(new LineGeometry().setPositions(points.flat()), material);
  // A path of one point has no length to dash.
  made.visible = points.length > 1;
  return made.computeLineDistances();
}
