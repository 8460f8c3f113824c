// The law that is being typed: kept in the browser until the server has it.

export interface Draft {
  text: string;
  /** Whether the server has it. */
  isSent: boolean;
}

export class DraftStore {
  constructor(private readonly key: string) {}

  /** Null where there is none, or where the browser keeps nothing. */
  read(): Draft | null {
    try {
      const kept = JSON.parse(localStorage.getItem(this.key) ?? 'null') as Partial<Draft> | null;
      return typeof kept?.text === 'string' ? { text: kept.text, isSent: kept.isSent === true } : null;
    } catch {
      return null;
    }
  }

  write(draft: Draft): void {
    try {
      localStorage.setItem(this.key, JSON.stringify(draft));
    } catch {
      // Private windows keep nothing; the server does.
    }
  }
}
