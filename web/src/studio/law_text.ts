// A text field whose mistakes are underlined: a copy of the text, unseen but for its marks, lies
// behind it.

import { element } from '../element';
import type { Mistake } from '../studio_state';

export class LawText {
  readonly root: HTMLElement;
  private readonly field: HTMLTextAreaElement;
  private readonly copy = element('div', { class: 'law-copy', 'aria-hidden': 'true' });

  constructor(typed: () => void, takenUp: () => void) {
    this.field = element('textarea', {
      rows: 16,
      spellcheck: 'false',
      autocomplete: 'off',
      autocapitalize: 'off',
      wrap: 'off',
      'aria-label': 'The law, TOML',
      'data-testid': 'law-text',
      onfocus: takenUp,
      oninput: () => {
        this.mark([]);
        typed();
      },
      onscroll: () => {
        this.copy.scrollTop = this.field.scrollTop;
        this.copy.scrollLeft = this.field.scrollLeft;
      },
    });
    this.root = element('div', { class: 'law-text' }, this.copy, this.field);
  }

  get value(): string {
    return this.field.value;
  }

  set value(text: string) {
    if (text === this.field.value) return;
    this.field.value = text;
    this.mark([]);
  }

  get isFocused(): boolean {
    return document.activeElement === this.field;
  }

  focus(): void {
    this.field.focus();
  }

  blur(): void {
    this.field.blur();
  }

  mark(mistakes: Mistake[]): void {
    const parts: (Node | string)[] = [];
    this.field.value.split('\n').forEach((line, index) => {
      let done = 0;
      for (const mistake of mistakes.filter((one) => one.line === index + 1)) {
        const start = Math.min(Math.max(mistake.column - 1, done), line.length);
        const end = Math.min(start + Math.max(mistake.length, 1), line.length);
        // A mistake at the end of a line still gets a mark.
        parts.push(line.slice(done, start), element('mark', {}, line.slice(start, end) || ' '));
        done = end;
      }
      parts.push(`${line.slice(done)}\n`);
    });
    this.copy.replaceChildren(...parts);
    this.copy.scrollTop = this.field.scrollTop;
    this.field.setAttribute('aria-invalid', String(mistakes.length > 0));
  }
}
