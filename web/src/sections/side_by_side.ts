// What several results say of each quantity, and how they differ from the first.

import { element } from '../element';
import type { Child } from '../element';
import { angle, length, NONE, significant, tuple, withDeviation } from '../numbers';
import type { Quantity, QuantityEntry, Report } from '../report';
import { table } from '../table';
import { quantityInWords } from '../words';

export function sideBySide(report: Report): Child[] {
  const { models } = report;
  const columns = [
    { head: 'quantity' },
    { head: 'unit' },
    ...models.map((model) => ({ head: model.name, isNumber: true })),
    ...models.slice(1).map((model) => ({
      head: models.length > 2 ? `${model.name} − first` : 'difference',
      isNumber: true,
    })),
  ];
  const told = report.quantities.filter((quantity) => quantity.entries.some((entry) => entry.value));
  const errors: Child[][] = [
    [
      'error of the fit, positions',
      '',
      ...models.map((model) => length(model.result.fit.position_rmse)),
      ...models.slice(1).map(() => ''),
    ],
    [
      'error of the fit, orientations',
      '',
      ...models.map((model) => angle(model.result.fit.orientation_rmse)),
      ...models.slice(1).map(() => ''),
    ],
    [
      'χ² per degree of freedom',
      '',
      ...models.map((model) => significant(model.result.fit.reduced_chi2)),
      ...models.slice(1).map(() => ''),
    ],
  ];
  return [
    table(
      'Results side by side; differences are from the first, in σ where one has a deviation',
      columns,
      [...errors, ...told.map(row)],
      'side-by-side',
    ),
    element(
      'p',
      { class: 'hint' },
      'Results of the same poses share their errors: σ is a yardstick here, not a test.',
    ),
  ];
}

function row(quantity: Quantity): Child[] {
  const { body, words } = quantityInWords(quantity.quantity);
  return [
    body === null ? words : `${body}: ${words}`,
    quantity.unit,
    ...quantity.entries.map(entry),
    ...quantity.differences.map(
      (difference) =>
        significant(difference.size) +
        (typeof difference.in_sigma === 'number' ? ` (${significant(difference.in_sigma, 2)} σ)` : ''),
    ),
  ];
}

function entry({ value, std, reason }: QuantityEntry): Child {
  if (!value) return element('span', { title: reason }, NONE);
  return value.length === 1 ? withDeviation(value[0], std[0]) : tuple(value);
}
