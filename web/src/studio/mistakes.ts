// Mistakes in words: the line, a caret under the place, the problem and the mend.

import { element } from '../element';
import { sentence } from '../words';
import type { Mistake } from '../studio_state';

export function mistakes(text: string, all: Mistake[]): HTMLElement[] {
  const lines = text.split('\n');
  return all.map((mistake) => {
    const line = lines[mistake.line - 1] ?? '';
    const caret = ' '.repeat(Math.max(0, mistake.column - 1)) + '^'.repeat(Math.max(1, mistake.length));
    return element(
      'div',
      { class: 'mistake', 'data-testid': 'mistake' },
      element('p', { class: 'label' }, `Line ${mistake.line}`),
      element('pre', {}, `${line}\n${caret}`),
      element('p', {}, sentence(mistake.problem + (!mistake.mend ? '' : `; ${mistake.mend}`))),
    );
  });
}
