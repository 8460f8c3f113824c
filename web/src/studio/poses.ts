// Poses, their times and their own noise: what plots do by the mouse, by the keyboard.

import { element, refill } from '../element';
import type { Child } from '../element';
import { fixed, significant } from '../numbers';
import type { Body } from '../report';
import type { Action, StudioState } from '../studio_state';
import { table } from '../table';
import { ErrorLine } from './error_line';
import { noiseForm } from './noise_form';
import { factsOf, NO_FACTS } from './pose_facts';
import type { Facts } from './pose_facts';
import type { Studio } from './studio';
import { ANY, typed } from './typed';

/** More rows are slow, and nobody reads them. */
const MOST_ROWS = 200;

export class Poses {
  readonly root: HTMLElement;
  private readonly lists = element('div');
  private readonly open = new Set<string>();
  /** The first pose that is listed, by body. */
  private readonly first = new Map<string, number>();

  constructor(
    private readonly studio: Studio,
    private readonly line: ErrorLine,
  ) {
    this.root = element(
      'section',
      { 'aria-label': 'Poses and noise', class: 'poses' },
      element('h2', {}, 'Poses and noise'),
      line.root,
      noiseForm(studio, line),
      this.lists,
    );
    studio.state.watch((state) => this.show(state));
  }

  private show(state: StudioState): void {
    refill(this.lists, ...state.report.scene.bodies.map((body) => this.list(state, body)));
  }

  private list(state: StudioState, body: Body): HTMLElement {
    const marked = state.edits.marked.filter((pose) => pose.body === body.name).length;
    const moved = state.edits.times.filter((pose) => pose.body === body.name).length;
    const noisy = state.edits.noise_scales.filter((pose) => pose.body === body.name).length;
    const changes = [
      marked > 0 && `${marked} marked wrong`,
      moved > 0 && `${moved} at another time`,
      noisy > 0 && `${noisy} of another noise`,
    ]
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
    const count = body.observations.length;
    const first = Math.min(this.first.get(body.name) ?? 0, count - 1);
    const facts = factsOf(state, body.name);
    const rows: Child[][] = [];
    for (let index = first; index < Math.min(first + MOST_ROWS, count); index += 1)
      rows.push(this.row(state, body, index, facts.get(index)));
    const made = table(
      `Poses of ${body.name}, counted from 0; a wrong one is left out of the fit`,
      [
        { head: 'pose' },
        { head: 'time, s' },
        { head: 'farthest off along an axis', isNumber: true },
        { head: 'noise ×' },
        { head: 'wrong' },
      ],
      rows,
    );
    return element('div', {}, count > MOST_ROWS && this.pages(body, first), made);
  }

  /** Of long films so many poses at once. */
  private pages(body: Body, first: number): HTMLElement {
    const count = body.observations.length;
    const to = (start: number, words: string): HTMLElement =>
      element(
        'button',
        {
          type: 'button',
          id: `${words}-${body.name}`,
          'data-testid': `${words}-${body.name}`,
          disabled: start < 0 || start >= count,
          onclick: () => {
            this.first.set(body.name, start);
            this.show(this.studio.state.value);
          },
        },
        words,
      );
    const last = Math.min(first + MOST_ROWS, count) - 1;
    return element(
      'p',
      { class: 'row hint' },
      `Poses ${first} to ${last} of ${count}. `,
      to(first - MOST_ROWS, 'earlier'),
      to(first + MOST_ROWS, 'later'),
    );
  }

  private row(state: StudioState, body: Body, index: number, facts: Facts = NO_FACTS): Child[] {
    const is = (pose: { body: string; observation: number }): boolean =>
      pose.body === body.name && pose.observation === index;
    const key = `${body.name}-${index}`;
    const pose = { body: body.name, observation: index };
    const words = `pose ${index} of ${body.name}`;
    const time = element('input', {
      type: 'number',
      step: 'any',
      id: `time-${key}`,
      class: 'short-field',
      'data-testid': `time-${key}`,
      'aria-label': `Time of ${words}, s`,
      value: fixed(body.observations[index].time, 6).replace('−', '-'),
      onchange: () =>
        void this.change(time, () => ({
          do: 'time',
          ...pose,
          time: typed(time, {
            name: `Time of ${words}`,
            unit: 's',
            limits: ANY,
            mend: 'type a time in s, between those of its neighbours',
          }),
        })),
    });
    const wrong = element('input', {
      type: 'checkbox',
      id: `wrong-${key}`,
      'data-testid': `wrong-${key}`,
      checked: state.edits.marked.some(is),
      'aria-label': `Pose ${index} of ${body.name} is wrong`,
      onchange: () => void this.change(wrong, () => ({ do: 'mark', ...pose, wrong: wrong.checked })),
    });
    const scale = element('input', {
      type: 'number',
      step: 'any',
      id: `scale-${key}`,
      class: 'short-field',
      'data-testid': `scale-${key}`,
      'aria-label': `Noise of ${words}, times that of the others`,
      value: Number(facts.scale.toPrecision(6)),
      // Emptied, it is as noisy as the others.
      onchange: () =>
        void this.change(scale, () => ({
          do: 'pose_noise',
          ...pose,
          scale:
            scale.value === '' && !scale.validity.badInput
              ? 1
              : typed(scale, {
                  name: `Noise of ${words}`,
                  unit: 'times that of the others',
                  limits: state.limits.noise_scale,
                  mend: 'leave it empty for as noisy as the others',
                }),
        })),
    });
    const isMoved = state.edits.times.some(is);
    return [
      index,
      element('span', {}, time, isMoved && element('span', { class: 'hint' }, ' moved')),
      facts.farthest === null ? '–' : `${significant(facts.farthest, 2)} σ`,
      scale,
      wrong,
    ];
  }

  /** After a refusal the field shows again what it was made with. */
  private async change(field: HTMLInputElement, action: () => Action): Promise<void> {
    try {
      if (await this.studio.act(action(), this.line)) return;
    } catch (wrong) {
      this.line.tell(wrong);
    }
    field.value = field.defaultValue;
    field.checked = field.defaultChecked;
  }
}
