// Tables of texts; the first column names the row.

import { element, freshId } from './element';
import type { Child } from './element';
import { NONE } from './numbers';

export interface Column {
  head: string;
  /** Numbers stand to the right. */
  isNumber?: boolean;
  /** May be broken into lines. */
  isProse?: boolean;
}

/** It scrolls by itself where it is wider than the page. Columns that hold nothing are left out. */
export function table(caption: string, columns: Column[], rows: Child[][], test?: string): HTMLElement {
  const kept = columns
    .map((_, index) => index)
    .filter((index) => index === 0 || rows.some((row) => !isNothing(row[index])));
  const kind = (index: number): string | null =>
    columns[index].isNumber ? 'number' : columns[index].isProse ? 'prose' : null;
  const head = kept.map((index) => element('th', { scope: 'col', class: kind(index) }, columns[index].head));
  const body = rows.map((row) =>
    element(
      'tr',
      {},
      element('th', { scope: 'row' }, row[0]),
      ...kept.slice(1).map((index) => element('td', { class: kind(index) }, row[index])),
    ),
  );
  // One by one: there may be more rows than a call takes arguments.
  const content = element('tbody');
  for (const row of body) content.append(row);
  // Outside of what scrolls, so that one can read all of it.
  const id = freshId('caption');
  const made = element(
    'table',
    { 'data-testid': test, 'aria-labelledby': id },
    element('thead', {}, element('tr', {}, ...head)),
    content,
  );
  return element(
    'div',
    { class: 'table' },
    element('p', { class: 'caption', id }, caption),
    element('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-labelledby': id }, made),
  );
}

function isNothing(cell: Child): boolean {
  return cell === NONE || cell === '' || cell === null || cell === undefined || cell === false;
}
