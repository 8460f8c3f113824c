// The 3D picture: one canvas, drawn when something changed.

import {
  AmbientLight,
  Color,
  DirectionalLight,
  HemisphereLight,
  PerspectiveCamera,
  Scene as World,
  Sphere,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { element } from '../element';
import type { Model, Scene } from '../report';
import { Collision } from './collision';
import type { Layer } from './collision';
import { dispose } from './dispose';
import { extent, reach } from './extent';
import { palette } from './palette';
import type { IsMarked } from './poses';
import { Tags } from './tags';
import { direction, distance } from './views';
import type { View } from './views';

export class Stage {
  readonly canvas: HTMLCanvasElement;
  private readonly world = new World();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly tags: Tags;
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private collision: Collision | null = null;
  private scene: Scene | null = null;
  private model: Model | null = null;
  private isMarked: IsMarked | null = null;
  private all = new Sphere();
  private time = 0;
  private exaggeration = 0;
  private readonly hidden = new Set<Layer>();
  private view: View = 'overview';
  private isDue = false;

  /** Null where the browser draws no 3D. */
  static on(holder: HTMLElement, up: [number, number, number]): Stage | null {
    const canvas = element('canvas', {
      'aria-label': 'The collision in 3D',
      role: 'img',
      'data-testid': 'stage-canvas',
      tabindex: 0,
    });
    const context = canvas.getContext('webgl2', { antialias: true, alpha: false });
    return context === null ? null : new Stage(holder, canvas, context, up);
  }

  private constructor(
    private readonly holder: HTMLElement,
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    up: [number, number, number],
  ) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, context, antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    holder.append(canvas);
    this.tags = new Tags(holder);
    this.camera.up.set(...up).normalize();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.controls.listenToKeyEvents(canvas);
    this.camera.add(this.sun);
    this.sun.position.set(-0.6, 1, 0.6);
    new ResizeObserver(() => this.fit()).observe(holder);
    // The browser takes the context from pages that were long out of sight.
    canvas.addEventListener('webglcontextrestored', () => this.rebuild());
    this.fit();
  }

  private readonly renderer: WebGLRenderer;

  /** Shows a model, in place of what was shown; the camera stays unless the scene is new. */
  show(scene: Scene, model: Model | null, isMarked: IsMarked | null): void {
    const isFirst = this.scene === null;
    this.scene = scene;
    this.model = model;
    this.isMarked = isMarked;
    this.all = extent(scene, model);
    this.rebuild();
    if (isFirst) this.look('overview');
  }

  /** After a change of colours, too. */
  rebuild(): void {
    if (this.scene === null) return;
    const colours = palette();
    if (this.collision) dispose(this.collision);
    this.world.clear();
    this.world.background = new Color(colours.ground);
    this.collision = new Collision(this.scene, this.model, this.all, colours, this.isMarked);
    const sky = new HemisphereLight(0xffffff, 0x9a9080, 1.6);
    sky.position.copy(this.camera.up);
    this.world.add(sky, new AmbientLight(0xffffff, 0.25), this.camera, this.collision);
    for (const layer of this.hidden) this.collision.show(layer, false);
    this.collision.exaggerate(this.exaggeration);
    this.tags.name(this.collision.tags);
    this.showAt(this.time);
  }

  showAt(time: number): void {
    this.time = time;
    const before = this.collision?.followed?.clone();
    this.collision?.showAt(time);
    const now = this.collision?.followed;
    if (this.view === 'follow' && before && now) this.move(now.clone().sub(before));
    this.draw();
  }

  exaggerate(times: number): void {
    this.exaggeration = times;
    this.collision?.exaggerate(times);
    this.draw();
  }

  showLayer(layer: Layer, visible: boolean): void {
    if (visible) this.hidden.delete(layer);
    else this.hidden.add(layer);
    this.collision?.show(layer, visible);
    this.draw();
  }

  /** The side of a square of the grid, m. */
  get square(): number {
    return this.collision?.floor.square ?? 0;
  }

  look(view: View): void {
    if (this.scene === null) return;
    this.view = view;
    const ball = this.framed(view);
    const away = distance(this.camera, ball);
    this.controls.target.copy(ball.center);
    this.camera.position.copy(ball.center).addScaledVector(direction(view, this.scene, this.model), away);
    this.controls.update();
    this.draw();
  }

  /** What a view shows: everything, or a few bodies' sizes around one place. */
  private framed(view: View): Sphere {
    const scene = this.scene as Scene;
    const largest = Math.max(...scene.bodies.map(reach));
    if (view === 'follow' && this.collision?.followed) {
      return new Sphere(this.collision.followed.clone(), 5 * largest);
    }
    const result = this.model?.result;
    const impact = result?.contact_point ?? result?.bodies[0]?.position;
    if ((view === 'impact' || view === 'impulse') && impact) {
      return new Sphere(new Vector3(...impact), 3.5 * largest);
    }
    return this.all;
  }

  private move(by: Vector3): void {
    this.controls.target.add(by);
    this.camera.position.add(by);
    this.controls.update();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.drawNow();
  }

  /** With the next frame, once. */
  draw(): void {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => this.drawNow());
  }

  /** Now: what is on the canvas can be copied until the browser shows it. */
  drawNow(): void {
    this.isDue = false;
    if (this.scene === null) return;
    const away = this.camera.position.distanceTo(this.controls.target);
    const size = this.all.radius;
    this.camera.near = Math.max(away - 4 * size, away / 100);
    this.camera.far = away + 6 * size;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.world, this.camera);
    this.tags.place(this.camera, (layer) => this.collision?.isShown(layer) ?? false);
  }
}
