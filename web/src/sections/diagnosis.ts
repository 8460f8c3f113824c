// Which effect is missing: the answer in words, the candidates, what is left, what to film next.

import { element } from '../element';
import type { Child } from '../element';
import { length, NONE, probability, pValue, significant, tuple } from '../numbers';
import type { Candidate, Diagnosis, Unexplained } from '../report';
import { table } from '../table';
import { label } from '../words';
import { parametersInWords } from './estimates';

/** `adder` makes a button that adds an effect; a report has none. */
export function diagnosisSection(diagnosis: Diagnosis, adder?: (effect: string) => HTMLElement): Child[] {
  const asked =
    diagnosis.model.length === 0
      ? 'the base model'
      : `the base model with ${diagnosis.model.map(label).join(', ')}`;
  return [
    element('p', { class: 'label' }, `Asked of ${asked}`),
    element('p', { class: 'lead', 'data-testid': 'explanation' }, diagnosis.explanation),
    ...(diagnosis.candidates.length > 0 ? [candidates(diagnosis, adder), hint(diagnosis)] : []),
    ...(diagnosis.unexplained ?? []).map(unexplained),
    diagnosis.advice.length > 0 &&
      element(
        'div',
        {},
        element('p', { class: 'label' }, 'Next'),
        element(
          'ul',
          { class: 'lines', 'data-testid': 'advice' },
          ...diagnosis.advice.map((one) => element('li', {}, one)),
        ),
      ),
  ];
}

function hint(diagnosis: Diagnosis): HTMLElement {
  const probabilities =
    diagnosis.verdict === 'unknown_effect'
      ? 'No candidate explains the poses: the probabilities are how they compare with each other.'
      : `The probability that nothing is missing: ${probability(diagnosis.probability_of_nothing)}.`;
  const rest =
    'A p-value counts all candidates. Held out: how far the fit misses positions that it hasn’t seen, without and with the effect.';
  return element('p', { class: 'hint' }, `${probabilities} ${rest}`);
}

function candidates(diagnosis: Diagnosis, adder?: (effect: string) => HTMLElement): HTMLElement {
  const columns = [
    { head: 'candidate' },
    { head: 'probability', isNumber: true },
    { head: 'p-value', isNumber: true },
    { head: 'Δχ²', isNumber: true },
    { head: 'held out', isNumber: true },
    { head: 'parameters', isProse: true },
    { head: 'can’t be told from', isProse: true },
  ];
  const rows = diagnosis.candidates.map((candidate): Child[] => [
    element('span', { class: candidate.stands_out ? 'stands-out' : null }, label(candidate)),
    probability(candidate.probability),
    pValue(candidate.p_value),
    significant(candidate.delta_chi2, 4),
    heldOut(candidate),
    parametersInWords(candidate.parameters),
    candidate.indistinguishable_from.join(', ') || NONE,
    ...(adder ? [adder(label(candidate))] : []),
  ]);
  return table(
    'Candidates, the best first; bold ones stand out of the noise and predict better',
    adder ? [...columns, { head: 'add' }] : columns,
    rows,
    'candidates',
  );
}

function heldOut(candidate: Candidate): string {
  const { heldout_rmse_before: before, heldout_rmse_after: after } = candidate;
  return typeof before === 'number' && typeof after === 'number'
    ? `${length(before)} → ${length(after)}`
    : NONE;
}

const LEFT_OVER: Record<Unexplained['kind'], { what: string; unit: string }> = {
  acceleration: { what: 'a force of', unit: 'm/s²' },
  torque: { what: 'a torque of', unit: 'm²/s² per kg' },
  position: { what: 'the tracked point is off by', unit: 'm' },
};

function unexplained(force: Unexplained): HTMLElement {
  const { what, unit } = LEFT_OVER[force.kind];
  const forms = force.forms.map((form): Child[] => [
    form.goes_with,
    `${significant(100 * form.share, 3)} %`,
    significant(form.factor),
    element('code', {}, form.law),
  ]);
  return element(
    'div',
    { 'data-testid': 'unexplained' },
    element(
      'p',
      {},
      `Left over on ${force.body}: ${what} ${significant(force.rms)} ${unit} ` +
        `(root mean square), on average ${tuple(force.mean)} ${unit}; χ² would fall by ${significant(force.delta_chi2, 4)}.`,
    ),
    forms.length > 0 &&
      table(
        'What it goes with, the best first: laws to try',
        [
          { head: 'it goes with' },
          { head: 'explains', isNumber: true },
          { head: 'factor, SI', isNumber: true },
          { head: 'as a law' },
        ],
        forms,
      ),
  );
}
