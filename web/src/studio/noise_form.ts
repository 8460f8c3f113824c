// The noise of all poses: what the band of a plot does by the mouse, by the keyboard.

import { element, refill } from '../element';
import { DEGREES } from '../numbers';
import type { Maybe } from '../numbers';
import type { StudioState } from '../studio_state';
import type { ErrorLine } from './error_line';
import type { Studio } from './studio';

export function noiseForm(studio: Studio, line: ErrorLine): HTMLElement {
  const root = element('div', { class: 'row' });
  studio.state.watch((state) => show(root, studio, line, state));
  return root;
}

function show(root: HTMLElement, studio: Studio, line: ErrorLine, state: StudioState): void {
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
      value: typeof value !== 'number' ? null : Number(value.toPrecision(3)),
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
  // What wasn't changed stays to the last digit.
  const read = (from: HTMLInputElement, known: Maybe<number>, unit: number): number =>
    from.value === from.defaultValue && typeof known === 'number' ? known : from.valueAsNumber / unit;
  const stateIt = (): void =>
    void studio.act(
      {
        do: 'noise',
        position: read(position, stated?.position, 1000),
        orientation: read(turn, stated?.orientation, DEGREES),
      },
      line,
    );
  const form = element(
    'form',
    {
      class: 'row',
      onsubmit: (event: SubmitEvent) => {
        event.preventDefault();
        stateIt();
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
          onclick: () => void studio.act({ do: 'noise' }, line),
        },
        'As in the scene',
      ),
    !stated &&
      element('span', { class: 'hint' }, 'The scene states none: it is estimated from the residuals.'),
  );
  refill(root, form);
}
