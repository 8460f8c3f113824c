// How the error fell, effect by effect.

import { element } from '../element';
import type { Child } from '../element';
import { angle, length, pValue, significant } from '../numbers';
import type { Improvement, Rung } from '../report';
import { savers } from '../plots/savers';
import { save, saveImage } from '../save';
import { svgFile } from '../svg';
import { table } from '../table';
import { parametersInWords } from './estimates';
import { ladderPlot } from './ladder_plot';

export function ladder(improvement: Improvement): Child[] {
  const plot = ladderPlot(improvement.ladder);
  const dropped = improvement.dropped;
  return [
    element('p', {}, improvement.explanation),
    element(
      'figure',
      { class: 'plot' },
      element(
        'figcaption',
        {},
        element('span', { class: 'plot-title' }, 'Error by rung, relative to the start'),
        savers(
          {
            format: 'SVG',
            test: 'save-ladder',
            save: () => save('ladder.svg', 'image/svg+xml', svgFile(ladderPlot(improvement.ladder))),
          },
          {
            format: 'PNG',
            test: 'save-ladder-png',
            save: () => void saveImage(ladderPlot(improvement.ladder), 'ladder.png'),
          },
        ),
      ),
      plot,
      element(
        'p',
        { class: 'hint' },
        'Shorter bars are better. An effect that is real shortens the held-out bar, too: it predicts poses that the fit hasn’t seen.',
      ),
    ),
    table(
      'The ladder: each rung adds an effect to those above it',
      [
        { head: 'model', isProse: true },
        { head: 'p-value', isNumber: true },
        { head: 'positions', isNumber: true },
        { head: 'held out', isNumber: true },
        { head: 'orientations', isNumber: true },
        { head: 'χ² / dof', isNumber: true },
        { head: 'mass ratio', isNumber: true },
        { head: 'restitution', isNumber: true },
      ],
      improvement.ladder.map(row),
      'ladder',
    ),
    dropped.length > 0 &&
      element('p', {}, `Added on the way, and superfluous in the end: ${dropped.join(', ')}.`),
  ];
}

function row(rung: Rung): Child[] {
  return [
    rung.added ? added(rung.added, rung) : startInWords(rung),
    pValue(rung.p_value),
    length(rung.position_rmse),
    length(rung.heldout_position_rmse),
    angle(rung.orientation_rmse),
    significant(rung.reduced_chi2),
    significant(rung.mass_ratio, 4),
    significant(rung.restitution, 4),
  ];
}

function added(effect: string, rung: Rung): Child {
  const { parameters = {}, indistinguishable_from: names = [], look_alikes: lookAlikes = [] } = rung;
  // Older ladders have names alone.
  const size = (name: string): Rung['parameters'] =>
    lookAlikes.find((other) => other.effect === name)?.parameters ?? {};
  const others = names.map((name) => withValues(name, size(name)));
  const hint = others.length > 0 && ` can’t be told from ${others.join(' or ')}`;
  return element('span', {}, `+ ${withValues(effect, parameters)}`, element('span', { class: 'hint' }, hint));
}

function withValues(effect: string, parameters: Rung['parameters'] = {}): string {
  const values = parametersInWords(parameters);
  return values === '' ? effect : `${effect} (${values})`;
}

function startInWords(rung: Rung): string {
  return rung.with.length === 0 ? 'base model' : `base + ${rung.with.join(' + ')}`;
}
