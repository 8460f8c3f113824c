// The data of the studio, smash.studio/1, under the page's names; the types are made from the
// program's own schema. What is sent there is small, and written by hand.

import type { CatalogueEffect, LawView, SmashStudio1, VariantView } from './generated/studio';
import type { Report } from './report';

/** The report is that of the other schema: one type for both pages. */
export type StudioState = Omit<SmashStudio1, 'report'> & { report: Report };
export type Variant = VariantView;
export type OwnLaw = LawView;
export type { CatalogueEffect };
export type Action =
  | { do: 'add'; effect: string }
  | { do: 'remove'; effect: string }
  | { do: 'law'; text: string; effect: string }
  | { do: 'mark'; body: string; observation: number; wrong: boolean }
  | { do: 'time'; body: string; observation: number; time: number }
  | { do: 'noise'; position?: number; orientation?: number }
  | { do: 'undo' }
  | { do: 'redo' }
  | { do: 'go'; variant: number }
  | { do: 'compare'; variant: number; shown: boolean };

export interface Mistake {
  line: number;
  column: number;
  length: number;
  problem: string;
  mend: string | null;
}

export interface CheckedLaw {
  effect: { name: string; title: string; labels: string[] } | null;
  mistakes: Mistake[];
  revision: number;
}
