// The effects that can be added with one click, and the user's own laws.

import { element, refill } from '../element';
import type { Child } from '../element';
import type { CatalogueEffect, OwnLaw, StudioState } from '../studio_state';
import { ErrorLine } from './error_line';
import type { Studio } from './studio';

type Addable = Pick<CatalogueEffect, 'name' | 'labels' | 'reason'>;

export class Catalogue {
  readonly root: HTMLElement;
  private readonly list = element('ul', { class: 'catalogue', 'data-testid': 'catalogue' });
  private readonly search: HTMLInputElement;
  private readonly line = new ErrorLine();
  /** The effects whose description is open. */
  private readonly open = new Set<string>();

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
      element('div', { class: 'row' }, element('h2', {}, 'Effects'), this.search),
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
      // What this scene can't show comes last.
      .sort((a, b) => Number(isOfUse(b, effects)) - Number(isOfUse(a, effects)))
      .map((effect) => this.effect(effect, effects));
    const none =
      own.length + known.length === 0 &&
      element('li', { class: 'hint' }, 'No effect says that. Write a law of your own below.');
    refill(this.list, ...own, ...known, none);
  }

  private effect(effect: CatalogueEffect, present: string[]): HTMLElement {
    const more = element(
      'details',
      {
        open: this.open.has(effect.name),
        ontoggle: () => {
          if (more.open) this.open.add(effect.name);
          else this.open.delete(effect.name);
        },
      },
      element('summary', { id: `about-${effect.name}` }, effect.title),
      element('div', { class: 'hint' }, element('code', {}, effect.name), ` ${effect.looks_like}`),
      effect.tell_apart !== '' && element('div', { class: 'hint' }, `To tell it apart: ${effect.tell_apart}`),
    );
    return element('li', {}, more, ...this.buttons(effect, present));
  }

  private law(law: OwnLaw, present: string[]): HTMLElement {
    return element(
      'li',
      {},
      element('strong', {}, law.name),
      element('span', { class: 'hint' }, 'your own'),
      ...this.buttons({ ...law, reason: null }, present),
      element('button', { type: 'button', onclick: () => this.edit(law.text) }, 'Edit'),
    );
  }

  /** To take out what is in the model, and to add what can be: what acts at one moment, more than once. */
  private buttons({ name, labels, reason }: Addable, present: string[]): Child[] {
    const own = new Set(present.filter((label) => isOf(name, label)));
    if (own.size + labels.length === 0)
      return [element('span', { class: 'hint' }, reason ?? 'this scene can’t show it')];
    return [
      ...[...own].map((label) => this.button('remove', label, `effect-${label}`)),
      ...labels.map((label) =>
        this.button('add', label, `${own.has(label) ? 'another' : 'effect'}-${label}`),
      ),
    ];
  }

  /** Of the same `id` whether it adds or takes out, so that the focus stays. */
  private button(act: 'add' | 'remove', effect: string, id: string): HTMLElement {
    const where = effect.includes('@') ? effect.slice(effect.indexOf('@') + 1) : 'all';
    const isIn = act === 'remove';
    return element(
      'button',
      {
        type: 'button',
        id,
        class: isIn ? 'is-in' : null,
        'data-testid': `${isIn ? 'drop' : 'add'}-${effect}`,
        'aria-label': isIn ? `Take ${effect} out` : `Add ${effect}`,
        onclick: () => void this.studio.act({ do: act, effect }, this.line),
      },
      isIn ? `− ${where}` : `+ ${where}`,
    );
  }
}

/** Whether a label is one of this effect's. */
function isOf(name: string, label: string): boolean {
  return label === name || label.startsWith(`${name}@`);
}

/** Whether it can be added to the model, or is in it. */
function isOfUse({ name, labels }: CatalogueEffect, present: string[]): boolean {
  return labels.length > 0 || present.some((label) => isOf(name, label));
}
