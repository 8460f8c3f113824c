// Asks in the background what is missing, after each change; what comes too late is dropped.

import type { Diagnosis } from '../report';
import { api } from './api';
import type { Studio } from './studio';

const PAUSE_MS = 250;

export class Diagnoser {
  private under_way: AbortController | null = null;
  private timer = 0;
  private asked = -1;

  /** `tell` gets the diagnosis of what is shown; null while it is sought; or the error. */
  constructor(private readonly studio: Studio, private readonly tell: (answer: Diagnosis | Error | null) => void) {}

  ask(): void {
    const { revision } = this.studio.state.value;
    if (revision === this.asked) return;
    this.asked = revision;
    this.under_way?.abort();
    clearTimeout(this.timer);
    this.tell(null);
    this.timer = window.setTimeout(() => void this.fetch(revision), PAUSE_MS);
  }

  private async fetch(revision: number): Promise<void> {
    const request = new AbortController();
    this.under_way = request;
    try {
      const diagnosis = await api.diagnosis(request.signal);
      if (revision === this.studio.state.value.revision) this.tell(diagnosis);
    } catch (error) {
      if (request.signal.aborted) return;
      this.studio.heed(error);
      // After the connection is back it is asked again.
      this.asked = -1;
      if (revision === this.studio.state.value.revision) this.tell(error as Error);
    }
  }
}
