// What went wrong, said where it arose.

import { element } from '../element';
import { sentence } from '../words';
import { ConnectionLost, Refusal } from './api';

export class ErrorLine {
  readonly root = element('p', { class: 'error', role: 'alert', hidden: true, 'data-testid': 'error' });

  tell(error: unknown): void {
    this.root.textContent = inWords(error);
    this.root.hidden = false;
  }

  clear(): void {
    this.root.hidden = true;
    this.root.textContent = '';
  }
}

function inWords(error: unknown): string {
  if (error instanceof ConnectionLost) return 'Not done: smash doesn’t answer. Do it again when it is back.';
  if (error instanceof Refusal) {
    const place = error.place === null ? '' : `${error.place}: `;
    const mend = error.mend === null ? '' : ` ${sentence(error.mend)}`;
    return `${sentence(place + error.problem)}${mend}`;
  }
  return `Not done: ${String(error)}`;
}
