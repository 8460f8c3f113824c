// A law of the user's own: typed, checked while one types, put into the model when it is good.

import { element, refill } from '../element';
import type { CheckedLaw, StudioState } from '../studio_state';
import { api, ConnectionLost, isAway, Refusal } from './api';
import { DraftStore } from './draft';
import { DraftsAside } from './drafts_aside';
import { ErrorLine } from './error_line';
import { LAW_EXAMPLE } from './law_help';
import { lawLayout } from './law_layout';
import { LawPlace } from './law_place';
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
  private readonly place: LawPlace;
  private readonly button: HTMLButtonElement;
  private readonly atOnce = element('input', { type: 'checkbox', 'data-testid': 'law-at-once' });
  private readonly line = new ErrorLine();
  private readonly store: DraftStore;
  private readonly aside: DraftsAside;
  private timer = 0;
  private isChecking = false;
  /** Whether a check waits for the server. */
  private isDue = false;
  private checked: { text: string; law: CheckedLaw } | null = null;
  /** Typed here, and the server doesn't have it yet. Another text may be older than the server's. */
  private isUnsent = false;
  /** What the server had when it was heard of last: what is typed here takes the place of that only. */
  private base = '';
  private isKept = true;

  constructor(private readonly studio: Studio) {
    const { session, report } = studio.state.value;
    this.place = new LawPlace(report.scene.bodies.map((body) => body.name));
    this.store = new DraftStore(session);
    this.aside = new DraftsAside(this.store, ({ text }) => this.exchange(text));
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
    this.root = lawLayout({
      text: this.text.root,
      tools: [
        this.button,
        this.place.root,
        element('label', {}, this.atOnce, 'as soon as it is good'),
        element(
          'button',
          { type: 'button', 'data-testid': 'law-example', onclick: () => this.edit(LAW_EXAMPLE) },
          'Start with an example',
        ),
      ],
      notes: [this.line.root, this.aside.root],
      verdict: this.verdict,
    });
    this.restore(studio.state.value);
    studio.state.watch((state) => this.refresh(state));
    studio.connection.watch((connection) => {
      if (connection === 'there' && this.isDue) void this.check();
    });
  }

  /** Puts another text in its place. */
  edit(text: string): void {
    this.text.value = text;
    this.text.focus();
    this.typed();
  }

  /** Takes a draft from aside; what was there is put aside instead. */
  private exchange(text: string): void {
    this.putAside(this.text.value);
    this.edit(text);
  }

  private putAside(text: string): void {
    if (text.trim() === '') return this.store.sent(text);
    this.store.putAside({ text, base: this.base, time: Date.now() });
    this.aside.show();
  }

  /** What the server never got is sent, unless it has another one by now. */
  private restore(state: StudioState): void {
    const kept = this.store.unsent;
    if (kept === null) return this.show(state.draft);
    this.text.value = kept.text;
    this.base = kept.base;
    this.isUnsent = true;
    this.isDue = true;
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
    this.base = draft;
    this.checked = null;
    this.button.disabled = true;
    this.place.show(null);
    this.note(draft.trim() === '' ? 'Nothing typed yet.' : 'Click into the law to check it.');
  }

  /** Only if it is what the server has, as far as is known. */
  private takeUp(): void {
    const isServers = this.text.value === this.studio.state.value.draft;
    if (this.checked === null && isServers && !this.isUnsent) void this.check();
  }

  private typed(): void {
    this.isUnsent = true;
    this.isKept = this.store.keep({ text: this.text.value, base: this.base, time: Date.now() });
    this.button.disabled = true;
    this.checkSoon();
  }

  private checkSoon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.check(), PAUSE_MS);
  }

  /** One after the other: each is to take the place of the one before. */
  private async check(): Promise<void> {
    if (this.isChecking) return this.checkSoon();
    this.isChecking = true;
    const text = this.text.value;
    try {
      const law = await api.law(text, this.base);
      this.base = text;
      this.isDue = false;
      this.store.sent(text);
      this.line.clear();
      // Else it was overtaken by what was typed since.
      if (text === this.text.value) await this.take(text, law);
    } catch (error) {
      await this.failed(error);
    } finally {
      this.isChecking = false;
    }
  }

  private async take(text: string, law: CheckedLaw): Promise<void> {
    const isNew = this.isUnsent && this.checked?.text !== text;
    this.isUnsent = false;
    this.checked = { text, law };
    this.tell(text, law);
    if (isNew && this.atOnce.checked && law.effect) await this.putIn();
  }

  private async failed(error: unknown): Promise<void> {
    const isRefused = error instanceof Refusal;
    this.isDue = true;
    if (isRefused && error.place === 'instead_of') return this.giveWay();
    this.studio.heed(error);
    if (error instanceof ConnectionLost || (isRefused && isAway(error))) {
      this.text.mark([]);
      this.line.clear();
      const kept = this.isKept
        ? 'this browser keeps it until it does'
        : 'copy it, this browser keeps nothing';
      this.note(`Not checked: smash doesn’t answer here. What you type isn’t lost: ${kept}.`);
    } else {
      this.line.tell(error);
    }
  }

  /** Another one was typed elsewhere: that is shown, and what was typed here is put aside. */
  private async giveWay(): Promise<void> {
    if (!(await this.studio.look())) return;
    if (this.isUnsent) this.putAside(this.text.value);
    this.isUnsent = false;
    this.isDue = false;
    // Keys that are on their way would go into the other one.
    this.text.blur();
    this.show(this.studio.state.value.draft);
  }

  private note(words: string): void {
    refill(this.verdict, element('p', { class: 'hint' }, words));
  }

  private tell(text: string, law: CheckedLaw): void {
    const isEmpty = text.trim() === '';
    const found = isEmpty ? [] : law.mistakes;
    this.text.mark(found);
    this.button.disabled = !law.effect;
    this.place.show(law.effect?.labels ?? null);
    refill(
      this.verdict,
      isEmpty && element('p', { class: 'hint' }, 'Nothing typed yet.'),
      law.effect && element('p', { class: 'good-law' }, `Good: ${law.effect.title} (${law.effect.name}).`),
      ...mistakes(text, found),
    );
  }

  private async putIn(): Promise<void> {
    if (this.checked === null || this.checked.text !== this.text.value) return;
    await this.studio.act({ do: 'law', text: this.checked.text, effect: this.place.label }, this.line);
  }
}
