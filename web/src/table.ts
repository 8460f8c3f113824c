// Tables of texts; the first column names the row.

import { element } from './element';
import type { Child } from './element';

export interface Column {
  head: string;
  /** Numbers stand to the right. */
  isNumber?: boolean;
}

/** It scrolls by itself where it is wider than the page. */
export function table(caption: string, columns: Column[], rows: Child[][], test?: string): HTMLElement {
  const cellClass = (index: number): string | null => (columns[index]?.isNumber ? 'number' : null);
  const made = element('table', { 'data-testid': test },
    element('caption', {}, caption),
    element('thead', {}, element('tr', {},
      ...columns.map((column, index) => element('th', { scope: 'col', class: cellClass(index) }, column.head)))),
    element('tbody', {}, ...rows.map((row) => element('tr', {},
      ...row.map((cell, index) =>
        index === 0
          ? element('th', { scope: 'row' }, cell)
          : element('td', { class: cellClass(index) }, cell))))));
  return element('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': caption }, made);
}
