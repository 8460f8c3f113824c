// The data of the studio, smash.studio/1, under the page's names; the types are made from the
// program's own schema.

import type { Action, CatalogueEffect, LawCheck, LawMistake } from './generated/studio';
import type { LawView, SmashStudio1, VariantView } from './generated/studio';
import type { Report } from './report';

/** The report is that of the other schema: one type for both pages. */
export type StudioState = Omit<SmashStudio1, 'report'> & { report: Report };
export type Variant = VariantView;
export type OwnLaw = LawView;
export type CheckedLaw = LawCheck;
export type Mistake = LawMistake;
export type { Action, CatalogueEffect };
