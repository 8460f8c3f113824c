// Paints bands, lines and points of a residual plot on uPlot's canvas.

import type uPlot from 'uplot';
import { palette } from '../stage/palette';
import type { PlotData, PlotPoint } from './plot_data';
import { DASHES, RADIUS, trace } from './marks';

/** Below the grid: the band of ±2 σ. */
export function paintBand(plot: uPlot, data: PlotData): void {
  if (!data.sigma) return;
  const { left, width } = plot.bbox;
  const [top, bottom] = [2, -2].map((times) => plot.valToPos(times * (data.sigma ?? 0), 'y', true));
  plot.ctx.save();
  plot.ctx.fillStyle = palette().band;
  plot.ctx.fillRect(left, top, width, bottom - top);
  plot.ctx.restore();
}

/** Above the grid: zero, the impact, and the points. */
export function paintPoints(plot: uPlot, data: PlotData): void {
  const { ctx: context, bbox } = plot;
  const colours = palette();
  const pixel = window.devicePixelRatio || 1;
  context.save();
  context.lineWidth = pixel;
  context.strokeStyle = colours.faint;
  const zero = plot.valToPos(0, 'y', true);
  stroke(context, bbox.left, zero, bbox.left + bbox.width, zero);
  if (data.impact !== null) {
    const x = plot.valToPos(data.impact, 'x', true);
    context.strokeStyle = colours.ink;
    context.setLineDash([4 * pixel, 3 * pixel]);
    stroke(context, x, bbox.top, x, bbox.top + bbox.height);
    context.setLineDash([]);
  }
  data.others.forEach(({ points }, index) => {
    context.strokeStyle = colours.quiet;
    context.lineWidth = 1.3 * pixel;
    context.setLineDash(DASHES[index].map((length) => length * pixel));
    context.beginPath();
    points.forEach((point, at) => {
      const [x, y] = [plot.valToPos(point.time, 'x', true), plot.valToPos(point.value, 'y', true)];
      if (points[at - 1]?.segment === point.segment) context.lineTo(x, y);
      else context.moveTo(x, y);
    });
    context.stroke();
  });
  context.setLineDash([]);
  for (const point of data.drawn) {
    const [x, y] = [plot.valToPos(point.time, 'x', true), plot.valToPos(point.value, 'y', true)];
    context.strokeStyle = point.segment === 'before' ? colours.before : colours.after;
    context.lineWidth = 1.2 * pixel;
    if (data.sigma && point.noiseScale !== 1) bar(plot, context, point, 2 * data.sigma * point.noiseScale);
    context.beginPath();
    trace(context, point.segment, x, y, RADIUS * pixel);
    context.fillStyle = context.strokeStyle;
    if (point.isMarked) strike(context, x, y, 2 * RADIUS * pixel);
    else context.fill();
    if (!point.isOff) continue;
    context.beginPath();
    context.arc(x, y, 2 * RADIUS * pixel, 0, 2 * Math.PI);
    context.strokeStyle = colours.alarm;
    context.lineWidth = 1.2 * pixel;
    context.stroke();
  }
  context.restore();
}

/** The ±2 σ of a point with a noise of its own. */
function bar(plot: uPlot, context: CanvasRenderingContext2D, point: PlotPoint, reach: number): void {
  const x = plot.valToPos(point.time, 'x', true);
  const foot = RADIUS * (window.devicePixelRatio || 1);
  const [top, bottom] = [1, -1].map((side) => plot.valToPos(point.value + side * reach, 'y', true));
  stroke(context, x, top, x, bottom);
  for (const end of [top, bottom]) stroke(context, x - foot, end, x + foot, end);
}

/** The outline of a point that is left out, crossed. */
function strike(context: CanvasRenderingContext2D, x: number, y: number, reach: number): void {
  context.stroke();
  stroke(context, x - reach, y - reach, x + reach, y + reach);
  stroke(context, x - reach, y + reach, x + reach, y - reach);
}

function stroke(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}
