// Which poses are wrong, rather than the model.

import type { Model, Outlier } from './report';

/** The outliers; none where every third pose is one: then the model is at fault, not the poses. */
export function singleOutliers(model: Model): Outlier[] {
  const outliers = model.residuals.outliers ?? [];
  const poses = new Set(
    model.series.flatMap((series) => series.points.map((point) => `${series.body} ${point.observation}`)),
  );
  const off = new Set(outliers.map((outlier) => `${outlier.body} ${outlier.time}`));
  return off.size * 3 > poses.size && off.size > 2 ? [] : outliers;
}
