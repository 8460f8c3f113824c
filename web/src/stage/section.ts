// The 3D picture with its time line, views and layers.

import type { Clock } from '../clock';
import { element, freshId } from '../element';
import { length } from '../numbers';
import { singleOutliers } from '../outliers';
import type { Model, Scene } from '../report';
import { saveCanvas } from '../save';
import { inLight } from '../theme';
import { Timeline } from './timeline';
import { strideOf } from './poses';
import type { IsMarked } from './poses';
import { Stage } from './stage';
import type { Layer } from './collision';
import { LAYERS } from './collision';
import { VIEWS, VIEW_WORDS } from './views';

const LAYER_WORDS: Record<Layer, string> = {
  poses: 'measured poses (outlines)',
  model: 'model (solids)',
  paths: 'paths',
  impulse: 'impulse J and contact',
  spins: 'spin axes',
};
const EXAGGERATIONS = [0, 1, 5, 20, 100];

export class StageSection {
  readonly root: HTMLElement;
  readonly stage: Stage | null;
  private readonly timeline: Timeline;
  private readonly grid = element('p', { class: 'hint', 'data-testid': 'grid-note' });
  private readonly still = element('canvas', { class: 'stage-still', 'aria-hidden': 'true' });
  private readonly exaggeration: HTMLSelectElement;
  private readonly difference = element('p', {
    class: 'hint',
    hidden: true,
    'data-testid': 'difference-note',
  });

  constructor(scene: Scene, clock: Clock) {
    const holder = element('div', { class: 'stage', 'data-testid': 'stage' });
    this.stage = Stage.on(holder, scene.up);
    if (this.stage === null) {
      holder.classList.add('stage-missing');
      holder.append(
        element(
          'p',
          { role: 'note', 'data-testid': 'no-webgl' },
          'No 3D here: this browser has no WebGL 2, or it is switched off. Everything else works.',
        ),
      );
    }
    this.timeline = new Timeline(clock);
    this.exaggeration = this.exaggerationChoice();
    this.root = element(
      'div',
      { class: 'stage-section' },
      holder,
      this.still,
      this.timeline.root,
      this.stage && this.tools(),
      this.difference,
      this.grid,
    );
    clock.time.watch((time) => this.stage?.showAt(time));
    window.addEventListener('beforeprint', () => this.keepStill());
  }

  /** `isMarked` says which poses the user left out. */
  show(scene: Scene, model: Model | null, isMarked: IsMarked | null): void {
    this.timeline.show(scene);
    this.stage?.show(scene, model, isMarked);
    if (this.stage === null) return;
    const note = gridNote(scene, model, this.stage.square);
    const stride = Math.max(...scene.bodies.map(strideOf));
    const kinds = [
      stride > 1 && `Of long films one pose in ${stride} is outlined.`,
      model && singleOutliers(model).length > 0 && 'Thick outlines are outliers.',
      isMarked && hasMarked(scene, isMarked) && 'Dashed outlines are marked wrong.',
    ];
    this.grid.textContent = [note, ...kinds].filter(Boolean).join(' ');
  }

  repaint(): void {
    this.stage?.rebuild();
    this.timeline.repaint();
  }

  /** To the next exaggeration, round and round. */
  exaggerateMore(): void {
    const next = (this.exaggeration.selectedIndex + 1) % EXAGGERATIONS.length;
    this.exaggeration.selectedIndex = next;
    this.exaggerate(EXAGGERATIONS[next]);
  }

  private exaggerate(times: number): void {
    this.stage?.exaggerate(times);
    this.difference.hidden = times === 0;
    this.difference.textContent = `Thick strokes lead from each measured centre to where the model has it, ${times === 1 ? 'true to scale' : `${times} × as long`}; a thin line joins their ends.`;
  }

  /** What is printed: the canvas of 3D is empty by then. */
  private keepStill(): void {
    const { stage, still } = this;
    if (stage === null) return;
    inLight(() => {
      stage.rebuild();
      stage.drawNow();
      [still.width, still.height] = [stage.canvas.width, stage.canvas.height];
      still.getContext('2d')?.drawImage(stage.canvas, 0, 0);
    });
    stage.rebuild();
  }

  private tools(): HTMLElement {
    const stage = this.stage as Stage;
    const views = VIEWS.map((view, index) =>
      element(
        'button',
        {
          type: 'button',
          'data-testid': `view-${view}`,
          title: `${VIEW_WORDS[view]} (key ${index + 1})`,
          onclick: () => stage.look(view),
        },
        VIEW_WORDS[view],
      ),
    );
    const layers = LAYERS.map((layer) => {
      const box = element('input', {
        type: 'checkbox',
        checked: true,
        'data-testid': `layer-${layer}`,
        onchange: () => stage.showLayer(layer, box.checked),
      });
      return element('label', {}, box, LAYER_WORDS[layer]);
    });
    const save = element(
      'button',
      {
        type: 'button',
        'data-testid': 'save-stage',
        onclick: () => {
          stage.drawNow();
          saveCanvas(stage.canvas, 'collision.png');
        },
      },
      'Save PNG',
    );
    const id = freshId('exaggeration');
    this.exaggeration.id = id;
    return element(
      'div',
      { class: 'stage-tools' },
      element('div', { class: 'row', role: 'group', 'aria-label': 'Views' }, ...views, save),
      element(
        'div',
        { class: 'row', role: 'group', 'aria-label': 'What is drawn' },
        ...layers,
        element('label', { for: id }, 'difference ', this.exaggeration),
      ),
    );
  }

  private exaggerationChoice(): HTMLSelectElement {
    const choice = element(
      'select',
      {
        'data-testid': 'exaggeration',
        title: 'From each measured centre to where the model has it, so many times as long',
        onchange: () => this.exaggerate(Number(choice.value)),
      },
      ...EXAGGERATIONS.map((times) =>
        element('option', { value: times }, times === 0 ? 'off' : `× ${times}`),
      ),
    );
    return choice;
  }
}

function hasMarked(scene: Scene, isMarked: IsMarked): boolean {
  return scene.bodies.some((body) => body.observations.some((_, index) => isMarked(body.name, index)));
}

function gridNote(scene: Scene, model: Model | null, square: number): string {
  const ground = scene.plane
    ? `The grid is ${scene.plane.name}; its squares are ${length(square)}.`
    : `The grid is no floor, only a measure: its squares are ${length(square)}.`;
  const motion = model?.motion
    ? 'Paths are drawn through before the impact, dashed after it.'
    : 'This result tells no motion: only the measured poses are drawn.';
  return `${ground} ${motion} Drag to turn, wheel to zoom, right button to shift.`;
}
