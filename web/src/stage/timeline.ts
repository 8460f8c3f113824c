// The slider of time, with marks where poses were measured, and the buttons beside it.

import type { Clock } from '../clock';
import { element } from '../element';
import { fixed, significant } from '../numbers';
import type { Scene } from '../report';
import { svg } from '../svg';

const STEPS = 1000;
const SPEEDS: [speed: number, words: string][] = [
  [1, 'real time'],
  [0.5, '2 × slower'],
  [0.25, '4 × slower'],
  [0.1, '10 × slower'],
  [0.03, '33 × slower'],
  [0.01, '100 × slower'],
];

export class Timeline {
  readonly root: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly marks = svg('svg', {
    class: 'timeline-marks',
    viewBox: `0 0 ${STEPS} 24`,
    preserveAspectRatio: 'none',
    'aria-hidden': 'true',
  });
  private readonly reading = element('output', { class: 'reading', 'data-testid': 'time' });
  private scene: Scene | null = null;

  constructor(private readonly clock: Clock) {
    this.slider = element('input', {
      type: 'range',
      min: 0,
      max: STEPS,
      step: 1,
      class: 'time-slider',
      'aria-label': 'Time',
      'data-testid': 'time-slider',
      oninput: () => {
        clock.pause();
        clock.go(clock.start + (this.slider.valueAsNumber / STEPS) * (clock.end - clock.start));
      },
    });
    this.root = element(
      'div',
      { class: 'timeline' },
      this.buttons(),
      element('div', { class: 'timeline-track' }, this.marks, this.slider),
      this.reading,
    );
    clock.time.watch(() => this.follow());
    clock.span.watch(() => this.follow());
  }

  show(scene: Scene): void {
    this.scene = scene;
    this.repaint();
  }

  repaint(): void {
    const { clock, scene } = this;
    const at = (time: number): number => ((time - clock.start) / (clock.end - clock.start || 1)) * STEPS;
    this.marks.replaceChildren();
    (scene?.bodies ?? []).forEach((body, row) => {
      const y = row === 0 ? 1 : 13;
      // Of a long film, where ticks lie on each other, one is enough.
      let last = -1;
      for (const pose of body.observations) {
        const x = at(pose.time);
        if (x - last < 0.25) continue;
        last = x;
        const side = clock.impact === null || pose.time <= clock.impact ? 'before' : 'after';
        this.marks.append(svg('line', { x1: x, x2: x, y1: y, y2: y + 10, class: `tick ${side}` }));
      }
    });
    if (clock.impact === null) return;
    const x = at(clock.impact);
    this.marks.append(svg('line', { x1: x, x2: x, y1: 0, y2: 24, class: 'tick impact' }));
  }

  private buttons(): HTMLElement {
    const { clock } = this;
    const button = (test: string, words: string, title: string, act: () => void): HTMLButtonElement =>
      element(
        'button',
        { type: 'button', 'data-testid': test, title, 'aria-label': title, onclick: act },
        words,
      );
    const play = button('play', '▶ Play', 'Play (space)', () => clock.toggle());
    clock.playing.watch((playing) => {
      play.textContent = playing ? '❚❚ Pause' : '▶ Play';
      play.setAttribute('aria-pressed', String(playing));
    });
    const speed = element(
      'select',
      {
        'aria-label': 'Speed',
        'data-testid': 'speed',
        onchange: () => clock.speed.set(Number(speed.value)),
      },
      ...SPEEDS.map(([value, words]) =>
        element('option', { value, selected: value === clock.speed.value }, words),
      ),
    );
    return element(
      'div',
      { class: 'row' },
      play,
      speed,
      button('step-back', '◂ pose', 'Previous pose (,)', () => clock.step(-1)),
      button('impact', '✱ Impact', 'To the impact (i)', () => clock.goToImpact()),
      button('step-on', 'pose ▸', 'Next pose (.)', () => clock.step(1)),
    );
  }

  private follow(): void {
    const { clock } = this;
    const time = clock.time.value;
    const span = clock.end - clock.start || 1;
    this.slider.valueAsNumber = Math.round(((time - clock.start) / span) * STEPS);
    const since = clock.impact === null ? null : time - clock.impact;
    const words = `${fixed(time, 4)} s` + (since === null ? '' : `, ${sinceImpact(since)}`);
    this.reading.textContent = words;
    this.slider.setAttribute('aria-valuetext', words);
  }
}

function sinceImpact(since: number): string {
  if (Math.abs(since) < 5e-5) return 'the impact';
  const size = significant(Math.abs(since) * 1000, 3);
  return since < 0 ? `${size} ms before the impact` : `${size} ms after the impact`;
}
