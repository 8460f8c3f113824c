// The data of a report, smash.report/1, under the page's names; the types are made from the
// program's own schema.

import type {
  ActiveEffect,
  BodyMotion,
  BodyView,
  CandidateReport,
  ChannelTest,
  Difference,
  Estimate,
  LedgerEntry,
  LedgerLine,
  ModelView,
  Outlier,
  ParameterEstimate,
  Quantity,
  ResidualPoint,
  ResidualSeries,
  Rung,
  SceneView,
  SmashDiagnosis1,
  SmashImprovement1,
  SmashReport1,
  Track,
  Unexplained,
} from './generated/report';

export type Vector = [number, number, number];
export type Quaternion = [number, number, number, number];
export type Segment = ResidualPoint['segment'];
export type Report = SmashReport1;
export type Scene = SceneView;
export type Body = BodyView;
export type Shape = BodyView['shape'];
export type Model = ModelView;
export type Series = ResidualSeries;
export type QuantityEntry = Quantity['entries'][number];
export type Diagnosis = SmashDiagnosis1;
export type Candidate = CandidateReport;
export type Improvement = SmashImprovement1;
export type {
  ActiveEffect,
  BodyMotion,
  ChannelTest,
  Difference,
  Estimate,
  LedgerEntry,
  LedgerLine,
  Outlier,
  ParameterEstimate,
  Quantity,
  Rung,
  Track,
  Unexplained,
};
