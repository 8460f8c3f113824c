// Laws that were typed here while another one was typed elsewhere: offered, until one takes or discards them.

import { element, refill } from '../element';
import type { Draft, DraftStore } from './draft';

export class DraftsAside {
  readonly root = element('div', { class: 'drafts-aside' });

  /** `take` puts a draft into the editor. */
  constructor(
    private readonly store: DraftStore,
    private readonly take: (draft: Draft) => void,
  ) {
    this.show();
  }

  show(): void {
    refill(this.root, ...this.store.aside.map((draft) => this.offer(draft)));
  }

  private offer(draft: Draft): HTMLElement {
    const act = (name: string, words: string, done: () => void): HTMLElement =>
      element(
        'button',
        {
          type: 'button',
          'data-testid': `draft-${name}`,
          onclick: () => {
            this.store.discard(draft);
            done();
            this.show();
          },
        },
        words,
      );
    return element(
      'div',
      { class: 'hint', 'data-testid': 'draft-aside' },
      element(
        'div',
        { class: 'row' },
        `Unsent draft from ${new Date(draft.time).toLocaleString()}; another one was typed since.`,
        act('take', 'Take it', () => this.take(draft)),
        act('discard', 'Discard it', () => {}),
      ),
      element('details', {}, element('summary', {}, 'What it says'), element('pre', {}, draft.text)),
    );
  }
}
