// The data of a report, smash.report/1, under the page's names; the types are made from the
// program's own schema.

import type {
  ActiveEffect, Alternative, BodyMotion, BodyResult, BodyView, CandidateReport, ChannelTest, Estimate, LedgerEntry,
  LedgerLine, ModelView, Motion, ObservationView, Outlier, ParameterEstimate, Quantity, ResidualPoint,
  ResidualSeries, ResultResiduals, Rung, SceneView, SmashDiagnosis1, SmashImprovement1, SmashReport1, Track,
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
  ActiveEffect, Alternative, BodyMotion, BodyResult, ChannelTest, Estimate, LedgerEntry, LedgerLine, Motion,
  ObservationView, Outlier, ParameterEstimate, Quantity, ResultResiduals, Rung, Track, Unexplained,
};
