// The measured poses as outlines: all of them faint, those of the moment strong.

import { Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { threeTurn } from '../motion';
import type { Body, Outlier } from '../report';
import { reach } from './extent';
import { outline } from './outline';
import type { Palette } from './palette';

/** More outlines are a grey mass, and slow. */
const MOST_OUTLINES = 300;

/** Of a body's poses one in so many is drawn. */
export function strideOf(body: Body): number {
  return Math.ceil(body.observations.length / MOST_OUTLINES);
}

/** Which poses the user left out of the fit. */
export type IsMarked = (body: string, observation: number) => boolean;

type Kind = 'ordinary' | 'off' | 'marked';

export class Poses extends Group {
  private readonly strong: LineMaterial;
  private readonly materials: Record<Kind, LineMaterial>;
  private readonly drawn: { time: number; kind: Kind; lines: LineSegments2 }[] = [];

  constructor(body: Body, outliers: Outlier[], colours: Palette, isMarked: IsMarked | null) {
    super();
    // Many poses overlap: the more there are, the fainter each.
    const count = body.observations.length;
    const opacity = Math.max(0.12, 0.5 - count / 100);
    const stride = strideOf(body);
    const dash = 0.12 * reach(body);
    this.strong = new LineMaterial({ color: colours.ink, linewidth: 2.2 });
    this.materials = {
      ordinary: new LineMaterial({ color: colours.ink, linewidth: 1, transparent: true, opacity }),
      off: new LineMaterial({ color: colours.alarm, linewidth: 2.6 }),
      marked: new LineMaterial({
        color: colours.alarm,
        linewidth: 1.6,
        dashed: true,
        dashSize: dash,
        gapSize: dash,
      }),
    };
    const off = new Set(outliers.filter((one) => one.body === body.name).map((one) => one.time));
    const geometry = outline(body.shape);
    for (const [index, pose] of body.observations.entries()) {
      const isOff = off.has(pose.time);
      const kind: Kind = isMarked?.(body.name, index) ? 'marked' : isOff ? 'off' : 'ordinary';
      const isExtra = kind !== 'ordinary' && this.drawn.length < 2 * MOST_OUTLINES;
      if (index % stride !== 0 && !isExtra) continue;
      const lines = new LineSegments2(geometry, this.materials[kind]);
      lines.computeLineDistances();
      lines.position.set(...pose.position);
      if (pose.orientation) lines.quaternion.copy(threeTurn(pose.orientation));
      this.drawn.push({ time: pose.time, kind, lines });
      this.add(lines);
    }
  }

  showAt(time: number): void {
    const nearest = this.drawn.reduce((least, pose) => Math.min(least, Math.abs(pose.time - time)), Infinity);
    for (const pose of this.drawn) {
      const isNear = Math.abs(pose.time - time) <= nearest;
      pose.lines.material = isNear && pose.kind === 'ordinary' ? this.strong : this.materials[pose.kind];
      pose.lines.renderOrder = isNear ? 2 : 1;
    }
  }
}
