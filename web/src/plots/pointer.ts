// The pointer in a plot: it moves the moment; in the studio it marks poses, moves them in time and
// widens the noise's band, too.

import type uPlot from 'uplot';
import type { Clock } from '../clock';
import { DEGREES, fixed, significant } from '../numbers';
import type { PlotData, PlotPoint } from './plot_data';
import type { PoseActs } from './pose_acts';

const REACH_PX = 12;

/** What is dragged, and how it is let go. */
interface Drag {
  words: string;
  drop: () => void;
}

export class Pointer {
  private dragged: PlotPoint | 'band' | null = null;
  private drag: Drag | null = null;

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
    if (mode === 'noise') return this.isAtBand(y) ? 'noise' : '';
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
    } else if (mode === 'noise' && this.isAtBand(y)) {
      this.dragged = 'band';
    }
    if (this.dragged === null) return;
    event.preventDefault();
    plot.over.setPointerCapture(event.pointerId);
    plot.over.focus({ preventScroll: true });
  }

  private pull(x: number, y: number): void {
    const { plot, dragged, acts } = this;
    const data = this.data();
    if (acts === null || dragged === null) return;
    if (dragged === 'band') {
      const sigma = Math.abs(plot.posToVal(y, 'y')) / 2;
      const si = data.unit === '°' ? sigma / DEGREES : sigma / 1000;
      this.drag = {
        words: `noise, one σ: ${significant(sigma)} ${data.unit}`,
        drop: () => {
          if (sigma > 0) acts.noise(data.channel, si);
        },
      };
    } else {
      const time = Number(plot.posToVal(x, 'x').toFixed(5));
      this.clock.go(time);
      this.drag = {
        words: `pose ${dragged.observation} from ${fixed(dragged.time, 4)} s to ${fixed(time, 4)} s`,
        drop: () => acts.move(data.body, dragged.observation, time),
      };
    }
    this.tell(`${this.drag.words}; Esc leaves it`);
  }

  private release(): void {
    const { drag } = this;
    this.cancel();
    drag?.drop();
  }

  private cancel(): void {
    this.dragged = null;
    this.drag = null;
    this.tell(null);
  }

  private place(event: PointerEvent): { x: number; y: number } {
    const box = this.plot.over.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private pointAt(x: number, y: number): PlotPoint | null {
    const { plot } = this;
    let [best, least]: [PlotPoint | null, number] = [null, REACH_PX];
    for (const point of this.data().points) {
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
