// A body's edges: a box's twelve, a ball's three great circles.

import { BoxGeometry, EdgesGeometry } from 'three';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Shape } from '../report';

const CIRCLE_STEPS = 40;

/** End points of segments, x y z each. */
export function outlinePoints(shape: Shape): number[] {
  return shape.type === 'sphere' ? circles(shape.radius) : boxEdges(shape.size);
}

export function outline(shape: Shape): LineSegmentsGeometry {
  return new LineSegmentsGeometry().setPositions(outlinePoints(shape));
}

function boxEdges(size: [number, number, number]): number[] {
  return Array.from(new EdgesGeometry(new BoxGeometry(...size)).getAttribute('position').array);
}

function circles(radius: number): number[] {
  const points: number[] = [];
  for (let axis = 0; axis < 3; axis += 1) {
    for (let step = 0; step < CIRCLE_STEPS; step += 1) {
      for (const corner of [step, step + 1]) {
        const turn = (2 * Math.PI * corner) / CIRCLE_STEPS;
        const point = [0, 0, 0];
        point[(axis + 1) % 3] = radius * Math.cos(turn);
        point[(axis + 2) % 3] = radius * Math.sin(turn);
        points.push(...point);
      }
    }
  }
  return points;
}
