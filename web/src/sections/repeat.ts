// How to make this again, and all numbers as files.

import { element } from '../element';
import type { Child } from '../element';
import { residualsCsv } from '../csv';
import type { Report } from '../report';
import { save } from '../save';

export function repeat(report: Report): Child[] {
  const commands = report.commands.join('\n');
  const copied = element('span', { role: 'status', class: 'hint' });
  const copy = element(
    'button',
    {
      type: 'button',
      'data-testid': 'copy-commands',
      onclick: () => {
        void copyText(commands, block).then((words) => {
          copied.textContent = words;
        });
      },
    },
    'Copy',
  );
  const block = element('pre', { 'data-testid': 'commands', tabindex: 0 }, commands);
  return [
    ...(commands === '' ? [] : [block, element('p', { class: 'row' }, copy, copied)]),
    element(
      'p',
      { class: 'hint' },
      `Made with smash ${report.made_with.smash} and Ceres Solver ${report.made_with.ceres}.`,
    ),
    element(
      'p',
      { class: 'row' },
      element(
        'button',
        {
          type: 'button',
          'data-testid': 'save-json',
          onclick: () =>
            save(`${report.scene.name}.report.json`, 'application/json', JSON.stringify(report, null, 1)),
        },
        'All numbers, JSON',
      ),
      element(
        'button',
        {
          type: 'button',
          'data-testid': 'save-csv',
          onclick: () => save(`${report.scene.name}.residuals.csv`, 'text/csv', residualsCsv(report)),
        },
        'Residuals, CSV',
      ),
    ),
  ];
}

/** Pages from disk may have no clipboard: then the text is selected, ready for Ctrl-C. */
async function copyText(text: string, block: HTMLElement): Promise<string> {
  try {
    await navigator.clipboard.writeText(text);
    return 'Copied.';
  } catch {
    getSelection()?.selectAllChildren(block);
    return 'Selected: copy it with Ctrl-C.';
  }
}
