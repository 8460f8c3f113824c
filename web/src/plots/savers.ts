// The buttons beside a plot that save it.

import { element } from '../element';

export interface Saver {
  format: 'SVG' | 'PNG';
  test: string;
  save: () => void;
}

export function savers(...all: Saver[]): HTMLElement {
  return element(
    'span',
    { class: 'savers' },
    ...all.map(({ format, test, save }) =>
      element(
        'button',
        {
          type: 'button',
          class: 'small',
          'data-testid': test,
          'aria-label': `Save this plot as ${format}`,
          onclick: save,
        },
        format,
      ),
    ),
  );
}
