// Keys for the whole page, and the list of them.

import type { Clock } from './clock';
import { element } from './element';
import type { StageSection } from './stage/section';
import { VIEWS, VIEW_WORDS } from './stage/views';

const KEYS: [key: string, does: string][] = [
  ['space', 'play, pause'],
  ['i', 'to the impact'],
  [', and .', 'previous and next pose'],
  ['← and →', 'on the slider of time: a thousandth of the whole; on a plot: a pose'],
  ['arrows in 3D', 'shift the picture; with Shift turn it'],
  ['x', 'exaggerate the difference more'],
  ...VIEWS.map((view, index): [string, string] => [String(index + 1), VIEW_WORDS[view]]),
];
const LIST: [key: string, does: string] = ['?', 'this list'];

export class Keys {
  readonly dialog: HTMLDialogElement;
  readonly button: HTMLButtonElement;

  constructor(
    private readonly clock: Clock,
    private readonly stage: () => StageSection | null,
    further: [key: string, does: string][],
  ) {
    this.dialog = element(
      'dialog',
      { 'aria-label': 'Keys', 'data-testid': 'keys' },
      element('h2', {}, 'Keys'),
      element(
        'dl',
        { class: 'keys' },
        ...[...KEYS, ...further, LIST].flatMap(([key, does]) => [
          element('dt', {}, element('kbd', {}, key)),
          element('dd', {}, does),
        ]),
      ),
      element('form', { method: 'dialog' }, element('button', {}, 'Close')),
    );
    this.button = element(
      'button',
      {
        type: 'button',
        title: 'Keys (?)',
        'aria-label': 'Keys',
        'data-testid': 'show-keys',
        onclick: () => this.dialog.showModal(),
      },
      '?',
    );
    window.addEventListener('keydown', (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target as HTMLElement;
    if (this.dialog.open || isTyping(target)) return;
    const act = this.actOf(event.key, target);
    if (act === null) return;
    event.preventDefault();
    act();
  }

  private actOf(key: string, target: HTMLElement): (() => void) | null {
    // On buttons, boxes and lists the space bar has its own meaning.
    if (key === ' ')
      return target.closest('button, input[type=checkbox], input[type=radio], select, summary, a')
        ? null
        : () => this.clock.toggle();
    if (key === 'i') return () => this.clock.goToImpact();
    if (key === ',') return () => this.clock.step(-1);
    if (key === '.') return () => this.clock.step(1);
    if (key === 'x') return () => this.stage()?.exaggerateMore();
    if (key === '?') return () => this.dialog.showModal();
    const view = VIEWS[Number(key) - 1];
    return view === undefined || target.matches('select') ? null : () => this.stage()?.stage?.look(view);
  }
}

/** Whether keys write something there. */
export function isTyping(target: HTMLElement): boolean {
  return (
    target.matches('textarea, select, [contenteditable]') ||
    (target.matches('input') && !target.matches('[type=range], [type=checkbox], [type=radio]'))
  );
}
