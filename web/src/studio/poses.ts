// Poses, their times and the noise: what plots do by the mouse, by the keyboard.

import { element, refill } from '../element';
import type { Child } from '../element';
import { DEGREES, fixed, significant } from '../numbers';
import type { Maybe } from '../numbers';
import type { Body } from '../report';
import type { Action, StudioState } from '../studio_state';
import { table } from '../table';
import { ErrorLine } from './error_line';
import type { Studio } from './studio';

export class Poses {
  readonly root: HTMLElement;
  private readonly noise = element('div', { class: 'row' });
  private readonly lists = element('div');
  private readonly open = new Set<string>();

  constructor(
    private readonly studio: Studio,
    private readonly line: ErrorLine,
  ) {
    this.root = element(
      'section',
      { 'aria-label': 'Poses and noise', class: 'poses' },
      element('h2', {}, 'Poses and noise'),
      line.root,
      this.noise,
      this.lists,
    );
    studio.state.watch((state) => this.show(state));
  }

  private show(state: StudioState): void {
    this.showNoise(state);
    refill(this.lists, ...state.report.scene.bodies.map((body) => this.list(state, body)));
  }

  private showNoise(state: StudioState): void {
    const stated = state.edits.noise ?? state.report.scene.noise;
    const field = (id: string, value: Maybe<number>, words: string): HTMLInputElement =>
      element('input', {
        type: 'number',
        id,
        min: 0,
        step: 'any',
        'data-testid': id,
        'aria-label': words,
        class: 'short-field',
        value: typeof value !== 'number' ? null : Number(value.toPrecision(6)),
      });
    const position = field(
      'noise-position',
      stated && stated.position * 1000,
      'One σ of a position coordinate, mm',
    );
    const turn = field(
      'noise-orientation',
      stated && stated.orientation * DEGREES,
      'One σ of an orientation, degrees',
    );
    const state_it = (): void =>
      void this.studio.act(
        {
          do: 'noise',
          position: position.valueAsNumber / 1000,
          orientation: turn.valueAsNumber / DEGREES,
        },
        this.line,
      );
    const form = element(
      'form',
      {
        class: 'row',
        onsubmit: (event: SubmitEvent) => {
          event.preventDefault();
          state_it();
        },
      },
      'Noise, one σ: ',
      position,
      ' mm a coordinate, ',
      turn,
      ' ° an axis ',
      element('button', { id: 'noise-state', 'data-testid': 'noise-state' }, 'State it'),
      state.edits.noise !== null &&
        element(
          'button',
          {
            type: 'button',
            id: 'noise-reset',
            'data-testid': 'noise-reset',
            onclick: () => void this.studio.act({ do: 'noise' }, this.line),
          },
          'As in the scene',
        ),
      !stated &&
        element('span', { class: 'hint' }, 'The scene states none: it is estimated from the residuals.'),
    );
    refill(this.noise, form);
  }

  private list(state: StudioState, body: Body): HTMLElement {
    const marked = state.edits.marked.filter((pose) => pose.body === body.name).length;
    const moved = state.edits.times.filter((pose) => pose.body === body.name).length;
    const changes = [marked > 0 && `${marked} marked wrong`, moved > 0 && `${moved} at another time`]
      .filter(Boolean)
      .join(', ');
    const isOpen = this.open.has(body.name);
    const content = element('div', {}, isOpen && this.table(state, body));
    const details = element(
      'details',
      {
        open: isOpen,
        'data-testid': `poses-${body.name}`,
        ontoggle: () => {
          if (details.open === this.open.has(body.name)) return;
          if (details.open) this.open.add(body.name);
          else this.open.delete(body.name);
          // Of long films only what is looked at is made.
          refill(content, details.open && this.table(this.studio.state.value, body));
        },
      },
      element(
        'summary',
        {},
        `${body.name}: ${body.observations.length} poses${changes === '' ? '' : `, ${changes}`}`,
      ),
      content,
    );
    return details;
  }

  private table(state: StudioState, body: Body): HTMLElement {
    return table(
      `Poses of ${body.name}, counted from 0; a wrong one is left out of the fit`,
      [
        { head: 'pose' },
        { head: 'time, s' },
        { head: 'farthest off along an axis', isNumber: true },
        { head: 'wrong' },
      ],
      body.observations.map((_, index) => this.row(state, body, index)),
    );
  }

  private row(state: StudioState, body: Body, index: number): Child[] {
    const is = (pose: { body: string; observation: number }): boolean =>
      pose.body === body.name && pose.observation === index;
    const key = `${body.name}-${index}`;
    const time = element('input', {
      type: 'number',
      step: 'any',
      id: `time-${key}`,
      class: 'short-field',
      'data-testid': `time-${key}`,
      'aria-label': `Time of pose ${index} of ${body.name}, s`,
      value: fixed(body.observations[index].time, 6).replace('−', '-'),
      onchange: () =>
        void this.change(time, {
          do: 'time',
          body: body.name,
          observation: index,
          time: time.valueAsNumber,
        }),
    });
    const wrong = element('input', {
      type: 'checkbox',
      id: `wrong-${key}`,
      'data-testid': `wrong-${key}`,
      checked: state.edits.marked.some(is),
      'aria-label': `Pose ${index} of ${body.name} is wrong`,
      onchange: () =>
        void this.change(wrong, {
          do: 'mark',
          body: body.name,
          observation: index,
          wrong: wrong.checked,
        }),
    });
    const isMoved = state.edits.times.some(is);
    return [
      index,
      element('span', {}, time, isMoved && element('span', { class: 'hint' }, ' moved')),
      farthest(state, body.name, index),
      wrong,
    ];
  }

  /** After a refusal the field shows again what it was made with. */
  private async change(field: HTMLInputElement, action: Action): Promise<void> {
    if (await this.studio.act(action, this.line)) return;
    field.value = field.defaultValue;
    field.checked = field.defaultChecked;
  }
}

/** The largest of a pose's residuals, in σ where there is a noise. */
function farthest(state: StudioState, body: string, observation: number): string {
  const residuals = (state.report.models[0]?.series ?? [])
    .filter((series) => series.body === body && series.sigma)
    .flatMap((series) =>
      series.points
        .filter((point) => point.observation === observation)
        .map((point) => point.value / (series.sigma ?? 1)),
    );
  if (residuals.length === 0) return '–';
  return `${significant(Math.max(...residuals.map(Math.abs)), 2)} σ`;
}
