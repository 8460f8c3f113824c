// The books of the shown model: what was conserved.

import { element } from '../element';
import type { Child } from '../element';
import { NONE, significant, tuple, withDeviation } from '../numbers';
import type { LedgerEntry, LedgerLine, Model } from '../report';
import { table } from '../table';
import { quantityInWords } from '../words';

export function ledger(model: Model): Child[] {
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
      `Angular momentum is about ${tuple(about)} m. One impulse at one point keeps both momenta of all together, ` +
        'and about that point each body’s own angular momentum. The energy lost is the restitution’s.',
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
