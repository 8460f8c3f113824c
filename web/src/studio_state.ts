// The data of the studio, smash.studio/1, by hand until `smash schema studio` is there.

import type { Report } from './report';

export interface Variant {
  id: number;
  parent: number | null;
  did: string;
  effects: string[];
  position_rmse: number;
  orientation_rmse: number | null;
  reduced_chi2: number | null;
  chi2: number | null;
  mass_ratio: number | null;
  restitution: number | null;
  milliseconds: number;
}

export interface CatalogueEffect {
  name: string;
  title: string;
  looks_like: string;
  tell_apart: string;
  labels: string[];
}

export interface OwnLaw {
  name: string;
  text: string;
  labels: string[];
}

export interface Edits {
  marked: { body: string; observation: number }[];
  times: { body: string; observation: number; time: number }[];
  noise: { position: number; orientation: number } | null;
}

export interface StudioState {
  schema: 'smash.studio/1';
  revision: number;
  session_file: string;
  current: number;
  undo: number | null;
  redo: number | null;
  variants: Variant[];
  compared: number[];
  edits: Edits;
  catalogue: CatalogueEffect[];
  laws: OwnLaw[];
  draft: string;
  report: Report;
}

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
