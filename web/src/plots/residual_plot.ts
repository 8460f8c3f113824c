// One residual plot: points over time, the band of the noise, the impact, and the moment's cursor.

import uPlot from 'uplot';
import type { Clock } from '../clock';
import { element, freshId } from '../element';
import { short } from '../numbers';
import { save, saveCanvas } from '../save';
import { palette } from '../stage/palette';
import { svgFile } from '../svg';
import { paintBand, paintPoints } from './painter';
import type { PlotData, PlotPoint } from './plot_data';
import { pointInWords } from './plot_data';
import { Pointer } from './pointer';
import type { PoseActs } from './pose_acts';
import { savers } from './savers';
import { barePlot, plotFile } from './svg_plot';

const HEIGHT = 132;

export class ResidualPlot {
  readonly root: HTMLElement;
  private readonly plot: uPlot;
  private readonly title = element('span', { class: 'plot-title' });
  private readonly finding = element('span', { class: 'plot-finding' });
  private readonly reading = element('span');
  private readonly readout = element('p', { class: 'plot-readout', 'aria-live': 'off' });
  private readonly cursor = element('div', { class: 'plot-cursor', 'data-testid': 'plot-cursor' });
  private readonly paper = element('div', { class: 'plot-paper' });
  private isTelling = false;
  private readonly resized: ResizeObserver;
  private readonly unwatch: () => void;
  private readonly print = (): void => this.paper.replaceChildren(barePlot(this.data));

  constructor(
    private data: PlotData,
    private readonly clock: Clock,
    acts: PoseActs | null,
  ) {
    const holder = element('div', { class: 'plot-canvas' });
    const readingId = freshId('reading');
    this.root = element(
      'figure',
      { class: 'plot', 'data-testid': 'residual-plot', 'data-key': data.key },
      element('figcaption', {}, this.title, this.savers()),
      element('p', { class: 'hint', id: readingId }, this.finding, this.reading),
      holder,
      this.paper,
      this.readout,
    );
    this.plot = new uPlot(this.options(holder), columns(data), holder);
    const { over } = this.plot;
    over.append(this.cursor);
    over.tabIndex = 0;
    over.setAttribute('role', 'img');
    over.setAttribute('aria-describedby', readingId);
    new Pointer(
      this.plot,
      clock,
      () => this.data,
      acts,
      (words) => this.readOut(words),
    );
    over.addEventListener('keydown', (event) => this.step(event));
    this.resized = new ResizeObserver(() => this.fit(holder));
    this.resized.observe(holder);
    this.unwatch = clock.time.watch((time) => this.follow(time));
    window.addEventListener('beforeprint', this.print);
    this.tell();
  }

  /** It follows nothing any more. */
  end(): void {
    this.unwatch();
    this.resized.disconnect();
    window.removeEventListener('beforeprint', this.print);
    this.plot.destroy();
  }

  /** Shows other data of the same body and axis. */
  show(data: PlotData): void {
    this.data = data;
    this.plot.setData(columns(data));
    this.tell();
    this.follow(this.clock.time.value);
  }

  repaint(): void {
    this.plot.redraw();
  }

  private tell(): void {
    const { data } = this;
    this.title.textContent = `${data.title}, ${data.unit}`;
    this.finding.textContent = data.finding === '' ? '' : `${data.finding}. `;
    this.root.classList.toggle('fails', data.fails);
    this.reading.textContent = data.reading;
    this.plot.over.setAttribute('aria-label', `Residuals of ${data.title}. ${data.finding}`);
  }

  private savers(): HTMLElement {
    const name = (ending: string): string => `residuals_${this.data.title}.${ending}`;
    return savers(
      {
        format: 'SVG',
        test: 'save-svg',
        save: () => save(name('svg'), 'image/svg+xml', svgFile(plotFile(this.data))),
      },
      { format: 'PNG', test: 'save-png', save: () => saveCanvas(this.plot.ctx.canvas, name('png')) },
    );
  }

  private options(holder: HTMLElement): uPlot.Options {
    const ink = (): string => palette().ink;
    const grid = { stroke: (): string => palette().grid, width: 1 };
    const font = '11px system-ui, sans-serif';
    return {
      width: Math.max(holder.clientWidth, 200),
      height: HEIGHT,
      padding: [6, 8, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: () => this.data.times },
        y: { range: () => this.data.values },
      },
      axes: [
        {
          stroke: ink,
          grid,
          font,
          size: 28,
          ticks: { show: false },
          values: (_, splits) => splits.map((split) => `${short(split)} s`),
        },
        {
          stroke: ink,
          grid,
          font,
          size: 48,
          space: 24,
          ticks: { show: false },
          values: (_, splits) => splits.map(short),
        },
      ],
      series: [{}, { show: true, paths: () => null, points: { show: false } }],
      hooks: {
        drawClear: [(plot) => paintBand(plot, this.data)],
        draw: [(plot) => paintPoints(plot, this.data)],
      },
    };
  }

  private fit(holder: HTMLElement): void {
    if (holder.clientWidth === 0) return;
    this.plot.setSize({ width: holder.clientWidth, height: HEIGHT });
    this.follow(this.clock.time.value);
  }

  private step(event: KeyboardEvent): void {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    this.clock.step(event.key === 'ArrowLeft' ? -1 : 1);
  }

  private follow(time: number): void {
    const x = this.plot.valToPos(time, 'x');
    if (Number.isFinite(x)) this.cursor.style.transform = `translateX(${x.toFixed(1)}px)`;
    if (!this.isTelling) this.readOut(null);
  }

  /** What a drag would do, or the pose nearest to the moment. */
  private readOut(words: string | null): void {
    this.isTelling = words !== null;
    const near = nearest(this.data.points, this.clock.time.value);
    this.readout.textContent = words ?? (near === null ? '' : pointInWords(this.data, near));
  }
}

function nearest(points: PlotPoint[], time: number): PlotPoint | null {
  let best: PlotPoint | null = null;
  for (const point of points) {
    if (best === null || Math.abs(point.time - time) < Math.abs(best.time - time)) best = point;
  }
  return best;
}

function columns(data: PlotData): uPlot.AlignedData {
  return [data.points.map((point) => point.time), data.points.map((point) => point.value)];
}
