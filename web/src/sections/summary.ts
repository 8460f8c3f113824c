// The first glance: what this is, whether the model fits, what is missing.

import { element } from '../element';
import type { Child } from '../element';
import { angle, length, significant, withDeviation, withUnit } from '../numbers';
import type { Estimate, Model, Report } from '../report';
import { flagInWords, label } from '../words';
import type { Doubt } from '../words';

export function summary(report: Report, model: Model | null): HTMLElement[] {
  if (model === null) return [element('p', {}, 'This report holds no result.')];
  return [
    element('div', { class: 'glance' }, verdict(report, model), keyNumbers(model)),
    ...flags(report, model),
  ];
}

/** In one sentence whether the model fits, in another what is missing. */
function verdict(report: Report, model: Model): HTMLElement {
  const missing = diagnosisOf(report, model)?.explanation ?? ofLadder(report.improvement, model);
  const fits = fit(report, model);
  return element(
    'div',
    { class: `verdict ${fits.isGood === false ? 'bad' : 'good'}`, 'data-testid': 'verdict' },
    element('p', { class: 'lead' }, fits.words),
    missing && element('p', {}, missing),
    ...findings(model),
  );
}

/** The diagnosis fits for itself: it says nothing of other models, nor of the paper's method. */
function diagnosisOf({ diagnosis }: Report, model: Model): Report['diagnosis'] {
  if (!diagnosis || model.result.preset !== 'refined') return null;
  return hasEffects(model, diagnosis.model.map(label)) ? diagnosis : null;
}

/** What the ladder says of its last model. */
function ofLadder(improvement: Report['improvement'], model: Model): string | null {
  const last = improvement?.ladder.at(-1);
  const isRefined = model.result.preset === 'refined';
  if (!last || !improvement || !isRefined || !hasEffects(model, last.with)) return null;
  return improvement.explanation;
}

function hasEffects(model: Model, labels: string[]): boolean {
  const own = model.result.effects.map(label);
  return own.length === labels.length && own.every((one) => labels.includes(one));
}

interface FitInWords {
  words: string;
  isGood: boolean | null;
}

function fit(report: Report, model: Model): FitInWords {
  const { residuals, result } = model;
  const rmse = residuals.position_rmse ?? result.fit.position_rmse;
  const noise = report.noise;
  const size = `${length(rmse)} a coordinate${noise ? `, ${significant(rmse / noise.position, 2)} σ of the noise` : ''}`;
  const structure = residuals.structure ?? [];
  const isStructured = structure.some((test) => test.fails);
  if (result.flags.includes('poor_fit') || isStructured) {
    return { words: `The model misses the measured poses by more than noise: ${size}.`, isGood: false };
  }
  // A flag takes residuals of twice the noise; what is beyond chance is worth a word before.
  const reduced = result.fit.reduced_chi2;
  if (model.is_beyond_chance && typeof reduced === 'number') {
    const times = significant(Math.sqrt(reduced));
    return {
      words:
        `The model misses the measured poses by ${size}. ` +
        `The residuals are ${times} times as large as the stated noise, which is beyond chance.`,
      isGood: null,
    };
  }
  if (structure.length === 0) {
    return { words: `The model misses the measured poses by ${size}.`, isGood: null };
  }
  return { words: `The model meets the measured poses to their noise: ${size}.`, isGood: true };
}

function findings(model: Model): Child[] {
  const all = model.residuals.findings ?? [];
  if (all.length === 0) return [];
  const list = (from: string[]): HTMLElement =>
    element('ul', { class: 'findings' }, ...from.map((f) => element('li', {}, f)));
  const rest = all.slice(3);
  return [
    element('p', { class: 'label' }, 'Where it fails, the clearest first'),
    list(all.slice(0, 3)),
    rest.length > 0 && element('details', {}, element('summary', {}, `${rest.length} more`), list(rest)),
  ];
}

function keyNumbers(model: Model): HTMLElement {
  const { result } = model;
  const numbers: [string, string][] = [];
  /** What the studio's bar shows already. */
  const inBar: [string, string][] = [];
  if (result.mass_ratio) numbers.push(['mass ratio', estimate(result.mass_ratio, '')]);
  numbers.push(['restitution', estimate(result.restitution, '')]);
  numbers.push(['collision time', estimate(result.collision_time, 's')]);
  const turn = result.fit.orientation_rmse;
  inBar.push([
    'error of the fit',
    length(result.fit.position_rmse) + (typeof turn === 'number' ? `, ${angle(turn)}` : ''),
  ]);
  if (typeof result.fit.reduced_chi2 === 'number') {
    inBar.push(['χ² per degree of freedom', significant(result.fit.reduced_chi2)]);
  }
  const effects = result.effects.map(label).join(', ');
  inBar.push(['model', effects === '' ? 'base' : `base + ${effects}`]);
  return element(
    'dl',
    { class: 'key-numbers', 'data-testid': 'key-numbers' },
    ...[...numbers, ...inBar].map((one) => {
      const [name, value] = one;
      const kind = inBar.includes(one) ? 'in-bar' : null;
      return element('div', { class: kind }, element('dt', {}, name), element('dd', {}, value));
    }),
  );
}

function estimate(value: Estimate, unit: string): string {
  if (typeof value.value !== 'number') return 'not told';
  return withUnit(withDeviation(value.value, value.std), unit);
}

function flags(report: Report, model: Model): HTMLElement[] {
  // Where the diagnosis names what is missing, the fit's being poor is no further doubt.
  const isExplained = diagnosisOf(report, model)?.verdict === 'missing';
  const left = model.result.flags.filter((flag) => flag !== 'poor_fit' || !isExplained);
  const doubts = [...left.map(flagInWords), ...unsureRestitution(model)];
  if (doubts.length === 0) return [];
  const items = doubts.map(({ meaning, advice }) =>
    element('li', {}, meaning, advice === '' ? '' : element('span', { class: 'hint' }, ` Mend: ${advice}.`)),
  );
  return [
    element(
      'div',
      { class: 'flags', 'data-testid': 'flags' },
      element('p', { class: 'label' }, 'Doubts'),
      element('ul', {}, ...items),
    ),
  ];
}

/** Beyond what can be, and no failed fit: its interval holds what can. */
/** A 95 % interval of a restitution that is wider says little. */
const VAGUE = 0.2;

function unsureRestitution({ result }: Model): Doubt[] {
  const { value, interval_95: interval } = result.restitution;
  const isPossible = typeof value !== 'number' || (value >= 0 && value <= 1);
  if (isPossible || result.flags.includes('restitution_out_of_range')) return [];
  const isVague = Array.isArray(interval) && Math.abs(Number(interval[1]) - Number(interval[0])) > VAGUE;
  return [
    {
      meaning: isVague
        ? 'the restitution is not between 0 and 1, but its 95 % interval reaches there: the poses hardly tell it'
        : 'the restitution is just beyond what can be, but by no more than its error',
      advice: isVague ? 'annotate more poses near the collision, and longer flights' : '',
    },
  ];
}
