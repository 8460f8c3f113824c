// The page of a report: its sections in their order, filled from the data.

import { Clock } from './clock';
import { element, refill } from './element';
import type { Child } from './element';
import { Keys } from './keys';
import { ResidualsSection } from './plots/section';
import type { PoseActs } from './plots/pose_acts';
import type { Diagnosis, Model, Report } from './report';
import { diagnosisSection } from './sections/diagnosis';
import { estimates } from './sections/estimates';
import { ladder } from './sections/ladder';
import { ledger } from './sections/ledger';
import { repeat } from './sections/repeat';
import { sideBySide } from './sections/side_by_side';
import { summary } from './sections/summary';
import { StageSection } from './stage/section';
import { themeSwitch } from './theme';

/** What makes the page alive: the studio's parts, each at its place. */
export interface Live {
  top: HTMLElement[];
  model: HTMLElement;
  plotTools: HTMLElement;
  sections: HTMLElement[];
  acts: PoseActs;
  /** Keys and what they do, beside the page's own. */
  keys: [key: string, does: string][];
  adder: (effect: string) => HTMLElement;
  missingStatus: HTMLElement;
}

export class ReportPage {
  readonly clock = new Clock();
  private report: Report | null = null;
  private chosen = 0;
  private stage: StageSection | null = null;
  private readonly residuals: ResidualsSection;
  private readonly title = element('h1');
  private readonly subtitle = element('p', { class: 'subtitle' });
  private readonly summary = element('section', { 'aria-label': 'Summary' });
  private readonly choice = element('div', { class: 'choice' });
  private readonly look = element('section', {
    class: 'look',
    'aria-label': 'The collision in 3D and its residuals',
  });
  private readonly missing = section('What is missing');
  private readonly estimates = section('The numbers');
  private readonly ledger = section('The books');
  private readonly compared = section('Side by side');
  private readonly warnings = section('Warnings');
  private readonly repeat = section('Make it again');

  constructor(
    root: HTMLElement,
    private readonly live: Live | null = null,
  ) {
    this.residuals = new ResidualsSection(this.clock, live?.acts ?? null);
    const keys = new Keys(this.clock, () => this.stage, live?.keys ?? []);
    root.replaceChildren(
      element(
        'header',
        {},
        element('div', {}, this.title, this.subtitle),
        element(
          'div',
          { class: 'row' },
          themeSwitch(() => this.repaint()),
          keys.button,
        ),
      ),
      ...(live ? [...live.top, this.summary, live.model] : [this.summary]),
      this.choice,
      this.look,
      this.missing.root,
      ...(live?.sections ?? []),
      ...[this.estimates, this.ledger, this.compared, this.warnings, this.repeat].map((one) => one.root),
      keys.dialog,
    );
    window.addEventListener('beforeprint', openAll);
  }

  show(report: Report): void {
    this.report = report;
    this.chosen = 0;
    document.title = `${report.scene.name} · smash`;
    this.title.textContent = report.scene.name;
    this.subtitle.textContent = whatItIs(report);
    if (this.stage === null) {
      this.stage = new StageSection(report.scene, this.clock);
      this.look.replaceChildren(
        element('h2', { class: 'visually-hidden' }, 'The collision, and what the model leaves of the poses'),
        this.stage.root,
        element('div', {}, ...(this.live ? [this.live.plotTools] : []), this.residuals.root),
      );
    }
    this.showModel();
    this.compared.fill(report.models.length > 1 ? sideBySide(report) : []);
    if (this.live === null) this.missing.fill(this.whatIsMissing(report));
    this.warnings.fill(
      report.warnings.length === 0
        ? []
        : [element('ul', {}, ...report.warnings.map((one) => element('li', {}, one)))],
    );
    this.repeat.fill(repeat(report));
  }

  /** What is missing of the shown model, as far as it is known; `status` says what isn't. */
  diagnosed(diagnosis: Diagnosis | null, status: Child[]): void {
    if (this.report === null) return;
    this.report.diagnosis = diagnosis;
    refill(this.summary, ...summary(this.report, this.model));
    this.missing.fill([
      ...status,
      ...(this.live ? [this.live.missingStatus] : []),
      ...this.whatIsMissing(this.report),
    ]);
  }

  private get model(): Model | null {
    return this.report?.models[this.chosen] ?? null;
  }

  private showModel(): void {
    const { report, model } = this;
    if (report === null) return;
    const poses = report.scene.bodies.flatMap((body) => body.observations.map((pose) => pose.time));
    this.clock.cover(poses, model?.motion?.collision_time ?? model?.result.collision_time.value ?? null);
    refill(this.summary, ...summary(report, model));
    this.fillChoice(report);
    this.stage?.show(report.scene, model, this.live?.acts.isMarked ?? null);
    const others = report.models.filter((other) => other !== model);
    this.residuals.show(report.scene, model, others);
    this.estimates.fill(model ? estimates(report, model) : []);
    this.ledger.fill(model ? ledger(report, model) : []);
  }

  private fillChoice(report: Report): void {
    if (report.models.length < 2) return this.choice.replaceChildren();
    const choices = report.models.map((model, index) =>
      element(
        'label',
        {},
        element('input', {
          type: 'radio',
          name: 'model',
          id: `model-${index}`,
          checked: index === this.chosen,
          'data-testid': `model-${index}`,
          onchange: () => {
            this.chosen = index;
            this.showModel();
          },
        }),
        model.name,
      ),
    );
    refill(
      this.choice,
      element('fieldset', {}, element('legend', {}, 'Shown in 3D, plots and numbers'), ...choices),
    );
  }

  private whatIsMissing(report: Report): Child[] {
    const { diagnosis, improvement } = report;
    return [
      ...(diagnosis ? diagnosisSection(diagnosis, this.live?.adder) : []),
      ...(improvement && improvement.ladder.length > 0
        ? [element('h3', {}, 'The ladder'), ...ladder(improvement)]
        : []),
    ];
  }

  private repaint(): void {
    this.stage?.repaint();
    this.residuals.repaint();
  }
}

interface Section {
  root: HTMLElement;
  /** Without content it isn't there. */
  fill: (content: Child[]) => void;
}

function section(title: string): Section {
  const content = element('div');
  const root = element('section', { hidden: true, 'aria-label': title }, element('h2', {}, title), content);
  return {
    root,
    fill: (children) => {
      refill(content, ...children);
      root.hidden = children.length === 0;
    },
  };
}

function whatItIs(report: Report): string {
  const { scene } = report;
  const bodies = scene.bodies.map(
    (body) =>
      `${body.name} (${body.shape.type === 'sphere' ? 'ball' : 'box'}, ${body.observations.length} poses)`,
  );
  if (scene.plane) bodies.push(`${scene.plane.name} (a fixed plane)`);
  return `A collision, reconstructed by smash from measured poses: ${bodies.join(' and ')}.`;
}

/** Paper can't be clicked. */
function openAll(): void {
  const closed = [...document.querySelectorAll<HTMLDetailsElement>('details:not([open])')];
  for (const details of closed) details.open = true;
  const closeAgain = (): void =>
    closed.forEach((details) => {
      details.open = false;
    });
  window.addEventListener('afterprint', closeAgain, { once: true });
}
