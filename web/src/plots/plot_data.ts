// What a residual plot draws, in the units that it is read in.

import { DEGREES, fixed, significant } from '../numbers';
import type { ChannelTest, Model, Series, Segment } from '../report';
import { singleOutliers } from '../outliers';
import { reading } from './axes';
import type { PoseActs } from './pose_acts';

export interface PlotPoint {
  observation: number;
  time: number;
  value: number;
  segment: Segment;
  /** Too far off to be noise. */
  isOff: boolean;
  /** Left out of the fit by the user. */
  isMarked: boolean;
}

export interface PlotData {
  key: string;
  body: string;
  channel: Series['channel'];
  title: string;
  reading: string;
  /** What the tests of randomness say of both sides. */
  finding: string;
  fails: boolean;
  unit: string;
  sigma: number | null;
  points: PlotPoint[];
  impact: number | null;
  /** The whole scene's times, the same in all plots. */
  times: [number, number];
  values: [number, number];
}

export function plotData(
  model: Model,
  series: Series,
  times: [number, number],
  acts: PoseActs | null,
): PlotData {
  const isTurn = series.channel === 'orientation';
  const scale = isTurn ? DEGREES : 1000;
  const off = singleOutliers(model).filter(
    (outlier) => outlier.body === series.body && outlier.channel === series.channel,
  );
  const sigma = typeof series.sigma === 'number' ? series.sigma * scale : null;
  const points = series.points.map((point) => {
    const value = point.value * scale;
    // A pose that is off may be well in place along this axis.
    const isOut = sigma === null || Math.abs(value) > 2 * sigma;
    return {
      ...point,
      value,
      isOff: isOut && off.some((outlier) => Math.abs(outlier.time - point.time) < 1e-9),
      isMarked: acts?.isMarked(series.body, point.observation) ?? false,
    };
  });
  const tests = (model.residuals.structure ?? []).filter(
    (test) => test.body === series.body && test.channel === series.axis,
  );
  return {
    key: `${series.body}/${series.axis}`,
    body: series.body,
    channel: series.channel,
    title: `${series.body}, ${series.label}`,
    reading: reading(
      series.body,
      series.axis,
      tests.some((test) => test.fails),
    ),
    finding: findings(tests),
    fails: tests.some((test) => test.fails),
    unit: isTurn ? '°' : 'mm',
    sigma,
    points,
    impact: model.motion?.collision_time ?? model.result.collision_time.value ?? null,
    times,
    values: range(
      points.map((point) => point.value),
      sigma,
    ),
  };
}

function findings(tests: ChannelTest[]): string {
  const size = (test: ChannelTest): string => `${significant(test.rmse_in_sigma, 2)} σ`;
  if (tests.length > 0 && !tests.some((test) => test.fails)) {
    return `Like noise: ${tests.map((test) => `${size(test)} ${test.segment}`).join(', ')}`;
  }
  const words = tests
    .map((test) => `${test.fails ? test.pattern : 'noise'} of ${size(test)} ${test.segment}`)
    .join(', ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Even about zero, with room, and never tighter than the band. */
function range(values: number[], sigma: number | null): [number, number] {
  const largest = values.reduce((most, value) => Math.max(most, Math.abs(value)), 2.6 * (sigma ?? 0));
  const half = largest > 0 && Number.isFinite(largest) ? 1.12 * largest : 1;
  return [-half, half];
}

/** A point in words, for the line under its plot. */
export function pointInWords(data: PlotData, point: PlotPoint): string {
  const value = data.unit === '°' ? `${significant(point.value)}°` : `${significant(point.value)} mm`;
  const sigmas = data.sigma ? ` (${significant(point.value / data.sigma, 2)} σ)` : '';
  const off = point.isMarked ? ', marked wrong' : point.isOff ? ', an outlier' : '';
  return `pose ${point.observation} at ${fixed(point.time, 4)} s: ${value}${sigmas}${off}`;
}
