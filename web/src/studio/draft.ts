// Laws that were typed here and that the server may not have: kept in the browser.

export interface Draft {
  text: string;
  /** What the server had when this was begun. */
  base: string;
  /** When it was typed last, ms since 1970. */
  time: number;
}

interface Kept {
  /** To be sent as soon as the server answers. */
  unsent: Draft | null;
  /** Put aside: the server had another one by then. */
  aside: Draft[];
}

const MOST_ASIDE = 5;

/** The drafts of one session; windows of the same browser share them. */
export class DraftStore {
  private readonly key: string;
  private memory: Kept = { unsent: null, aside: [] };

  constructor(session: string) {
    this.key = `smash-law:${session}`;
  }

  get unsent(): Draft | null {
    return this.read().unsent;
  }

  get aside(): Draft[] {
    return this.read().aside;
  }

  /** Whether the browser keeps it. */
  keep(unsent: Draft): boolean {
    return this.write({ ...this.read(), unsent });
  }

  /** The server has it. */
  sent(text: string): void {
    const { unsent, aside } = this.read();
    if (unsent?.text === text) this.write({ unsent: null, aside });
  }

  putAside(draft: Draft): void {
    this.sent(draft.text);
    const { unsent, aside } = this.read();
    const others = aside.filter(({ text }) => text !== draft.text);
    this.write({ unsent, aside: [draft, ...others].slice(0, MOST_ASIDE) });
  }

  discard(draft: Draft): void {
    const { unsent, aside } = this.read();
    this.write({ unsent, aside: aside.filter(({ text }) => text !== draft.text) });
  }

  private read(): Kept {
    try {
      const kept = JSON.parse(localStorage.getItem(this.key) ?? 'null') as Partial<Kept> | null;
      if (kept === null) return this.memory;
      const aside = Array.isArray(kept.aside) ? kept.aside.filter(isDraft) : [];
      return { unsent: isDraft(kept.unsent) ? kept.unsent : null, aside };
    } catch {
      return this.memory;
    }
  }

  private write(kept: Kept): boolean {
    this.memory = kept;
    try {
      localStorage.setItem(this.key, JSON.stringify(kept));
      return true;
    } catch {
      // Some private windows keep nothing.
      return false;
    }
  }
}

function isDraft(found: unknown): found is Draft {
  const { text, base, time } = (found ?? {}) as Partial<Draft>;
  return typeof text === 'string' && typeof base === 'string' && typeof time === 'number';
}
