// Numbers that are typed: within their limits, or what is wrong in the page's words.

import { significant, withUnit } from '../numbers';
import { Refusal } from './api';

/** What a field's number is: its name, the unit that it is typed in, and the limits in that unit. */
export interface Typed {
  name: string;
  unit: string;
  limits: readonly [least: number, most: number];
  mend: string;
}

export const ANY: Typed['limits'] = [-Infinity, Infinity];

/** Throws a `Refusal` for what is no such number. */
export function typed(field: HTMLInputElement, { name, unit, limits, mend }: Typed): number {
  const [least, most] = limits;
  const value = field.valueAsNumber;
  if (value >= least && value <= most) return value;
  const ends = limits.map((end) => significant(end, 1)).join(' to ');
  const problem = Number.isNaN(value)
    ? 'no number is typed'
    : `${withUnit(significant(value), unit)} is not within ${withUnit(ends, unit)}`;
  throw new Refusal(name, problem, mend, 400);
}
