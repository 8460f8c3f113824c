// What the studio shows, and the one way to change it: acts, one after the other.

import { Signal } from '../signal';
import type { Action, StudioState } from '../studio_state';
import { api, ConnectionLost, isAway, Refusal } from './api';
import type { ErrorLine } from './error_line';

/** Whether the server answers; `refused` where it does, but no longer to this page's address. */
export type Connection = 'there' | 'lost' | 'refused';

const POLL_MS = 3000;
const LONGEST_WAIT_MS = 10_000;

export class Studio {
  readonly state: Signal<StudioState>;
  readonly connection = new Signal<Connection>('there');
  /** How many acts are under way. */
  readonly busy = new Signal(0);
  /** Errors that are still to be seen: until something succeeds. */
  private readonly told = new Set<ErrorLine>();
  private queue: Promise<unknown> = Promise.resolve();
  private wait = POLL_MS;
  private retry = 0;

  constructor(state: StudioState) {
    this.state = new Signal(state);
    this.pollLater();
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden) void this.poll();
    });
  }

  /** Does it, shows what came of it, and tells at `line` what went wrong. */
  act(action: Action, line: ErrorLine): Promise<boolean> {
    return this.change(() => api.act(action), line);
  }

  openSession(text: string, line: ErrorLine): Promise<boolean> {
    return this.change(() => api.openSession(text), line);
  }

  private change(request: () => Promise<StudioState>, line: ErrorLine): Promise<boolean> {
    this.busy.set(this.busy.value + 1);
    const done = this.queue.then(async () => {
      try {
        this.take(await request());
        for (const told of this.told) told.clear();
        this.told.clear();
        return true;
      } catch (error) {
        line.tell(error);
        this.told.add(line);
        this.heed(error);
        return false;
      } finally {
        this.busy.set(this.busy.value - 1);
      }
    });
    this.queue = done;
    return done;
  }

  private take(state: StudioState): void {
    this.answered();
    // An answer that was overtaken says less than what is shown. A server that was started anew, and
    // counts anew, has another address.
    if (state.revision > this.state.value.revision) this.state.set(state);
  }

  /** What any request's failure means for the connection. */
  heed(error: unknown): void {
    if (error instanceof ConnectionLost) this.connection.set('lost');
    else if (error instanceof Refusal && isAway(error)) this.connection.set('refused');
    else return;
    this.wait = 500;
    this.pollLater();
  }

  private answered(): void {
    this.wait = POLL_MS;
    this.connection.set('there');
  }

  private pollLater(): void {
    clearTimeout(this.retry);
    this.retry = window.setTimeout(() => void this.poll(), this.wait);
  }

  /** Whether what is shown is what the server has, which another browser may have changed. */
  async look(): Promise<boolean> {
    try {
      const isNewer = (await api.revision()) > this.state.value.revision;
      if (isNewer) this.take(await api.state());
      else this.answered();
      return true;
    } catch (error) {
      this.heed(error);
      return false;
    }
  }

  private async poll(): Promise<void> {
    const wasAway = this.connection.value !== 'there';
    const longer = Math.min(2 * this.wait, LONGEST_WAIT_MS);
    if (!(await this.look()) && wasAway) this.wait = longer;
    this.pollLater();
  }
}
