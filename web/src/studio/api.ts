// The studio's server, spoken to by JSON; all addresses are relative to the page's.

import type { Diagnosis } from '../report';
import type { Action, CheckedLaw, StudioState } from '../studio_state';

/** What the server refuses, in its own words. */
export class Refusal extends Error {
  constructor(
    readonly place: string | null,
    readonly problem: string,
    readonly mend: string | null,
    readonly status: number,
  ) {
    super(problem);
  }
}

/** Whether the server runs, but no longer at this page's address. */
export const isAway = ({ status }: Refusal): boolean => status === 403 || status === 404;

/** The server doesn't answer. */
export class ConnectionLost extends Error {}

export const api = {
  state: () => json<StudioState>('api/state'),
  revision: async () => (await json<{ revision: number }>('api/revision')).revision,
  act: (action: Action) => post<StudioState>('api/act', JSON.stringify(action)),
  /** Refused at the place `instead_of` where the server's draft is neither of both. */
  law: (draft: string, insteadOf: string) =>
    post<CheckedLaw>('api/law', JSON.stringify({ draft, instead_of: insteadOf })),
  /** Null where another variant is seen by now. */
  diagnosis: (signal: AbortSignal) => json<Diagnosis | null>('api/diagnosis', { signal }),
  openSession: (text: string) => post<StudioState>('api/session', text),
  file: async (name: 'report' | 'session') => (await answer(`api/${name}`)).blob(),
};

function post<T>(address: string, body: string): Promise<T> {
  return json<T>(address, {
    method: 'POST',
    body,
    headers: { 'Content-Type': 'application/json', 'X-Smash': '1' },
  });
}

async function json<T>(address: string, options?: RequestInit): Promise<T> {
  const response = await answer(address, options);
  try {
    return (await response.json()) as T;
  } catch {
    // It stopped in the middle of its answer.
    throw new ConnectionLost();
  }
}

async function answer(address: string, options?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(address, { cache: 'no-store', ...options });
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    throw new ConnectionLost();
  }
  if (response.ok) return response;
  throw await refusal(response);
}

async function refusal(response: Response): Promise<Refusal> {
  try {
    const { error } = (await response.json()) as { error: Omit<Refusal, 'status'> };
    return new Refusal(error.place ?? null, error.problem, error.mend ?? null, response.status);
  } catch {
    return new Refusal(
      null,
      `the server answers ${response.status} ${response.statusText}`,
      null,
      response.status,
    );
  }
}
