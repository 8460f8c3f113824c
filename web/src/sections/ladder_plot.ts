// The ladder as bars: error and held-out error of each rung, relative to the first one's.

import { length } from '../numbers';
import type { Rung } from '../report';
import { svg } from '../svg';

const [WIDTH, ROW, LEFT, RIGHT] = [720, 46, 190, 620];

export function ladderPlot(rungs: Rung[]): SVGSVGElement {
  const height = rungs.length * ROW + 26;
  const largest = Math.max(
    ...rungs.flatMap((rung) => [rung.position_rmse, rung.heldout_position_rmse ?? 0]),
    1e-12,
  );
  const rows = rungs.flatMap((rung, index) => [
    svg(
      'text',
      { x: LEFT - 10, y: index * ROW + 26, 'text-anchor': 'end', 'font-size': 13, fill: 'currentColor' },
      !rung.added ? 'start' : `+ ${rung.added}`,
    ),
    ...bar(rung.position_rmse, largest, index * ROW + 6, '#0072b2', 'error'),
    ...(typeof rung.heldout_position_rmse === 'number'
      ? bar(rung.heldout_position_rmse, largest, index * ROW + 24, '#e69f00', 'held out')
      : []),
  ]);
  return svg(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      viewBox: `0 0 ${WIDTH} ${height}`,
      role: 'img',
      class: 'ladder-plot',
      'font-family': 'system-ui, sans-serif',
      'aria-label': 'Error of each rung of the ladder',
    },
    ...rows,
  );
}

function bar(value: number, largest: number, y: number, fill: string, words: string): SVGElement[] {
  const width = Math.max(1, (value / largest) * (RIGHT - LEFT - 90));
  return [
    svg('rect', { x: LEFT, y, width, height: 14, fill }),
    svg(
      'text',
      { x: LEFT + width + 6, y: y + 11.5, 'font-size': 12, fill: 'currentColor' },
      `${words} ${length(value)}`,
    ),
  ];
}
