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
  /** Its own σ over the plot's. */
  noiseScale: number;
  /** Too far off to be noise. */
  isOff: boolean;
  /** Left out of the fit by the user. */
  isMarked: boolean;
}

/** What another model leaves of the same poses. */
export interface OtherModel {
  name: string;
  points: { time: number; value: number; segment: Segment }[];
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
  /** Those that are drawn: of long films every so many, and all that are told apart. */
  drawn: PlotPoint[];
  /** Drawn as lines, to compare with. */
  others: OtherModel[];
  impact: number | null;
  /** The whole scene's times, the same in all plots. */
  times: [number, number];
  values: [number, number];
}

/** More points lie on each other, and are slow. */
const MOST_DRAWN = 4000;

const isApart = (point: PlotPoint): boolean => point.isOff || point.isMarked || point.noiseScale !== 1;

export function plotData(
  model: Model,
  series: Series,
  times: [number, number],
  acts: PoseActs | null,
  compared: Model[],
): PlotData {
  const isTurn = series.channel === 'orientation';
  const scale = isTurn ? DEGREES : 1000;
  const off = new Set(
    singleOutliers(model)
      .filter((outlier) => outlier.body === series.body && outlier.channel === series.channel)
      .map((outlier) => outlier.time),
  );
  const sigma = typeof series.sigma === 'number' ? series.sigma * scale : null;
  const points = series.points.map((point) => {
    const value = point.value * scale;
    // A pose that is off may be well in place along this axis.
    const isOut = sigma === null || Math.abs(value) > 2 * sigma * (point.noise_scale ?? 1);
    return {
      ...point,
      value,
      noiseScale: point.noise_scale ?? 1,
      isOff: isOut && off.has(point.time),
      isMarked: acts?.isMarked(series.body, point.observation) ?? false,
    };
  });
  const stride = Math.ceil(points.length / MOST_DRAWN);
  const others = compared.map((other): OtherModel => {
    const same = other.series.find((one) => one.body === series.body && one.axis === series.axis);
    const seen = (same?.points ?? [])
      .filter((_, at) => at % stride === 0)
      .map((point) => ({ ...point, value: point.value * scale }));
    return { name: other.name, points: seen };
  });
  const tests = (model.residuals.structure ?? []).filter(
    (test) => test.body === series.body && test.channel === series.axis,
  );
  return {
    key: `${series.body}/${series.axis}`,
    body: series.body,
    channel: series.channel,
    title: `${series.body}, ${series.label}`,
    reading:
      reading(
        series.body,
        series.axis,
        tests.some((test) => test.fails),
      ) +
      (stride > 1 ? ` Of ${points.length} poses one in ${stride} is drawn, and all that are marked.` : ''),
    finding: findings(tests),
    fails: tests.some((test) => test.fails),
    unit: isTurn ? '°' : 'mm',
    sigma,
    points,
    drawn: points.filter((point, at) => at % stride === 0 || isApart(point)),
    others,
    impact: model.motion?.collision_time ?? model.result.collision_time.value ?? null,
    times,
    values: range(
      [points, ...others.map((other) => other.points)].flatMap((seen) => seen.map(({ value }) => value)),
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
  const half = largest > 0 && Number.isFinite(largest) ? 1.25 * largest : 1;
  return [-half, half];
}

/** A point in words, for the line under its plot. */
export function pointInWords(data: PlotData, point: PlotPoint): string {
  const value = data.unit === '°' ? `${significant(point.value)}°` : `${significant(point.value)} mm`;
  const sigmas = data.sigma ? ` (${significant(point.value / (data.sigma * point.noiseScale), 2)} σ)` : '';
  const own = point.noiseScale === 1 ? '' : `, noise × ${significant(point.noiseScale, 2)}`;
  const off = point.isMarked ? ', marked wrong' : point.isOff ? ', an outlier' : '';
  return `pose ${point.observation} at ${fixed(point.time, 4)} s: ${value}${sigmas}${own}${off}`;
}
