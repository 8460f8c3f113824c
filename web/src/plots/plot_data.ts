// What a residual plot draws, in the units that it is read in.

import { DEGREES, fixed, significant } from '../numbers';
import type { ChannelTest, Model, Series, Segment } from '../report';
import { reading } from './axes';

export interface PlotPoint {
  observation: number;
  time: number;
  value: number;
  segment: Segment;
  /** Too far off to be noise. */
  isOff: boolean;
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

export function plotData(model: Model, series: Series, times: [number, number]): PlotData {
  const isTurn = series.channel === 'orientation';
  const scale = isTurn ? DEGREES : 1000;
  const off = model.residuals.outliers.filter(
    (outlier) => outlier.body === series.body && outlier.channel === series.channel,
  );
  const points = series.points.map((point) => ({
    ...point,
    value: point.value * scale,
    isOff: off.some((outlier) => Math.abs(outlier.time - point.time) < 1e-9),
  }));
  const sigma = series.sigma === null ? null : series.sigma * scale;
  const tests = model.residuals.structure.filter(
    (test) => test.body === series.body && test.channel === series.axis,
  );
  return {
    key: `${series.body}/${series.axis}`,
    body: series.body,
    channel: series.channel,
    title: `${series.body}, ${series.label}`,
    reading: reading(series.body, series.axis),
    finding: findings(tests),
    fails: tests.some((test) => test.fails),
    unit: isTurn ? '°' : 'mm',
    sigma,
    points,
    impact: model.motion?.collision_time ?? model.result.collision_time.value,
    times,
    values: range(points.map((point) => point.value), sigma),
  };
}

function findings(tests: ChannelTest[]): string {
  const words = tests.map((test) => {
    const size = `${significant(test.rmse_in_sigma, 2)} σ`;
    return test.fails ? `${test.segment}: ${test.pattern}, ${size}` : `${test.segment}: like noise, ${size}`;
  });
  return words.join('; ');
}

/** Even about zero, with room, and never tighter than the band. */
function range(values: number[], sigma: number | null): [number, number] {
  const largest = Math.max(...values.map(Math.abs), 2.6 * (sigma ?? 0));
  const half = largest > 0 && Number.isFinite(largest) ? 1.12 * largest : 1;
  return [-half, half];
}

/** A point in words, for the line under its plot. */
export function pointInWords(data: PlotData, point: PlotPoint): string {
  const value = data.unit === '°' ? `${significant(point.value)}°` : `${significant(point.value)} mm`;
  const sigmas = data.sigma ? ` (${significant(point.value / data.sigma, 2)} σ)` : '';
  const off = point.isOff ? ', an outlier' : '';
  return `pose ${point.observation + 1} at ${fixed(point.time, 4)} s: ${value}${sigmas}${off}`;
}
