// A law of the user's own: typed, checked while one types, put into the model when it is good.

import { element, refill } from '../element';
import type { CheckedLaw, StudioState } from '../studio_state';
import { api } from './api';
import { DraftStore } from './draft';
import { ErrorLine } from './error_line';
import { LAW_EXAMPLE, lawHelp } from './law_help';
import { LawText } from './law_text';
import { mistakes } from './mistakes';
import type { Studio } from './studio';

const PAUSE_MS = 180;

export class LawEditor {
  readonly root: HTMLElement;
  private readonly text = new LawText(
    () => this.typed(),
    () => this.takeUp(),
  );
  private readonly verdict = element('div', {
    class: 'law-verdict',
    role: 'status',
    'data-testid': 'law-verdict',
  });
  private readonly place = element('select', { 'aria-label': 'Acts on', 'data-testid': 'law-place' });
  private readonly button: HTMLButtonElement;
  private readonly atOnce = element('input', { type: 'checkbox', 'data-testid': 'law-at-once' });
  private readonly line = new ErrorLine();
  private readonly store: DraftStore;
  private timer = 0;
  private checked: { text: string; law: CheckedLaw } | null = null;
  /** Typed here, and the server doesn't have it yet. Another text may be older than the server's. */
  private isUnsent = false;

  constructor(private readonly studio: Studio) {
    this.store = new DraftStore(`smash-law:${studio.state.value.report.scene.name}`);
    this.button = element(
      'button',
      {
        type: 'button',
        disabled: true,
        'data-testid': 'law-put-in',
        onclick: () => void this.putIn(),
      },
      'Put it in and fit',
    );
    this.root = element(
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
        element(
          'div',
          {},
          this.text.root,
          element(
            'div',
            { class: 'row' },
            this.button,
            this.place,
            element('label', {}, this.atOnce, 'as soon as it is good'),
            element(
              'button',
              { type: 'button', 'data-testid': 'law-example', onclick: () => this.edit(LAW_EXAMPLE) },
              'Start with an example',
            ),
          ),
          this.line.root,
        ),
        element('div', {}, this.verdict, lawHelp()),
      ),
    );
    this.restore(studio.state.value);
    studio.state.watch((state) => this.refresh(state));
    studio.connection.watch((connection) => {
      if (connection === 'there' && this.isUnsent) void this.check();
    });
  }

  /** Puts another text in its place. */
  edit(text: string): void {
    this.text.value = text;
    this.text.focus();
    this.typed();
  }

  /** What the server never got is worth more than what it has. */
  private restore(state: StudioState): void {
    const kept = this.store.read();
    this.isUnsent = kept !== null && !kept.isSent;
    if (kept !== null && this.isUnsent) this.text.value = kept.text;
    else this.show(state.draft);
  }

  /** Another browser may have typed; not while one types here. */
  private refresh(state: StudioState): void {
    const isOlder = state.revision < (this.checked?.law.revision ?? 0);
    if (this.isUnsent || isOlder || this.text.isFocused || state.draft === this.text.value) return;
    this.show(state.draft);
  }

  /** The server's text, which is checked when someone takes it up. */
  private show(draft: string): void {
    this.text.value = draft;
    this.checked = null;
    this.button.disabled = true;
    this.place.hidden = true;
    const isEmpty = draft.trim() === '';
    refill(
      this.verdict,
      element('p', { class: 'hint' }, isEmpty ? 'Nothing typed yet.' : 'Click into the law to check it.'),
    );
  }

  /** Only if it is what the server has, as far as is known. */
  private takeUp(): void {
    const isServers = this.text.value === this.studio.state.value.draft;
    if (this.checked === null && isServers && !this.isUnsent) void this.check();
  }

  private typed(): void {
    this.isUnsent = true;
    this.store.write({ text: this.text.value, isSent: false });
    this.button.disabled = true;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.check(), PAUSE_MS);
  }

  private async check(): Promise<void> {
    const text = this.text.value;
    try {
      const law = await api.law(text);
      // Overtaken by what was typed since.
      if (text !== this.text.value) return;
      const isNew = this.isUnsent && this.checked?.text !== text;
      this.isUnsent = false;
      this.store.write({ text, isSent: true });
      this.checked = { text, law };
      this.line.clear();
      this.tell(text, law);
      if (isNew && this.atOnce.checked && law.effect) await this.putIn();
    } catch (error) {
      this.line.tell(error);
      this.studio.heed(error);
    }
  }

  private tell(text: string, law: CheckedLaw): void {
    const isEmpty = text.trim() === '';
    const found = isEmpty ? [] : law.mistakes;
    this.text.mark(found);
    this.button.disabled = !law.effect;
    const chosen = this.place.value;
    const labels = law.effect?.labels ?? [];
    refill(
      this.place,
      ...labels.map((label) => element('option', { value: label, selected: label === chosen }, label)),
    );
    this.place.hidden = labels.length === 0;
    refill(
      this.verdict,
      isEmpty && element('p', { class: 'hint' }, 'Nothing typed yet.'),
      law.effect && element('p', { class: 'good-law' }, `Good: ${law.effect.title} (${law.effect.name}).`),
      ...mistakes(text, found),
    );
  }

  private async putIn(): Promise<void> {
    if (this.checked === null || this.checked.text !== this.text.value) return;
    await this.studio.act({ do: 'law', text: this.checked.text, effect: this.place.value }, this.line);
  }
}
