// The measured poses as outlines: all of them faint, those of the moment strong.

import { Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { threeTurn } from '../motion';
import type { Body, Outlier } from '../report';
import { outline } from './outline';
import type { Palette } from './palette';

/** More outlines are a grey mass, and slow. */
const MOST_OUTLINES = 300;

export class Poses extends Group {
  private readonly strong: LineMaterial;
  private readonly marked: LineMaterial;
  private readonly ordinary: LineMaterial;
  private readonly drawn: { time: number; isOff: boolean; lines: LineSegments2 }[] = [];

  constructor(body: Body, outliers: Outlier[], colours: Palette) {
    super();
    this.strong = new LineMaterial({ color: colours.ink, linewidth: 2.2 });
    this.marked = new LineMaterial({ color: colours.alarm, linewidth: 1.6 });
    // Many poses overlap: the more there are, the fainter each.
    const count = body.observations.length;
    const opacity = Math.max(0.12, 0.5 - count / 100);
    const stride = Math.ceil(count / MOST_OUTLINES);
    this.ordinary = new LineMaterial({ color: colours.ink, linewidth: 1, transparent: true, opacity });
    const geometry = outline(body.shape);
    for (const [index, pose] of body.observations.entries()) {
      const isOff = outliers.some((o) => o.body === body.name && Math.abs(o.time - pose.time) < 1e-9);
      if (index % stride !== 0 && !isOff) continue;
      const lines = new LineSegments2(geometry, isOff ? this.marked : this.ordinary);
      lines.position.set(...pose.position);
      if (pose.orientation) lines.quaternion.copy(threeTurn(pose.orientation));
      this.drawn.push({ time: pose.time, isOff, lines });
      this.add(lines);
    }
  }

  showAt(time: number): void {
    const nearest = this.drawn.reduce((least, pose) => Math.min(least, Math.abs(pose.time - time)), Infinity);
    for (const pose of this.drawn) {
      const isNear = Math.abs(pose.time - time) <= nearest;
      pose.lines.material = isNear ? this.strong : pose.isOff ? this.marked : this.ordinary;
      pose.lines.renderOrder = isNear ? 2 : 1;
    }
  }
}
