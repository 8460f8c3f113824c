// What the residuals tell of each pose.

import type { StudioState } from '../studio_state';

export interface Facts {
  /** The largest of its residuals, in σ; null where there is no noise. */
  farthest: number | null;
  /** Its own σ over that of the others. */
  scale: number;
}

export const NO_FACTS: Facts = { farthest: null, scale: 1 };

export function factsOf(state: StudioState, body: string): Map<number, Facts> {
  const facts = new Map<number, Facts>();
  for (const { body: owner, sigma, points } of state.report.models[0]?.series ?? []) {
    if (owner !== body) continue;
    for (const point of points) {
      const scale = point.noise_scale ?? 1;
      const off = sigma ? Math.abs(point.value) / (sigma * scale) : null;
      const known = facts.get(point.observation)?.farthest ?? null;
      facts.set(point.observation, { farthest: off === null ? known : Math.max(off, known ?? 0), scale });
    }
  }
  return facts;
}
