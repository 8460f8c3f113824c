// The same plot as SVG, for files and for paper: light, and with its own explanation.

import { short, significant } from '../numbers';
import { svg } from '../svg';
import { DASHES, RADIUS, triangle } from './marks';
import type { OtherModel, PlotData, PlotPoint } from './plot_data';

interface Frame {
  width: number;
  height: number;
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** A file explains itself; beside the page's own words the bare plot is enough. */
const ALONE: Frame = { width: 720, height: 260, left: 64, top: 44, right: 708, bottom: 210 };
const BARE: Frame = { width: 420, height: 150, left: 48, top: 8, right: 412, bottom: 126 };
const COLOURS = {
  ink: '#1b1f24',
  faint: '#8a9099',
  grid: '#e4e6ea',
  band: '#e3e3e3',
  before: '#0072b2',
  after: '#d55e00',
  alarm: '#000000',
};

export function plotFile(data: PlotData): SVGSVGElement {
  return drawn(data, ALONE, [
    words(`${data.title}: measured minus model, ${data.unit}`, { x: ALONE.left, y: 18, 'font-weight': 600 }),
    words(data.finding, { x: ALONE.left, y: 35, fill: COLOURS.faint }),
    ...legend(data, ALONE),
  ]);
}

export function barePlot(data: PlotData): SVGSVGElement {
  return drawn(data, BARE, []);
}

function drawn(data: PlotData, frame: Frame, explanation: SVGElement[]): SVGSVGElement {
  const x = scale(data.times, frame.left, frame.right);
  const y = scale(data.values, frame.bottom, frame.top);
  return svg(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      viewBox: `0 0 ${frame.width} ${frame.height}`,
      'font-family': 'system-ui, sans-serif',
      role: 'img',
      'aria-label': `Residuals of ${data.title}`,
    },
    svg('rect', { width: frame.width, height: frame.height, fill: '#ffffff' }),
    band(data, frame, y),
    ...ticks(data.values).map((value) => gridLine(value, frame, y(value))),
    ...ticks(data.times).map((time) =>
      words(`${short(time)} s`, { x: x(time), y: frame.bottom + 16, 'text-anchor': 'middle' }),
    ),
    data.impact === null ? null : impactLine(x(data.impact), frame),
    ...data.others.map((other, index) => otherLine(other, index, x, y)),
    marks(data, x, y),
    ...explanation,
  );
}

/** One by one: of a long film there are more than a call takes arguments. */
function marks(data: PlotData, x: (time: number) => number, y: (value: number) => number): SVGElement {
  const made = svg('g');
  for (const point of data.drawn) {
    if (data.sigma && point.noiseScale !== 1)
      made.append(bar(point, 2 * data.sigma * point.noiseScale, x, y));
    made.append(mark(point, x(point.time), y(point.value)));
  }
  return made;
}

function otherLine(
  { points, name }: OtherModel,
  index: number,
  x: (time: number) => number,
  y: (value: number) => number,
): SVGElement {
  const step = (at: number): string => (points[at - 1]?.segment === points[at].segment ? 'L' : 'M');
  return svg(
    'path',
    {
      d: points
        .map((point, at) => `${step(at)}${x(point.time).toFixed(2)} ${y(point.value).toFixed(2)}`)
        .join(''),
      fill: 'none',
      stroke: COLOURS.faint,
      'stroke-dasharray': DASHES[index].join(' ') || null,
    },
    svg('title', {}, name),
  );
}

/** The ±2 σ of a point with a noise of its own. */
function bar(
  point: PlotPoint,
  reach: number,
  x: (time: number) => number,
  y: (value: number) => number,
): SVGElement {
  const [at, top, bottom] = [x(point.time), y(point.value + reach), y(point.value - reach)];
  const foot = (end: number): string => `M${at - RADIUS} ${end}H${at + RADIUS}`;
  return svg('path', {
    d: `M${at} ${top}V${bottom}${foot(top)}${foot(bottom)}`,
    fill: 'none',
    stroke: COLOURS[point.segment],
  });
}

function words(text: string, at: Record<string, string | number>): SVGElement {
  return svg('text', { fill: COLOURS.ink, 'font-size': 12, ...at }, text);
}

function scale([low, high]: [number, number], from: number, to: number): (value: number) => number {
  return (value) => from + ((value - low) / (high - low || 1)) * (to - from);
}

/** Some four or five round numbers within. */
function ticks([low, high]: [number, number]): number[] {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((one) => one * power >= rough) ?? 10);
  const made: number[] = [];
  for (let at = Math.ceil(low / step); at * step <= high; at += 1) made.push(at * step);
  return made;
}

function band(data: PlotData, frame: Frame, y: (value: number) => number): SVGElement | null {
  if (!data.sigma) return null;
  const top = y(2 * data.sigma);
  return svg('rect', {
    x: frame.left,
    y: top,
    width: frame.right - frame.left,
    height: y(-2 * data.sigma) - top,
    fill: COLOURS.band,
  });
}

function gridLine(value: number, frame: Frame, y: number): SVGElement {
  return svg(
    'g',
    {},
    svg('line', {
      x1: frame.left,
      x2: frame.right,
      y1: y,
      y2: y,
      stroke: value === 0 ? COLOURS.faint : COLOURS.grid,
    }),
    svg(
      'text',
      { x: frame.left - 6, y: y + 4, 'text-anchor': 'end', 'font-size': 12, fill: COLOURS.ink },
      short(value),
    ),
  );
}

function impactLine(x: number, frame: Frame): SVGElement {
  return svg('line', {
    x1: x,
    x2: x,
    y1: frame.top,
    y2: frame.bottom,
    stroke: COLOURS.ink,
    'stroke-dasharray': '4 3',
  });
}

function mark(point: PlotPoint, x: number, y: number): SVGElement {
  const colour = COLOURS[point.segment];
  const fill = point.isMarked ? 'none' : colour;
  const shape =
    point.segment === 'before'
      ? svg('circle', { cx: x, cy: y, r: RADIUS, fill, stroke: colour })
      : svg('polygon', {
          points: triangle(x, y, RADIUS)
            .map((corner) => corner.map((v) => v.toFixed(2)).join())
            .join(' '),
          fill,
          stroke: colour,
        });
  const ring = svg('circle', {
    cx: x,
    cy: y,
    r: 2.2 * RADIUS,
    fill: 'none',
    stroke: COLOURS.alarm,
    'stroke-width': 2,
  });
  const far = 2 * RADIUS;
  const cross = svg('path', {
    d: `M${x - far} ${y - far}L${x + far} ${y + far}M${x - far} ${y + far}L${x + far} ${y - far}`,
    stroke: colour,
  });
  return svg('g', {}, shape, point.isOff ? ring : null, point.isMarked ? cross : null);
}

function legend(data: PlotData, frame: Frame): SVGElement[] {
  const y = frame.height - 14;
  const at = (x: number, words: string): SVGElement =>
    svg('text', { x, y: y + 4, 'font-size': 12, fill: COLOURS.ink }, words);
  const point = { observation: 0, time: 0, value: 0, noiseScale: 1, isOff: false, isMarked: false };
  return [
    mark({ ...point, segment: 'before' }, frame.left + 4, y),
    at(frame.left + 14, 'before the impact'),
    mark({ ...point, segment: 'after' }, frame.left + 134, y),
    at(frame.left + 144, 'after it'),
    ...(data.sigma
      ? [
          svg('rect', { x: frame.left + 208, y: y - 6, width: 16, height: 12, fill: COLOURS.band }),
          at(frame.left + 230, `±2 σ = ±${significant(2 * data.sigma, 3)} ${data.unit}`),
        ]
      : []),
  ];
}
