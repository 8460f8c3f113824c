// The books of the shown model: what was conserved.

import { element } from '../element';
import type { Child } from '../element';
import { NONE, significant, tuple, withDeviation } from '../numbers';
import type { LedgerEntry, LedgerLine, Model, Report } from '../report';
import { table } from '../table';
import { quantityInWords } from '../words';

export function ledger(report: Report, model: Model): Child[] {
  const { about, lines } = model.residuals.ledger;
  let last: string | null | undefined = '';
  const rows = lines.map((line): Child[] => {
    const isNew = line.body !== last;
    last = line.body;
    const isKept = isRounding(line);
    return [
      isNew ? (line.body ?? 'all together') : '',
      quantityInWords(line.quantity).words,
      entry(line.before),
      entry(line.after),
      isKept ? '0' : entry(line.change),
      typeof line.change_in_sigma === 'number' && !isKept
        ? `${significant(line.change_in_sigma, 2)} σ`
        : NONE,
      line.unit,
    ];
  });
  return [
    element(
      'p',
      { class: 'hint' },
      `Angular momentum is about ${tuple(about)} m. ${isAlone(lines) ? wentInto(report) : KEPT} The energy lost is the restitution’s.`,
    ),
    table(
      'The books: before, after, and the difference, per kg of the first body',
      [
        { head: 'body' },
        { head: 'quantity' },
        { head: 'before', isNumber: true },
        { head: 'after', isNumber: true },
        { head: 'after − before', isNumber: true },
        { head: 'in σ', isNumber: true },
        { head: 'unit' },
      ],
      rows,
      'ledger',
    ),
  ];
}

const KEPT =
  'One impulse at one point keeps both momenta of all together, and about that point each body’s own angular momentum.';

/** There are no lines of all together. */
function isAlone(lines: LedgerLine[]): boolean {
  return lines.every((line) => typeof line.body === 'string');
}

/** A lone body's momentum changes by whatever it hit. */
function wentInto({ scene }: Report): string {
  const hit = scene.plane ? `the plane, ${scene.plane.name}` : 'a body that isn’t in the scene';
  return `The change of momentum and angular momentum went into what it hit: ${hit}.`;
}

/** Whether nothing changed but the last digits that a computer has. */
function isRounding({ before, after, change }: LedgerLine): boolean {
  const size = (numbers: LedgerEntry): number => Math.hypot(...(numbers.value ?? [NaN]));
  return size(change) <= 1e-9 * Math.max(size(before), size(after));
}

function entry({ value, std }: LedgerEntry): string {
  if (!value) return NONE;
  if (value.length === 1) return withDeviation(value[0], std[0]);
  return tuple(value);
}
