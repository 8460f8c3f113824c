// Light or dark: the system's choice, or one's own.

import { element } from './element';

const THEMES = ['auto', 'light', 'dark'] as const;
const WORDS = { auto: 'Colours: auto', light: 'Light', dark: 'Dark' };

/** Does something while the page is light, whatever it was. */
export function inLight(act: () => void): void {
  const { dataset } = document.documentElement;
  const chosen = dataset.theme;
  dataset.theme = 'light';
  act();
  if (chosen === undefined) delete dataset.theme;
  else dataset.theme = chosen;
}

export function themeSwitch(repaint: () => void): HTMLElement {
  const choice = element(
    'select',
    {
      'aria-label': 'Colours',
      'data-testid': 'theme',
      onchange: () => {
        if (choice.value === 'auto') delete document.documentElement.dataset.theme;
        else document.documentElement.dataset.theme = choice.value;
        repaint();
      },
    },
    ...THEMES.map((theme) => element('option', { value: theme }, WORDS[theme])),
  );
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  return choice;
}
