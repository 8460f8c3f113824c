// The shown model's numbers with their 95 % intervals, its effects, doubts and phases.

import { element } from '../element';
import type { Child } from '../element';
import {
  angle,
  decimalsFor,
  fixed,
  length,
  NONE,
  significant,
  tuple,
  withDeviation,
  withUnit,
} from '../numbers';
import type { Maybe } from '../numbers';
import type { ActiveEffect, Estimate, Model, ParameterEstimate, Report, Vector } from '../report';
import { table } from '../table';
import { label } from '../words';

export function estimates(report: Report, model: Model): Child[] {
  const { result } = model;
  const deviations = deviationsOf(report, model);
  return [
    scalars(model),
    ...(result.effects.length > 0 ? [effects(result.effects)] : []),
    bodies(model, deviations),
    noise(model),
    ...alternatives(model),
    phases(model),
  ];
}

/** The deviations of a quantity's numbers in words: `(0.004, 0.003, 0.004)`. */
type Deviations = (quantity: string) => string;

function deviationsOf(report: Report, model: Model): Deviations {
  const index = report.models.indexOf(model);
  return (quantity) => {
    const stds = report.quantities.find((one) => one.quantity === quantity)?.entries[index]?.std ?? [];
    const largest = Math.max(0, ...stds.map((std) => std ?? 0));
    if (!(largest > 0)) return NONE;
    const decimals = decimalsFor(largest, largest);
    // Of a number that can't vary there is none.
    return `(${stds.map((std) => (std === null ? NONE : fixed(std, decimals))).join(', ')})`;
  };
}

function scalars(model: Model): HTMLElement {
  const { result } = model;
  const row = (name: string, estimate: Estimate, unit: string): Child[] => [
    name,
    withDeviation(estimate.value, estimate.std),
    interval(estimate),
    unit,
    estimate.reason ?? '',
  ];
  const rows = [
    ...(result.mass_ratio ? [row('mass ratio m_b / m_a', result.mass_ratio, '')] : []),
    row('restitution c', result.restitution, ''),
    row('collision time t_c', result.collision_time, 's'),
  ];
  return table(
    'Estimates: value ± σ, and the interval that holds the truth in 95 of 100 collisions',
    [
      { head: 'quantity' },
      { head: 'value ± σ', isNumber: true },
      { head: '95 % interval', isNumber: true },
      { head: 'unit' },
      { head: 'note', isProse: true },
    ],
    rows,
    'estimates',
  );
}

function interval(estimate: Estimate): string {
  if (!estimate.interval_95) return NONE;
  const decimals = decimalsFor(estimate.value ?? 0, estimate.std);
  return estimate.interval_95.map((end) => fixed(end, decimals)).join(' to ');
}

function effects(all: ActiveEffect[]): HTMLElement {
  const rows = all.flatMap((effect) =>
    Object.entries(effect.parameters).map(([name, parameter]): Child[] => [
      label(effect),
      name,
      parameterInWords(parameter),
      parameter.unit,
      parameter.reason ?? '',
    ]),
  );
  return table(
    'Effects in this model, and their parameters',
    [
      { head: 'effect' },
      { head: 'parameter' },
      { head: 'value ± σ', isNumber: true },
      { head: 'unit' },
      { head: 'note' },
    ],
    rows,
    'effects',
  );
}

/** `0.118 ± 0.0016`; of a vector each number with its own. */
export function parameterInWords(parameter: ParameterEstimate): string {
  const { value, std } = parameter;
  if (value === null || value === undefined) return NONE;
  if (typeof value === 'number') return withDeviation(value, typeof std === 'number' ? std : null);
  return value.map((one, i) => withDeviation(one, Array.isArray(std) ? std[i] : null)).join(', ');
}

/** `k = 0.118 ± 0.0016 1/m`, and so on. */
export function parametersInWords(parameters: Record<string, ParameterEstimate>): string {
  return Object.entries(parameters)
    .map(([name, one]) => `${name} = ${withUnit(parameterInWords(one), one.unit === '1' ? '' : one.unit)}`)
    .join('; ');
}

function bodies(model: Model, deviations: Deviations): HTMLElement {
  const { result } = model;
  const row = (of: string, words: string, value: Maybe<Vector>, key: string, unit: string): Child[] => [
    of,
    words,
    tuple(value, 4),
    deviations(key),
    unit,
  ];
  const contact = [
    row('contact', 'impulse on the first body J', result.impulse, 'impulse', 'N·s/kg'),
    row('', 'contact point x_c', result.contact_point, 'contact_point', 'm'),
    row('', 'normal', result.normal, 'normal', ''),
  ];
  const rows = result.bodies.flatMap((body): Child[][] => [
    row(body.name, 'velocity before', body.velocity_before, `${body.name}.velocity_before`, 'm/s'),
    row('', 'velocity after', body.velocity_after, `${body.name}.velocity_after`, 'm/s'),
    row('', 'spin before', body.angular_velocity_before, `${body.name}.angular_velocity_before`, 'rad/s'),
    row('', 'spin after', body.angular_velocity_after, `${body.name}.angular_velocity_after`, 'rad/s'),
    row('', 'position', body.position, `${body.name}.position`, 'm'),
  ]);
  const told = result.bodies.filter((body) => body.reason).map((body) => `${body.name}: ${body.reason}`);
  if (!result.contact_point) told.push('Contact point: no spin tells where the impulse passed.');
  const reasons = told.map((reason) => element('p', { class: 'hint' }, reason));
  return element(
    'div',
    {},
    table(
      'The contact, and the bodies at the collision: x, y, z of the world',
      [
        { head: 'body' },
        { head: 'quantity' },
        { head: 'value', isNumber: true },
        { head: 'σ', isNumber: true },
        { head: 'unit' },
      ],
      [...contact, ...rows],
      'bodies',
    ),
    ...reasons,
  );
}

function noise(model: Model): HTMLElement {
  const { noise, fit } = model.result;
  const said = noise
    ? `Noise, one σ: ${length(noise.position)} a coordinate` +
      (typeof noise.orientation === 'number' ? `, ${angle(noise.orientation)} an axis` : '') +
      (noise.estimated ? ', estimated from the residuals.' : ', as stated.')
    : 'This method has no noise model, hence no standard deviations.';
  const chi2 =
    typeof fit.chi2 === 'number'
      ? ` χ² = ${significant(fit.chi2, 4)} with ${fit.dof} degrees of freedom.`
      : '';
  return element('p', {}, said, chi2);
}

function alternatives(model: Model): HTMLElement[] {
  const all = model.result.alternatives ?? [];
  if (all.length === 0) return [];
  return [
    table(
      'Other solutions that are nearly as good',
      [
        { head: 'differs in' },
        { head: 'Δχ²', isNumber: true },
        { head: 'mass ratio', isNumber: true },
        { head: 'restitution', isNumber: true },
        { head: 'collision time, s', isNumber: true },
      ],
      all.map((one) => [
        one.differs_in,
        significant(one.delta_chi2),
        significant(one.mass_ratio, 4),
        significant(one.restitution, 4),
        significant(one.collision_time, 5),
      ]),
    ),
  ];
}

function phases(model: Model): HTMLElement {
  const rows = model.result.phases.map((phase): Child[] => [
    phase.name,
    significant(phase.cost_initial),
    significant(phase.cost_final),
    phase.iterations,
    typeof phase.seconds === 'number' ? significant(phase.seconds * 1000, 2) : NONE,
  ]);
  return element(
    'details',
    {},
    element('summary', {}, 'How the solver got there'),
    table(
      `Phases of the ${model.result.preset} solver`,
      [
        { head: 'phase' },
        { head: 'cost at its start', isNumber: true },
        { head: 'at its end', isNumber: true },
        { head: 'iterations', isNumber: true },
        { head: 'ms', isNumber: true },
      ],
      rows,
      'phases',
    ),
  );
}
