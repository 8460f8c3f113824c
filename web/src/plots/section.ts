// The residual plots of the shown model: by body, an axis a plot.

import type { Clock } from '../clock';
import { element, refill } from '../element';
import type { Child } from '../element';
import type { Model, Scene } from '../report';
import { svg } from '../svg';
import { DASHES } from './marks';
import { plotData } from './plot_data';
import type { PlotData } from './plot_data';
import type { PoseActs } from './pose_acts';
import { ResidualPlot } from './residual_plot';

export class ResidualsSection {
  readonly root = element('div', { class: 'residuals' });
  private readonly legend = element('p', { class: 'hint plots-legend' });
  private plots = new Map<string, ResidualPlot>();

  constructor(
    private readonly clock: Clock,
    private readonly acts: PoseActs | null,
  ) {}

  /** `others` are drawn as lines in the same plots. */
  show(scene: Scene, model: Model | null, others: Model[]): void {
    const compared = others.slice(0, DASHES.length);
    const times: [number, number] = [this.clock.start, this.clock.end];
    const margin = 0.03 * (times[1] - times[0]);
    const all = (model?.series ?? [])
      .filter((series) => series.points.length > 0)
      .map((series) =>
        plotData(model as Model, series, [times[0] - margin, times[1] + margin], this.acts, compared),
      );
    const isSame = all.length === this.plots.size && all.every((data) => this.plots.has(data.key));
    if (isSame && all.length > 0) {
      for (const data of all) this.plots.get(data.key)?.show(data);
    } else {
      this.rebuild(scene, model, all);
    }
    refill(this.legend, ...legend(this.acts !== null, compared));
  }

  repaint(): void {
    for (const plot of this.plots.values()) plot.repaint();
  }

  private rebuild(scene: Scene, model: Model | null, all: PlotData[]): void {
    for (const plot of this.plots.values()) plot.end();
    this.plots = new Map(all.map((data) => [data.key, new ResidualPlot(data, this.clock, this.acts)]));
    const groups = scene.bodies.map((body) => {
      const own = all.filter((data) => data.body === body.name);
      return element(
        'section',
        { class: 'plots-of-body' },
        element('h3', {}, body.name),
        ...own.map((data) => this.plots.get(data.key)?.root ?? null),
        own.length === 0 && element('p', { class: 'hint' }, 'No residuals: ', missing(model)),
      );
    });
    this.root.replaceChildren(this.legend, ...groups);
  }
}

function legend(canMark: boolean, compared: Model[]): Child[] {
  const key = (side: string, shape: string): HTMLElement =>
    element('span', { class: side, 'aria-hidden': 'true' }, shape);
  const lines = compared.flatMap((model, index): Child[] => [
    index === 0 ? 'Lines: ' : ', ',
    svg(
      'svg',
      { viewBox: '0 0 30 8', class: 'line-key', 'aria-hidden': 'true' },
      svg('path', {
        d: 'M0 4H30',
        stroke: 'currentColor',
        'stroke-width': 1.3,
        'stroke-dasharray': DASHES[index].join(' ') || null,
      }),
    ),
    ` ${model.name}`,
  ]);
  return [
    key('before', '●'),
    ' before and ',
    key('after', '▲'),
    ' after the impact (dashed line), ◎ outliers',
    canMark ? ', ✕ marked wrong. ' : '. ',
    ...lines,
    lines.length > 0 ? '. ' : '',
    'Point at a plot: 3D shows that moment, and the cursor follows in all plots.',
  ];
}

function missing(model: Model | null): string {
  return model?.residuals.reason ?? 'the result tells no motion to hold the poses against.';
}
