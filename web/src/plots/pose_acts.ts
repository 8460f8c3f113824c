// What can be done to poses in plots; the studio does it.

export const MODES = ['look', 'mark', 'time', 'noise'] as const;
export type Mode = (typeof MODES)[number];

export interface PoseActs {
  /** What a click or a drag in a plot does. */
  mode: Mode;
  /** Between which a pose's own noise may be, over that of the others. */
  readonly noiseScales: [least: number, most: number];
  readonly isMarked: (body: string, observation: number) => boolean;
  mark: (body: string, observation: number, wrong: boolean) => void;
  move: (body: string, observation: number, time: number) => void;
  /** Its own σ over that of the others. */
  poseNoise: (body: string, observation: number, scale: number) => void;
  /** One σ in m or rad. */
  noise: (channel: 'position' | 'orientation', sigma: number) => void;
}
