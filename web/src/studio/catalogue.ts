// The effects that can be added with one click, and the user's own laws.

import { element, refill } from '../element';
import type { Child } from '../element';
import type { CatalogueEffect, OwnLaw, StudioState } from '../studio_state';
import { ErrorLine } from './error_line';
import type { Studio } from './studio';

export class Catalogue {
  readonly root: HTMLElement;
  private readonly list = element('ul', { class: 'catalogue', 'data-testid': 'catalogue' });
  private readonly search: HTMLInputElement;
  private readonly line = new ErrorLine();

  /** `edit` puts a law's text into the editor. */
  constructor(
    private readonly studio: Studio,
    private readonly edit: (text: string) => void,
  ) {
    this.search = element('input', {
      type: 'search',
      placeholder: 'Search effects: drag, spin, camera …',
      'aria-label': 'Search effects',
      'data-testid': 'search-effects',
      oninput: () => this.show(studio.state.value),
    });
    this.root = element(
      'div',
      { class: 'catalogue-section' },
      element('h2', {}, 'Effects'),
      this.search,
      this.line.root,
      this.list,
    );
    studio.state.watch((state) => this.show(state));
  }

  private show(state: StudioState): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const fits = (texts: string[]): boolean => {
      const text = texts.join(' ').toLowerCase();
      return words.every((word) => text.includes(word));
    };
    const effects = state.variants.find((variant) => variant.id === state.current)?.effects ?? [];
    const own = state.laws
      .filter((law) => fits([law.name, 'own law', law.text]))
      .map((law) => this.law(law, effects));
    const known = state.catalogue
      .filter((effect) => fits([effect.name, effect.title, effect.looks_like, effect.tell_apart]))
      .map((effect) => this.effect(effect, effects));
    const none =
      own.length + known.length === 0 &&
      element('li', { class: 'hint' }, 'No effect says that. Write a law of your own below.');
    refill(this.list, ...own, ...known, none);
  }

  private effect(effect: CatalogueEffect, present: string[]): HTMLElement {
    return element(
      'li',
      {},
      element('div', { class: 'row' }, element('strong', {}, effect.title), ...this.buttons(effect, present)),
      element('div', { class: 'hint' }, element('code', {}, effect.name), ` ${effect.looks_like}`),
      effect.tell_apart !== '' && element('div', { class: 'hint' }, `To tell it apart: ${effect.tell_apart}`),
    );
  }

  private law(law: OwnLaw, present: string[]): HTMLElement {
    return element(
      'li',
      {},
      element(
        'div',
        { class: 'row' },
        element('strong', {}, law.name),
        element('span', { class: 'hint' }, 'your own'),
        ...this.buttons(law, present),
        element('button', { type: 'button', onclick: () => this.edit(law.text) }, 'Edit'),
      ),
    );
  }

  /** What is in the model may not be among what can be added. */
  private buttons({ name, labels }: { name: string; labels: string[] }, present: string[]): Child[] {
    const own = present.filter((label) => label === name || label.startsWith(`${name}@`));
    return [...new Set([...own, ...labels])].map((label) => this.toggle(label, present.includes(label)));
  }

  /** Adds what isn't in the model, takes out what is. */
  private toggle(label: string, isIn: boolean): HTMLElement {
    const where = label.includes('@') ? label.slice(label.indexOf('@') + 1) : 'all';
    return element(
      'button',
      {
        type: 'button',
        id: `effect-${label}`,
        'data-testid': `${isIn ? 'drop' : 'add'}-${label}`,
        'aria-pressed': String(isIn),
        'aria-label': isIn ? `Take ${label} out` : `Add ${label}`,
        onclick: () => void this.studio.act({ do: isIn ? 'remove' : 'add', effect: label }, this.line),
      },
      isIn ? `− ${where}` : `+ ${where}`,
    );
  }
}
