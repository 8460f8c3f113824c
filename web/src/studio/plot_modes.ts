// What the mouse does in plots: a choice, and the acts behind it.

import { element } from '../element';
import type { Mode, PoseActs } from '../plots/pose_acts';
import { MODES } from '../plots/pose_acts';
import type { ErrorLine } from './error_line';
import type { Studio } from './studio';

const WORDS: Record<Mode, [name: string, how: string]> = {
  look: [
    'look',
    'In plots: Shift-click marks a pose wrong, Alt-drag moves it in time, whatever is chosen here.',
  ],
  mark: ['mark wrong', 'Click a pose to leave it out of the fit; click it again to take it back.'],
  time: ['move in time', 'Drag a pose to the left or right, up to its neighbours.'],
  noise: [
    'noise',
    'Drag the edge of the grey band, ±2 σ of all poses; or a pose up or down: the bar is ±2 σ of its own.',
  ],
};

export class PlotModes implements PoseActs {
  readonly root: HTMLElement;
  mode: Mode = 'look';
  private marked = new Set<string>();

  constructor(
    private readonly studio: Studio,
    private readonly line: ErrorLine,
  ) {
    studio.state.watch(({ edits }) => {
      this.marked = new Set(edits.marked.map((pose) => `${pose.observation} ${pose.body}`));
    });
    const how = element('p', { class: 'hint' }, WORDS[this.mode][1]);
    const choices = MODES.map((mode) =>
      element(
        'label',
        {},
        element('input', {
          type: 'radio',
          name: 'plot-mode',
          checked: mode === this.mode,
          'data-testid': `mode-${mode}`,
          onchange: () => {
            this.mode = mode;
            how.textContent = WORDS[mode][1];
          },
        }),
        WORDS[mode][0],
      ),
    );
    this.root = element(
      'div',
      { class: 'modes' },
      element('fieldset', {}, element('legend', {}, 'Mouse'), ...choices),
      how,
    );
  }

  readonly isMarked = (body: string, observation: number): boolean =>
    this.marked.has(`${observation} ${body}`);

  mark(body: string, observation: number, wrong: boolean): void {
    void this.studio.act({ do: 'mark', body, observation, wrong }, this.line);
  }

  move(body: string, observation: number, time: number): void {
    void this.studio.act({ do: 'time', body, observation, time }, this.line);
  }

  poseNoise(body: string, observation: number, scale: number): void {
    void this.studio.act({ do: 'pose_noise', body, observation, scale }, this.line);
  }

  get noiseScales(): [least: number, most: number] {
    return this.studio.state.value.limits.noise_scale;
  }

  noise(channel: 'position' | 'orientation', sigma: number): void {
    const { edits, report } = this.studio.state.value;
    const known = edits.noise ?? report.scene.noise ?? report.noise;
    const stated = { position: known?.position ?? sigma, orientation: known?.orientation, [channel]: sigma };
    // Where no orientation is measured, there is no noise of it to state.
    const { position, orientation = undefined } = stated;
    void this.studio.act({ do: 'noise', position, orientation }, this.line);
  }
}
