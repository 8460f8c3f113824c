// The one moment that the 3D picture and the cursors of all plots show.

import { Signal } from './signal';

export class Clock {
  readonly time = new Signal(0);
  readonly playing = new Signal(false);
  /** Seconds of the scene in a second. */
  readonly speed = new Signal(0.25);
  /** Tells when `start`, `end`, `impact` or `poses` changed. */
  readonly span = new Signal(0);
  start = 0;
  end = 1;
  impact: number | null = null;
  /** Times at which any body was measured, ascending. */
  poses: number[] = [];

  private drawnAt = 0;

  cover(poses: number[], impact: number | null): void {
    // What shows the impact goes on doing so when that moves.
    const isAtImpact = this.poses.length === 0 || this.time.value === this.impact;
    this.poses = [...new Set(poses)].sort((a, b) => a - b);
    this.impact = impact;
    const [first, last] = [this.poses[0] ?? 0, this.poses.at(-1) ?? 1];
    this.start = Math.min(first, impact ?? first);
    this.end = Math.max(last, impact ?? last);
    if (this.poses.length === 0) [this.start, this.end] = [0, 1];
    this.span.set(this.span.value + 1);
    this.go(isAtImpact ? (impact ?? this.start) : this.time.value);
  }

  go(time: number): void {
    this.time.set(Math.min(Math.max(time, this.start), this.end));
  }

  /** To the next or previous time at which a body was measured. */
  step(direction: 1 | -1): void {
    this.pause();
    const here = this.time.value;
    const tiny = 1e-9 * (this.end - this.start);
    const next =
      direction > 0
        ? this.poses.find((time) => time > here + tiny)
        : this.poses.findLast((time) => time < here - tiny);
    if (next !== undefined) this.go(next);
  }

  goToImpact(): void {
    this.pause();
    if (this.impact !== null) this.go(this.impact);
  }

  pause(): void {
    this.playing.set(false);
  }

  toggle(): void {
    if (this.playing.value) return this.pause();
    if (this.time.value >= this.end) this.go(this.start);
    this.playing.set(true);
    this.drawnAt = performance.now();
    requestAnimationFrame(this.advance);
  }

  private readonly advance = (now: number): void => {
    if (!this.playing.value) return;
    const passed = Math.max(0, now - this.drawnAt) / 1000;
    this.drawnAt = now;
    this.go(this.time.value + passed * this.speed.value);
    if (this.time.value >= this.end) this.pause();
    else requestAnimationFrame(this.advance);
  };
}
