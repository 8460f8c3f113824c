// How the editor of laws is laid out.

import { element } from '../element';
import type { Child } from '../element';
import { lawHelp } from './law_help';

export interface LawParts {
  text: HTMLElement;
  /** In a row below the text. */
  tools: Child[];
  /** Below them. */
  notes: HTMLElement[];
  verdict: HTMLElement;
}

export function lawLayout({ text, tools, notes, verdict }: LawParts): HTMLElement {
  return element(
    'section',
    { 'aria-label': 'A law of your own', class: 'law' },
    element('h2', {}, 'A law of your own'),
    element(
      'p',
      { class: 'hint' },
      'An effect that the catalogue lacks: a force, a torque or a measurement law, in a few lines. Units are checked while you type.',
    ),
    element(
      'div',
      { class: 'law-columns' },
      element('div', {}, text, element('div', { class: 'row' }, ...tools), ...notes),
      element('div', {}, verdict, lawHelp()),
    ),
  );
}
