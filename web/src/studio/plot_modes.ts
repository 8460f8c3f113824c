// What the mouse does in plots: a choice, and the acts behind it.

import { element } from '../element';
import type { Mode, PoseActs } from '../plots/pose_acts';
import { MODES } from '../plots/pose_acts';
import type { ErrorLine } from './error_line';
import type { Studio } from './studio';

const WORDS: Record<Mode, string> = {
  look: 'look',
  mark: 'mark a pose wrong (click it; also Shift-click)',
  time: 'move a pose in time (drag it; also Alt-drag)',
  noise: 'change the noise (drag the edge of the grey band)',
};

export class PlotModes implements PoseActs {
  readonly root: HTMLElement;
  mode: Mode = 'look';

  constructor(private readonly studio: Studio, private readonly line: ErrorLine) {
    this.root = element('fieldset', { class: 'modes' },
      element('legend', {}, 'The mouse in plots'),
      ...MODES.map((mode) =>
        element('label', {},
          element('input', {
            type: 'radio', name: 'plot-mode', checked: mode === this.mode, 'data-testid': `mode-${mode}`,
            onchange: () => { this.mode = mode; },
          }), WORDS[mode])));
  }

  isMarked(body: string, observation: number): boolean {
    return this.studio.state.value.edits.marked.some((pose) => pose.body === body && pose.observation === observation);
  }

  mark(body: string, observation: number, wrong: boolean): void {
    void this.studio.act({ do: 'mark', body, observation, wrong }, this.line);
  }

  move(body: string, observation: number, time: number): void {
    void this.studio.act({ do: 'time', body, observation, time }, this.line);
  }

  noise(channel: 'position' | 'orientation', sigma: number): void {
    const { edits, report } = this.studio.state.value;
    const known = edits.noise ?? report.scene.noise ?? {
      position: report.noise?.position ?? sigma,
      // Of a scene without orientations any will do: nothing is divided by it.
      orientation: report.noise?.orientation ?? 0.01,
    };
    void this.studio.act({ do: 'noise', ...known, [channel]: sigma }, this.line);
  }
}
