// What a law may say, in short, and one to start from.

import { element } from '../element';

export const LAW_EXAMPLE = `name = "my_drag"
title = "Air drag of a power of my own"
scope = "body"         # each body has its own; or "scene"

[parameters.k]
unit = "1/m"
null = 0.0             # at this value it does nothing
bounds = [0.0, 10.0]
scale = 0.1            # a typical size

[law]
acceleration = "-k * norm(v) * v"
`;

const NAMES: [name: string, meaning: string][] = [
  ['t', 'time, s'],
  ['t_c', 'time of the collision, s'],
  ['p', 'position, m'],
  ['v', 'velocity, m/s'],
  ['w', 'spin, rad/s'],
  ['L', 'angular momentum per mass, m^2/s'],
  ['up', 'unit vector against gravity'],
  ['g', 'gravity, m/s^2'],
  ['camera', 'the camera’s centre, m'],
  ['normal', 'of the plane or the contact'],
  ['size', 'the box’s edges, m'],
];
const HOOKS: [hook: string, unit: string][] = [
  ['acceleration', 'm/s^2'],
  ['torque', 'm^2/s^2'],
  ['impulse', 'm/s, at the collision'],
  ['angular_impulse', 'm^2/s, at the collision'],
  ['inertia', 'factors on the moments'],
  ['time', 's, when it was seen'],
  ['position', 'm, where it is seen'],
  ['orientation', 'rad, how it is seen'],
];

export function lawHelp(): HTMLElement {
  return element(
    'details',
    { class: 'law-help' },
    element('summary', {}, 'What a law may say'),
    element('p', { class: 'hint' }, 'In ', element('code', {}, '[law]'), ', one or more of'),
    list(HOOKS),
    element('p', { class: 'hint' }, 'by the parameters and'),
    list(NAMES),
    element(
      'p',
      { class: 'hint' },
      'with dot, cross, norm, unit, rotate, unrotate, exp, log, sin, cos, sqrt, pow, min, max, step. ' +
        'At the parameters’ null values it must do nothing.',
    ),
  );
}

function list(all: [string, string][]): HTMLElement {
  return element(
    'dl',
    { class: 'keys hint' },
    ...all.flatMap(([name, meaning]) => [
      element('dt', {}, element('code', {}, name)),
      element('dd', {}, meaning),
    ]),
  );
}
