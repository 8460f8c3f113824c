// Says that the server is gone, as long as it is.

import { element } from '../element';
import type { Studio } from './studio';

const WORDS = {
  lost:
    'smash doesn’t answer: it was stopped, or is busy. This page tries again by itself; what you did is saved. ' +
    'A law that you type now is kept by this browser until then; in a private window copy it. ' +
    'If it was stopped, start smash studio again with the same scene, and open the address that it prints.',
  refused:
    'smash runs, but under another address: it was started again. Open the address that it printed; the session is there.',
};

export function banner(studio: Studio): HTMLElement {
  const root = element('p', { class: 'banner', role: 'alert', 'data-testid': 'banner', hidden: true });
  studio.connection.watch((connection) => {
    root.hidden = connection === 'there';
    root.textContent = connection === 'there' ? '' : WORDS[connection];
  });
  return root;
}
