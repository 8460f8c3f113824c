// The data's names in words.

import type { ActiveEffect, Candidate } from './report';

const FLAGS: Record<string, [meaning: string, advice: string]> = {
  mass_ratio_at_bound: [
    'the mass ratio ended at its bound: this is a failed fit',
    'check the poses nearest the collision, their times and the sizes; more poses on each side help most',
  ],
  restitution_out_of_range: [
    'the restitution is not between 0 and 1: the bodies would gain energy or pass through each other',
    'check the poses nearest the collision, their times and the sizes; more poses on each side help most',
  ],
  not_converged: ['the last phase ended before it settled', 'check for poses far off their neighbours'],
  no_visible_impulse: [
    'no jump in velocity stands out of the noise: perhaps nothing was hit',
    'film a harder hit, or annotate more poses and longer flights',
  ],
  mass_ratio_unidentifiable: [
    'a body’s jump in velocity doesn’t stand out of the noise: the mass ratio is at best a bound',
    'film a harder hit, or annotate more poses and longer flights',
  ],
  poor_fit: [
    'the model misses the poses by more than annotations scatter',
    'check the order of the quaternion’s components, up, fps and the units, then single poses; else an effect is missing',
  ],
  several_optima: [
    'another solution explains the poses nearly as well',
    'annotate poses nearer the collision, or nearer each other where a body spins fast',
  ],
};

/** What is doubtful, and what to do about it. */
export interface Doubt {
  meaning: string;
  advice: string;
}

/** A flag in words; one of a later version keeps its name. */
export function flagInWords(flag: string): Doubt {
  const [meaning, advice] = FLAGS[flag] ?? [plain(flag), ''];
  return { meaning, advice };
}

const QUANTITIES: Record<string, string> = {
  mass_ratio: 'mass ratio m_b / m_a',
  restitution: 'restitution c',
  collision_time: 'collision time t_c',
  contact_point: 'contact point',
  impulse: 'impulse on the first body J',
  normal: 'normal of the contact',
  momentum_change: 'momentum, after − before',
  angular_momentum_change: 'angular momentum, after − before',
  energy_change: 'energy, after − before',
  momentum: 'momentum',
  angular_momentum: 'angular momentum',
  translational_energy: 'energy of the motion',
  rotational_energy: 'energy of the spin',
  potential_energy: 'energy of the height',
  energy: 'energy, all',
  position: 'position at the collision',
  orientation: 'orientation (w, x, y, z)',
  velocity_before: 'velocity before',
  velocity_after: 'velocity after',
  angular_velocity_before: 'spin before',
  angular_velocity_after: 'spin after',
};

/** `a.velocity_after` is split into the body and the quantity in words. */
export function quantityInWords(name: string): { body: string | null; words: string } {
  const dot = name.lastIndexOf('.');
  const own = name.slice(dot + 1);
  return { body: dot < 0 ? null : name.slice(0, dot), words: QUANTITIES[own] ?? plain(own) };
}

/** `quadratic_drag@ball`, or the name alone where it acts on all. */
export function label(effect: ActiveEffect | Candidate): string {
  const name = 'effect' in effect ? effect.effect : effect.name;
  return effect.body ? `${name}@${effect.body}` : name;
}

/** With a capital where it starts with a plain word, and a full stop. */
export function sentence(text: string): string {
  const isWord = /^[a-z]+ /.test(text);
  const start = isWord ? text[0].toUpperCase() + text.slice(1) : text;
  return /[.!?]$/.test(start) ? start : `${start}.`;
}

const plain = (name: string): string => name.replaceAll('_', ' ');
