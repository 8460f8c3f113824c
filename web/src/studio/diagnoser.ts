// Asks in the background what is missing, after each change; what comes too late is dropped.

import type { Diagnosis } from '../report';
import { api } from './api';
import type { Studio } from './studio';

const PAUSE_MS = 250;

export class Diagnoser {
  private request: AbortController | null = null;
  private timer = 0;
  private hasFailed = false;

  /** `tell` gets the diagnosis of what is shown; null while it is sought; or the error. */
  constructor(
    private readonly studio: Studio,
    private readonly tell: (answer: Diagnosis | Error | null) => void,
  ) {}

  ask(): void {
    this.request?.abort();
    clearTimeout(this.timer);
    this.hasFailed = false;
    this.tell(null);
    this.timer = window.setTimeout(() => void this.fetch(), PAUSE_MS);
  }

  /** Where the connection was lost, once it is back. */
  askAgain(): void {
    if (this.hasFailed) this.ask();
  }

  private async fetch(): Promise<void> {
    const request = new AbortController();
    this.request = request;
    try {
      const diagnosis = await api.diagnosis(request.signal);
      // The variant was left meanwhile.
      if (diagnosis === null) await this.studio.look();
      if (request.signal.aborted) return;
      if (diagnosis === null) this.ask();
      else this.tell(diagnosis);
    } catch (error) {
      if (request.signal.aborted) return;
      this.hasFailed = true;
      this.tell(error as Error);
      this.studio.heed(error);
    }
  }
}
