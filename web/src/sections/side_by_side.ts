// What several results say of each quantity, and how they differ from the first.

import { element } from '../element';
import type { Child } from '../element';
import { angle, decimalsFor, DEGREES, fixed, length, NONE, significant } from '../numbers';
import type { Maybe } from '../numbers';
import type { Difference, Quantity, QuantityEntry, Report } from '../report';
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
      'Results side by side; differences are from the first: later minus first, of vectors the length, of orientations the angle; in σ where one has a deviation',
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
  const decimals = decimalsOf(quantity);
  return [
    body === null ? words : `${body}: ${words}`,
    quantity.unit,
    ...quantity.entries.map((one) => entry(one, decimals)),
    ...quantity.differences.map((one) => difference(one, quantity.difference_unit, decimals)),
  ];
}

/** The same for all results, lest rounding hide how they differ: two digits of the least deviation. */
function decimalsOf({ entries }: Quantity): number {
  const MOST = 6;
  const stds = entries.flatMap(({ std }) => std).filter((std) => typeof std === 'number' && std > 0);
  if (stds.length > 0) return Math.min(decimalsFor(0, Math.min(...(stds as number[]))), MOST);
  return entries.every(({ value }) => !value || value.length === 1) ? 4 : 3;
}

function entry({ value, std, reason }: QuantityEntry, decimals: number): Child {
  if (!value) return element('span', { title: reason }, NONE);
  const numbers = value.map((one) => number(one, decimals));
  if (numbers.length > 1) return `(${numbers.join(', ')})`;
  return typeof std[0] === 'number' ? `${numbers[0]} ± ${number(std[0], decimals)}` : numbers[0];
}

/** A degree is about a fiftieth of a radian. */
const FEWER_IN_DEGREES = 2;

function difference(
  { difference, size, in_sigma }: Difference,
  unit: Maybe<string>,
  decimals: number,
): string {
  if (!difference || typeof size !== 'number') return NONE;
  const far = typeof in_sigma === 'number' ? ` (${number(in_sigma, 1)} σ)` : '';
  if (unit === 'rad') return `${number(size * DEGREES, Math.max(decimals - FEWER_IN_DEGREES, 2))}°${far}`;
  if (difference.length > 1) return number(size, decimals) + far;
  return `${difference[0] > 0 ? '+' : ''}${number(difference[0], decimals)}${far}`;
}

function number(value: number, decimals: number): string {
  return Math.abs(value) < 1e5 ? fixed(value, decimals) : significant(value);
}
