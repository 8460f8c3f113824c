// The noise of all poses: what the band of a plot does by the mouse, by the keyboard.

import { element, refill } from '../element';
import { DEGREES } from '../numbers';
import type { Maybe } from '../numbers';
import type { StudioState } from '../studio_state';
import type { ErrorLine } from './error_line';
import type { Studio } from './studio';
import { typed } from './typed';

export function noiseForm(studio: Studio, line: ErrorLine): HTMLElement {
  const root = element('div', { class: 'row' });
  studio.state.watch((state) => show(root, studio, line, state));
  return root;
}

function show(root: HTMLElement, studio: Studio, line: ErrorLine, state: StudioState): void {
  const { edits, limits, report } = state;
  const stated = edits.noise ?? report.scene.noise;
  const hasTurns = report.scene.bodies.some((body) => body.observations.some((pose) => pose.orientation));
  const position = new Sigma('position', 'positions', 'mm', 1000, stated?.position, limits.noise);
  const turn = new Sigma('orientation', 'orientations', '°', DEGREES, stated?.orientation, limits.noise);
  const shown = hasTurns ? [position, turn] : [position];
  const stateIt = (): void => {
    const isEmpty = shown.every((sigma) => sigma.isEmpty);
    try {
      const numbers = isEmpty ? [] : shown.map((sigma) => [sigma.channel, sigma.read()]);
      void studio.act({ do: 'noise', ...Object.fromEntries(numbers) }, line);
    } catch (error) {
      line.tell(error);
    }
  };
  const form = element(
    'form',
    {
      class: 'row',
      // What is wrong is said beside the form, with the mend.
      novalidate: true,
      onsubmit: (event: SubmitEvent) => {
        event.preventDefault();
        stateIt();
      },
    },
    'Noise, one σ: ',
    position.field,
    ' mm a coordinate',
    ...(hasTurns ? [', ', turn.field, ' ° an axis '] : [' ']),
    element('button', { id: 'noise-state', 'data-testid': 'noise-state' }, 'State it'),
    edits.noise !== null &&
      element(
        'button',
        {
          type: 'button',
          id: 'noise-reset',
          'data-testid': 'noise-reset',
          onclick: () => void studio.act({ do: 'noise' }, line),
        },
        'As in the scene',
      ),
    !stated &&
      element('span', { class: 'hint' }, 'The scene states none: it is estimated from the residuals.'),
  );
  refill(root, form);
}

/** A field for one σ, in the unit that it is read in. */
class Sigma {
  readonly field: HTMLInputElement;

  constructor(
    readonly channel: 'position' | 'orientation',
    private readonly words: string,
    private readonly unit: string,
    /** How many of the unit are one of the SI. */
    private readonly scale: number,
    private readonly known: Maybe<number>,
    private readonly limits: [number, number],
  ) {
    this.field = element('input', {
      type: 'number',
      id: `noise-${channel}`,
      step: 'any',
      'data-testid': `noise-${channel}`,
      'aria-label': `Noise of ${words}, one σ, ${unit}`,
      class: 'short-field',
      value: typeof known === 'number' ? Number((known * scale).toPrecision(3)) : null,
    });
  }

  get isEmpty(): boolean {
    return this.field.value === '' && !this.field.validity.badInput;
  }

  /** In m or rad; what wasn't changed stays to the last digit. */
  read(): number {
    const { field, known, limits, scale, unit } = this;
    if (field.value === field.defaultValue && typeof known === 'number') return known;
    return (
      typed(field, {
        name: `Noise of ${this.words}`,
        unit,
        limits: [limits[0] * scale, limits[1] * scale],
        mend: `type one σ in ${unit === '°' ? 'degrees' : unit}, above 0; leave all empty for the scene’s own`,
      }) / scale
    );
  }
}
