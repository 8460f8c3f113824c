// Always in sight: the current model, how well it fits, undo and redo, files.

import { element, refill } from '../element';
import { UndoKeys } from './undo_keys';
import { angle, length, significant } from '../numbers';
import { saveBlob } from '../save';
import type { StudioState, Variant } from '../studio_state';
import { api } from './api';
import { ErrorLine } from './error_line';
import type { Studio } from './studio';

export class Bar {
  readonly root: HTMLElement;
  private readonly model = element('div', {
    class: 'row bar-model',
    role: 'group',
    'aria-label': 'The model',
    'data-testid': 'model',
  });
  private readonly error = element('div', { class: 'bar-error', role: 'status', 'data-testid': 'fit-error' });
  private readonly steps = element('div', { class: 'row' });
  private readonly line = new ErrorLine();
  private shown: Variant | null = null;

  constructor(private readonly studio: Studio) {
    const busy = element('span', { class: 'busy', role: 'status', 'data-testid': 'busy' });
    studio.busy.watch((acts) => {
      busy.textContent = acts > 0 ? 'fitting …' : '';
    });
    this.root = element(
      'div',
      { class: 'bar', role: 'region', 'aria-label': 'Model and fit' },
      element('div', { class: 'bar-line' }, this.steps, this.model, this.error, busy, this.files()),
      this.line.root,
    );
    studio.state.watch((state) => this.show(state));
    new UndoKeys((way) => {
      if (studio.state.value[way] !== null) void studio.act({ do: way }, this.line);
    });
  }

  private show(state: StudioState): void {
    const { studio, line } = this;
    const step = (way: 'undo' | 'redo', words: string): HTMLElement =>
      element(
        'button',
        {
          type: 'button',
          id: way,
          'data-testid': way,
          title: way === 'undo' ? 'Undo (Ctrl Z)' : 'Redo (Ctrl Y)',
          disabled: state[way] === null,
          onclick: () => void studio.act({ do: way }, line),
        },
        words,
      );
    refill(this.steps, step('undo', '↶ Undo'), step('redo', 'Redo ↷'));
    const current = state.variants.find((variant) => variant.id === state.current);
    const effects = current?.effects ?? [];
    refill(
      this.model,
      element('span', { class: 'tag' }, 'base'),
      ...effects.map((effect) =>
        element(
          'span',
          { class: 'tag' },
          effect,
          ' ',
          element(
            'button',
            {
              type: 'button',
              class: 'small',
              'aria-label': `Take ${effect} out`,
              title: `Take ${effect} out`,
              'data-testid': `remove-${effect}`,
              onclick: () => void studio.act({ do: 'remove', effect }, line),
            },
            '×',
          ),
        ),
      ),
    );
    if (current) this.showError(state, current);
  }

  /** The error, and what it was before the last act. */
  private showError(state: StudioState, current: Variant): void {
    const before =
      this.shown === null || this.shown.id === current.id
        ? (state.variants.find((variant) => variant.id === current.parent) ?? null)
        : (state.variants.find((variant) => variant.id === this.shown?.id) ?? null);
    this.shown = current;
    const fell = before !== null && current.position_rmse < before.position_rmse * 0.999;
    const parts = [
      before === null ? '' : `${length(before.position_rmse)} → `,
      element(
        'strong',
        { class: fell ? 'fell' : null, 'data-testid': 'position-rmse' },
        length(current.position_rmse),
      ),
      current.orientation_rmse === null ? '' : `, ${angle(current.orientation_rmse)}`,
      current.reduced_chi2 === null ? '' : `, χ²/dof ${significant(current.reduced_chi2)}`,
      element('span', { class: 'hint' }, ` fitted in ${significant(current.milliseconds, 2)} ms`),
    ];
    this.error.replaceChildren('error ', ...parts);
  }

  private files(): HTMLElement {
    const button = (what: 'session' | 'report', words: string): HTMLElement =>
      element(
        'button',
        { type: 'button', 'data-testid': `save-${what}`, onclick: () => void this.download(what) },
        words,
      );
    const chooser = element('input', {
      type: 'file',
      accept: '.json,application/json',
      class: 'visually-hidden',
      'data-testid': 'open-session',
      tabindex: -1,
      'aria-label': 'Session file',
      onchange: () => void this.open(chooser),
    });
    return element(
      'div',
      { class: 'row bar-files' },
      button('session', 'Save session'),
      element('button', { type: 'button', onclick: () => chooser.click() }, 'Open session'),
      chooser,
      button('report', 'Save report'),
    );
  }

  private async download(what: 'session' | 'report'): Promise<void> {
    try {
      const blob = await api.file(what);
      const name = this.studio.state.value.report.scene.name;
      saveBlob(what === 'report' ? `${name}.html` : `${name}.session.json`, blob);
      this.line.clear();
    } catch (error) {
      this.line.tell(error);
      this.studio.heed(error);
    }
  }

  private async open(chooser: HTMLInputElement): Promise<void> {
    const file = chooser.files?.[0];
    if (!file) return;
    await this.studio.openSession(await file.text(), this.line);
    chooser.value = '';
  }
}
