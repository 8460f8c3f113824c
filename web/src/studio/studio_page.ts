// The studio: the report's page, alive.

import { element } from '../element';
import type { Diagnosis } from '../report';
import { ReportPage } from '../report_page';
import type { StudioState } from '../studio_state';
import { banner } from './banner';
import { Bar } from './bar';
import { Catalogue } from './catalogue';
import { Diagnoser } from './diagnoser';
import { ErrorLine } from './error_line';
import { LawEditor } from './law_editor';
import { PlotModes } from './plot_modes';
import { Poses } from './poses';
import { Studio } from './studio';
import { Variants } from './variants';

export function showStudio(root: HTMLElement, state: StudioState): void {
  const studio = new Studio(state);
  const law = new LawEditor(studio);
  const poseLine = new ErrorLine();
  const plotLine = new ErrorLine();
  const missingLine = new ErrorLine();
  const modes = new PlotModes(studio, plotLine);
  const catalogue = new Catalogue(studio, (text) => law.edit(text));
  const page = new ReportPage(root, {
    top: [banner(studio), new Bar(studio).root],
    model: element(
      'section',
      { class: 'model', 'aria-label': 'The model' },
      catalogue.root,
      new Variants(studio).root,
    ),
    plotTools: element('div', {}, modes.root, plotLine.root),
    sections: [law.root, new Poses(studio, poseLine).root],
    acts: modes,
    keys: [
      ['Ctrl Z', 'undo'],
      ['Ctrl Y', 'redo; also Ctrl Shift Z'],
    ],
    adder: (effect) =>
      element(
        'button',
        {
          type: 'button',
          'data-testid': `suggested-${effect}`,
          'aria-label': `Add ${effect}`,
          onclick: () => void studio.act({ do: 'add', effect }, missingLine),
        },
        '+ add',
      ),
    missingStatus: element('div', {}, missingLine.root),
  });
  const diagnoser = new Diagnoser(studio, (answer) => tell(page, answer));
  let shown = '';
  const show = (): void => {
    const { report } = studio.state.value;
    // A draft changes the state, but nothing that is drawn.
    const drawn = JSON.stringify(report);
    if (drawn === shown) return;
    shown = drawn;
    page.show(report);
    diagnoser.ask();
  };
  show();
  studio.state.watch(afterPaint(show));
  studio.connection.watch((connection) => {
    if (connection === 'there') diagnoser.askAgain();
  });
}

/** Later, once what was changed already is on the screen: the error's fall comes before all plots. */
function afterPaint(act: () => void): () => void {
  let isDue = false;
  return () => {
    if (isDue) return;
    isDue = true;
    requestAnimationFrame(() =>
      setTimeout(() => {
        isDue = false;
        act();
      }),
    );
  };
}

function tell(page: ReportPage, answer: Diagnosis | Error | null): void {
  if (answer instanceof Error) {
    const line = new ErrorLine();
    line.tell(answer);
    page.diagnosed(null, [line.root]);
  } else if (answer === null) {
    page.diagnosed(null, [
      element(
        'p',
        { class: 'hint', role: 'status', 'data-testid': 'diagnosing' },
        'Looking for what is missing …',
      ),
    ]);
  } else {
    page.diagnosed(answer, []);
  }
}
