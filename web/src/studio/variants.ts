// The tree of models that were tried: click to go there, tick to see one beside the current one.

import { element, refill } from '../element';
import type { Child } from '../element';
import { angle, length, NONE, significant } from '../numbers';
import type { StudioState, Variant } from '../studio_state';
import { svg } from '../svg';
import { table } from '../table';
import { ErrorLine } from './error_line';
import type { Studio } from './studio';

export class Variants {
  readonly root: HTMLElement;
  private readonly content = element('div');
  private readonly line = new ErrorLine();
  private followed: number | null = null;

  constructor(private readonly studio: Studio) {
    this.root = element(
      'div',
      { class: 'variants-section' },
      element('h2', {}, 'Variants'),
      this.line.root,
      this.content,
    );
    studio.state.watch((state) => this.show(state));
  }

  private show(state: StudioState): void {
    const hasTurns = state.variants.some((variant) => variant.orientation_rmse !== null);
    const hasRatio = state.variants.some((variant) => variant.mass_ratio !== null);
    const largest = Math.max(...state.variants.map((variant) => variant.position_rmse), 1e-12);
    const rows = ordered(state.variants).map(({ variant, depth }): Child[] => [
      this.name(state, variant, depth),
      element(
        'span',
        { class: 'with-bar' },
        bar(variant.position_rmse / largest),
        length(variant.position_rmse),
      ),
      ...(hasTurns ? [variant.orientation_rmse === null ? NONE : angle(variant.orientation_rmse)] : []),
      significant(variant.reduced_chi2),
      ...(hasRatio ? [significant(variant.mass_ratio, 4)] : []),
      significant(variant.restitution, 4),
      this.comparison(state, variant),
    ]);
    refill(
      this.content,
      table(
        `Click one to go there; none is lost. Saved in ${state.session_file}`,
        [
          { head: 'what was done' },
          { head: 'positions', isNumber: true },
          ...(hasTurns ? [{ head: 'orientations', isNumber: true }] : []),
          { head: 'χ² / dof', isNumber: true },
          ...(hasRatio ? [{ head: 'mass ratio', isNumber: true }] : []),
          { head: 'restitution', isNumber: true },
          { head: 'beside' },
        ],
        rows,
        'variants',
      ),
    );
    this.follow(state);
  }

  /** Brings the current one into sight, once it is another. */
  private follow(state: StudioState): void {
    if (state.current === this.followed) return;
    this.followed = state.current;
    const row = this.content.querySelector<HTMLElement>('[aria-current]')?.closest('tr');
    const scroll = row?.closest('.scroll');
    if (!row || !scroll) return;
    const [inner, outer] = [row.getBoundingClientRect(), scroll.getBoundingClientRect()];
    if (inner.top < outer.top || inner.bottom > outer.bottom)
      scroll.scrollTop += inner.top - outer.top - (outer.height - inner.height) / 2;
  }

  private name(state: StudioState, variant: Variant, depth: number): HTMLElement {
    const isCurrent = variant.id === state.current;
    const button = element(
      'button',
      {
        type: 'button',
        class: 'variant',
        id: `variant-${variant.id}`,
        'data-testid': `variant-${variant.id}`,
        'aria-current': isCurrent ? 'true' : null,
        title: variant.effects.length === 0 ? 'base model' : `base + ${variant.effects.join(' + ')}`,
        onclick: () => void this.studio.act({ do: 'go', variant: variant.id }, this.line),
      },
      variant.did === '' ? 'base model' : variant.did,
    );
    button.style.marginLeft = `${depth * 16}px`;
    return button;
  }

  private comparison(state: StudioState, variant: Variant): Child {
    if (variant.id === state.current) return element('span', { class: 'hint' }, 'shown');
    const box = element('input', {
      type: 'checkbox',
      id: `beside-${variant.id}`,
      checked: state.compared.includes(variant.id),
      'data-testid': `compare-${variant.id}`,
      'aria-label': `Show “${variant.did}” beside the current one`,
      onchange: () => void this.act(box, variant),
    });
    return box;
  }

  private async act(box: HTMLInputElement, variant: Variant): Promise<void> {
    const isDone = await this.studio.act(
      { do: 'compare', variant: variant.id, shown: box.checked },
      this.line,
    );
    if (!isDone) box.checked = !box.checked;
  }
}

/** Children below their parents; only branches are indented, a chain stays straight. */
function ordered(variants: Variant[]): { variant: Variant; depth: number }[] {
  const rows: { variant: Variant; depth: number }[] = [];
  const childrenOf = (parent: number | null): Variant[] =>
    variants.filter((variant) => variant.parent === parent);
  const waiting = childrenOf(null)
    .map((variant) => ({ variant, depth: 0 }))
    .reverse();
  for (let next = waiting.pop(); next !== undefined; next = waiting.pop()) {
    rows.push(next);
    const children = childrenOf(next.variant.id);
    const depth = next.depth + (children.length > 1 ? 1 : 0);
    waiting.push(...children.map((variant) => ({ variant, depth })).reverse());
  }
  return rows;
}

function bar(share: number): SVGElement {
  return svg(
    'svg',
    { viewBox: '0 0 60 8', class: 'bar-mark', 'aria-hidden': 'true' },
    svg('rect', { x: 0, y: 0, width: Math.max(1, 60 * share), height: 8, fill: 'currentColor' }),
  );
}
