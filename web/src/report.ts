// The data of a report, smash.report/1, by hand until `smash schema report` is there.

export type Vector = [number, number, number];
export type Quaternion = [number, number, number, number];
export type Segment = 'before' | 'after';
export type Channel = 'position' | 'orientation';

export interface Estimate {
  value: number | null;
  std: number | null;
  interval_95?: [number, number] | null;
  reason?: string | null;
}

export interface ParameterEstimate {
  value: number | Vector | null;
  std: number | Vector | null;
  unit: string;
  reason?: string | null;
}

export interface ActiveEffect {
  name: string;
  body: string | null;
  parameters: Record<string, ParameterEstimate>;
}

export interface BodyResult {
  name: string;
  position: Vector;
  orientation: Quaternion | null;
  velocity_before: Vector;
  velocity_after: Vector;
  angular_velocity_before: Vector | null;
  angular_velocity_after: Vector | null;
  reason?: string | null;
}

export interface Fit {
  position_rmse: number;
  orientation_rmse: number | null;
  chi2: number | null;
  dof: number;
  reduced_chi2: number | null;
  cost: number;
  reason?: string | null;
}

export interface Phase {
  name: string;
  cost_initial: number;
  cost_final: number;
  iterations: number;
  seconds: number | null;
}

export interface Alternative {
  differs_in: string;
  delta_chi2: number;
  mass_ratio: number | null;
  restitution: number | null;
  collision_time: number;
}

export interface Outlier {
  body: string;
  time: number;
  channel: string;
  deviations: number;
}

export interface Reconstruction {
  preset: string;
  segment_by: string;
  mass_ratio: Estimate | null;
  restitution: Estimate;
  collision_time: Estimate;
  contact_point: Vector | null;
  impulse: Vector;
  normal: Vector | null;
  bodies: BodyResult[];
  gravity?: Vector | null;
  effects: ActiveEffect[];
  noise?: { position: number; orientation: number | null; estimated: boolean; reason?: string | null } | null;
  alternatives?: Alternative[];
  outliers?: Outlier[];
  intervals?: string | null;
  fit: Fit;
  phases: Phase[];
  flags: string[];
  warnings: string[];
}

export interface ChannelTest {
  body: string;
  segment: Segment;
  channel: string;
  poses: number;
  rmse: number;
  rmse_in_sigma: number;
  z: number;
  p_value: number;
  pattern: string;
  fails: boolean;
}

export interface LedgerEntry {
  value: number[] | null;
  std: (number | null)[];
}

export interface LedgerLine {
  body: string | null;
  quantity: string;
  unit: string;
  before: LedgerEntry;
  after: LedgerEntry;
  change: LedgerEntry;
  change_in_sigma: number | null;
}

export interface ResultResiduals {
  name: string;
  preset: string;
  position_rmse: number | null;
  orientation_rmse: number | null;
  structure: ChannelTest[];
  findings: string[];
  outliers: Outlier[];
  ledger: { about: Vector; lines: LedgerLine[] };
  reason?: string | null;
}

export interface SeriesPoint {
  /** Counts the body's observations in order of time, as the scene lists them. */
  observation: number;
  time: number;
  value: number;
  segment: Segment;
}

export interface Series {
  body: string;
  axis: string;
  label: string;
  channel: Channel;
  sigma: number | null;
  points: SeriesPoint[];
}

export interface Track {
  times: number[];
  positions: Vector[];
  orientations: Quaternion[] | null;
  velocities: Vector[];
  spins: Vector[] | null;
}

export interface BodyMotion {
  name: string;
  before: Track;
  after: Track;
}

export interface Motion {
  collision_time: number;
  bodies: BodyMotion[];
}

export interface Model {
  name: string;
  result: Reconstruction;
  residuals: ResultResiduals;
  series: Series[];
  motion: Motion | null;
}

export type Shape = { type: 'box'; size: Vector } | { type: 'sphere'; radius: number };

export interface Observation {
  time: number;
  position: Vector;
  orientation: Quaternion | null;
}

export interface Body {
  name: string;
  shape: Shape;
  observations: Observation[];
}

export interface Plane {
  name: string;
  normal: Vector;
  height: number;
}

export interface Scene {
  name: string;
  up: Vector;
  gravity: number;
  fps: number | null;
  noise: { position: number; orientation: number } | null;
  camera: { position: Vector } | null;
  bodies: Body[];
  plane: Plane | null;
}

export interface QuantityEntry {
  value: number[] | null;
  std: (number | null)[];
  reason?: string | null;
}

export interface Quantity {
  quantity: string;
  unit: string;
  entries: QuantityEntry[];
  differences: { difference: number[] | null; size: number | null; in_sigma: number | null }[];
}

export interface Candidate {
  effect: string;
  body: string | null;
  delta_chi2: number;
  parameters_added: number;
  p_value: number;
  probability: number;
  stands_out: boolean;
  heldout_rmse_before: number | null;
  heldout_rmse_after: number | null;
  reduced_chi2: number | null;
  parameters: Record<string, ParameterEstimate>;
  indistinguishable_from: string[];
  shifts: { quantity: string; before: number; after: number; in_sigma: number | null }[];
}

export interface Unexplained {
  body: string;
  kind: 'acceleration' | 'torque';
  delta_chi2: number;
  rms: number;
  mean: Vector;
  forms: { goes_with: string; law: string; share: number; factor: number }[];
}

export type Verdict = 'nothing_missing' | 'missing' | 'unknown_effect';

export interface Diagnosis {
  verdict: Verdict;
  model: ActiveEffect[];
  reduced_chi2: number | null;
  candidates: Candidate[];
  probability_of_nothing: number;
  stays_structured: boolean;
  unexplained?: Unexplained[];
  explanation: string;
  advice: string[];
}

export interface Rung {
  added: string | null;
  with: string[];
  p_value: number | null;
  position_rmse: number;
  orientation_rmse: number | null;
  reduced_chi2: number | null;
  heldout_position_rmse: number | null;
  mass_ratio: number | null;
  restitution: number | null;
}

export interface Improvement {
  ladder: Rung[];
  dropped: string[];
  verdict: Verdict;
}

export interface Report {
  schema: 'smash.report/1';
  made_with: { smash: string; ceres: string };
  commands: string[];
  scene: Scene;
  noise: { position: number; orientation: number | null; from_result: string | null } | null;
  models: Model[];
  quantities: Quantity[];
  warnings: string[];
  diagnosis: Diagnosis | null;
  improvement: Improvement | null;
}
