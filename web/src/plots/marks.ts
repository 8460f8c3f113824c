// Shapes of points: circles before the impact, triangles after it; told by shape as well as colour.

import type { Segment } from '../report';

export const RADIUS = 3.4;
/** Dashes of the lines of other models, which are told apart by them. */
export const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

/** Corners of a triangle around (x, y) that looks as large as a circle of `radius`. */
export function triangle(x: number, y: number, radius: number): [number, number][] {
  const r = 1.35 * radius;
  return [
    [x, y - r],
    [x + 0.87 * r, y + 0.5 * r],
    [x - 0.87 * r, y + 0.5 * r],
  ];
}

/** Adds the shape to the current path of a canvas. */
export function trace(
  context: CanvasRenderingContext2D,
  segment: Segment,
  x: number,
  y: number,
  radius: number,
): void {
  if (segment === 'before') {
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
    return;
  }
  const [first, ...others] = triangle(x, y, radius);
  context.moveTo(...first);
  for (const corner of others) context.lineTo(...corner);
  context.closePath();
}
