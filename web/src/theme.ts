// Light or dark: the system's choice, or one's own.

import { element } from './element';

const THEMES = ['auto', 'light', 'dark'] as const;
const WORDS = { auto: 'as the system', light: 'light', dark: 'dark' };

export function themeSwitch(repaint: () => void): HTMLElement {
  const choice = element('select', {
    'aria-label': 'Colours', 'data-testid': 'theme',
    onchange: () => {
      if (choice.value === 'auto') delete document.documentElement.dataset.theme;
      else document.documentElement.dataset.theme = choice.value;
      repaint();
    },
  }, ...THEMES.map((theme) => element('option', { value: theme }, WORDS[theme])));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  return choice;
}
