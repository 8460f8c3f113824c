// The pointer in a plot: it moves the moment; in the studio it marks poses, moves them in time and
// widens the noise's band, or a pose's own noise, too.

import type uPlot from 'uplot';
import type { Clock } from '../clock';
import { DEGREES, fixed, significant } from '../numbers';
import type { PlotData, PlotPoint } from './plot_data';
import type { PoseActs } from './pose_acts';

const REACH_PX = 12;
/** A pose is taken hold of by its mark alone where the band's edge is at hand, too. */
const MARK_PX = 5;
/** A hand that clicks slips by so much. */
const SLIP_PX = 4;

/** What is dragged, and how it is let go. */
interface Drag {
  words: string;
  drop: () => void;
}

/** A pose whose own noise is dragged, and what that was. */
interface Noisy {
  point: PlotPoint;
  before: number;
}

export class Pointer {
  private dragged: PlotPoint | Noisy | 'band' | null = null;
  private drag: Drag | null = null;
  private pressed = { x: 0, y: 0 };

  /** `tell` shows what a drag would do, or, with null, what is there. */
  constructor(
    private readonly plot: uPlot,
    private readonly clock: Clock,
    private readonly data: () => PlotData,
    private readonly acts: PoseActs | null,
    private readonly tell: (words: string | null) => void,
  ) {
    const { over } = plot;
    over.addEventListener('pointermove', (event) => this.move(event));
    if (acts === null) return;
    over.addEventListener('pointerdown', (event) => this.press(event));
    over.addEventListener('pointerup', () => this.release());
    over.addEventListener('pointercancel', () => this.cancel());
    over.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.cancel();
    });
  }

  private move(event: PointerEvent): void {
    const { x, y } = this.place(event);
    if (this.dragged !== null) return this.pull(x, y);
    this.clock.pause();
    this.clock.go(this.plot.posToVal(x, 'x'));
    this.plot.over.dataset.grip = this.grip(event, x, y);
  }

  /** What a press here would take hold of. */
  private grip(event: PointerEvent, x: number, y: number): string {
    const mode = this.modeOf(event);
    if (mode === 'noise') return this.isAtBand(y) || this.noisyAt(x, y) !== null ? 'noise' : '';
    return mode !== 'look' && this.pointAt(x, y) !== null ? mode : '';
  }

  /** Shift marks and Alt moves, whatever the mode. */
  private modeOf(event: PointerEvent): string {
    if (this.acts === null) return 'look';
    return event.shiftKey ? 'mark' : event.altKey ? 'time' : this.acts.mode;
  }

  private press(event: PointerEvent): void {
    const { acts, plot } = this;
    if (acts === null) return;
    const { x, y } = this.place(event);
    const mode = this.modeOf(event);
    const point = this.pointAt(x, y);
    if (mode === 'mark' && point !== null) {
      acts.mark(this.data().body, point.observation, !point.isMarked);
    } else if (mode === 'time' && point !== null) {
      this.dragged = point;
    } else if (mode === 'noise') {
      this.dragged = this.noisyAt(x, y) ?? (this.isAtBand(y) ? 'band' : null);
    }
    if (this.dragged === null) return;
    this.pressed = { x, y };
    event.preventDefault();
    plot.over.setPointerCapture(event.pointerId);
    plot.over.focus({ preventScroll: true });
  }

  private pull(x: number, y: number): void {
    if (this.acts === null || this.dragged === null) return;
    const { pressed } = this;
    if (this.drag === null && Math.hypot(x - pressed.x, y - pressed.y) < SLIP_PX) return;
    this.drag = this.dragTo(x, y, this.dragged, this.acts);
    this.tell(`${this.drag.words}; Esc leaves it`);
  }

  private dragTo(x: number, y: number, dragged: PlotPoint | Noisy | 'band', acts: PoseActs): Drag {
    const { plot } = this;
    const { body, channel, sigma, unit } = this.data();
    if (dragged === 'band') {
      const one = Math.abs(plot.posToVal(y, 'y')) / 2;
      const si = unit === '°' ? one / DEGREES : one / 1000;
      return {
        words: `noise, one σ: ${significant(one)} ${unit}`,
        drop: () => {
          if (one > 0) acts.noise(channel, si);
        },
      };
    }
    if ('before' in dragged) {
      const { point } = dragged;
      const reach = Math.abs(plot.posToVal(y, 'y') - point.value) / (2 * (sigma ?? 1));
      const [least, most] = acts.noiseScales;
      const scale = Number(Math.min(Math.max(reach, least), most).toPrecision(2));
      this.stretch(point, scale);
      return {
        words: `noise of pose ${point.observation} × ${significant(scale, 2)}`,
        drop: () => acts.poseNoise(body, point.observation, scale),
      };
    }
    const time = Number(plot.posToVal(x, 'x').toFixed(5));
    this.clock.go(time);
    return {
      words: `pose ${dragged.observation} from ${fixed(dragged.time, 4)} s to ${fixed(time, 4)} s`,
      drop: () => acts.move(body, dragged.observation, time),
    };
  }

  /** Draws a pose with another noise of its own. */
  private stretch(point: PlotPoint, scale: number): void {
    point.noiseScale = scale;
    this.plot.redraw(false);
  }

  private release(): void {
    const { drag } = this;
    this.cancel();
    drag?.drop();
  }

  private cancel(): void {
    const { dragged } = this;
    if (dragged !== null && dragged !== 'band' && 'before' in dragged)
      this.stretch(dragged.point, dragged.before);
    this.dragged = null;
    this.drag = null;
    this.tell(null);
  }

  private place(event: PointerEvent): { x: number; y: number } {
    const box = this.plot.over.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** The pose whose own noise a drag would change. */
  private noisyAt(x: number, y: number): Noisy | null {
    const point = this.pointAt(x, y, this.isAtBand(y) ? MARK_PX : REACH_PX);
    if (point === null || this.data().sigma === null) return null;
    return { point, before: point.noiseScale };
  }

  private pointAt(x: number, y: number, reach = REACH_PX): PlotPoint | null {
    const { plot } = this;
    let [best, least]: [PlotPoint | null, number] = [null, reach];
    for (const point of this.data().drawn) {
      const away = Math.hypot(plot.valToPos(point.time, 'x') - x, plot.valToPos(point.value, 'y') - y);
      if (away < least) [best, least] = [point, away];
    }
    return best;
  }

  private isAtBand(y: number): boolean {
    const { sigma } = this.data();
    return (
      sigma !== null &&
      [2, -2].some((times) => Math.abs(this.plot.valToPos(times * sigma, 'y') - y) < REACH_PX / 2)
    );
  }
}
