// Reads what the page was given, and shows it: a report, or the studio.

import { element } from './element';
import type { Report } from './report';
import { ReportPage } from './report_page';
import { showStudio } from './studio/studio_page';
import type { StudioState } from './studio_state';

const page = document.getElementById('page') as HTMLElement;
start(page, embedded());

/** The data in the page; null where it can't be read. */
function embedded(): unknown {
  try {
    return JSON.parse(document.getElementById('smash-data')?.textContent ?? '') as unknown;
  } catch {
    return null;
  }
}

function start(root: HTMLElement, data: unknown): void {
  const schema = typeof data === 'object' && data !== null && 'schema' in data ? data.schema : null;
  if (schema === 'smash.report/1') {
    new ReportPage(root).show(data as Report);
    return;
  }
  if (schema === 'smash.studio/1') {
    showStudio(root, data as StudioState);
    return;
  }
  root.replaceChildren(
    element('h1', {}, 'smash'),
    element(
      'p',
      { role: 'alert' },
      schema === null
        ? 'This page holds no data. Make one that does: smash report SCENE RESULT -o report.html'
        : `This page can’t show ${String(schema)}: make it again with the same version of smash.`,
    ),
  );
}
