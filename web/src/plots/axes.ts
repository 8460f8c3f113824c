// What each axis of residuals means: how to read its plot.

const READING: Record<string, [positive: string, shows: string]> = {
  along_velocity: ['ahead of the model on its path', 'drag, or a late or early clock'],
  across_velocity_level: ['to the right of the model’s path', 'a side force'],
  across_velocity_upward: ['above the model’s path', 'lift'],
  against_gravity: ['higher than the model', 'gravity’s size, the scale'],
  omega_cross_velocity: ['shifted along spin × velocity', 'a Magnus force'],
  line_of_sight: ['farther from the camera than the model', 'wrong depths'],
  about_spin: ['turned further than the model', 'spin lost to the air'],
  across_spin_level: ['tilted about the level axis across its spin', 'a wrong inertia'],
  across_spin_upward: ['tilted about the other axis across its spin', 'a wrong inertia'],
};

/** How to read a plot along `axis` of `body`; of one that fails, too, what that hints at. */
export function reading(body: string, axis: string, fails: boolean): string {
  const [positive, shows] = READING[axis] ?? ['off in the positive sense', 'something the model lacks'];
  const hint = fails ? ` This hints at ${shows}.` : '';
  return `Measured minus model. Above zero: ${body} is ${positive}. Grey: ±2 σ.${hint}`;
}
