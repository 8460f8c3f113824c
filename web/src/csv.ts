// Tables as CSV.

import type { Report } from './report';

/** All residuals of all models, in m and rad. */
export function residualsCsv(report: Report): string {
  const rows: (string | number)[][] = [
    ['model', 'body', 'axis', 'channel', 'pose', 'time_s', 'segment', 'residual', 'unit', 'sigma'],
  ];
  for (const model of report.models) {
    for (const series of model.series) {
      const unit = series.channel === 'orientation' ? 'rad' : 'm';
      for (const point of series.points) {
        rows.push([
          model.name,
          series.body,
          series.axis,
          series.channel,
          point.observation,
          point.time,
          point.segment,
          point.value,
          unit,
          series.sigma ?? '',
        ]);
      }
    }
  }
  return rows.map((row) => row.map(field).join(',')).join('\n') + '\n';
}

/** Quoted where needed; a name that a spreadsheet would compute is kept a text. */
function field(value: string | number): string {
  if (typeof value === 'number') return String(value);
  const text = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
