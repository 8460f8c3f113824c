// Names over the 3D picture, as text.

import { PerspectiveCamera } from 'three';
import { element } from '../element';
import type { Layer, Tag } from './collision';

export class Tags {
  private readonly layer = element('div', { class: 'stage-tags', 'aria-hidden': 'true' });
  private named: { tag: Tag; text: HTMLElement }[] = [];

  constructor(private readonly holder: HTMLElement) {
    holder.append(this.layer);
  }

  name(tags: Tag[]): void {
    this.named = tags.map((tag) => ({ tag, text: element('span', {}, tag.text) }));
    this.layer.replaceChildren(...this.named.map((one) => one.text));
  }

  place(camera: PerspectiveCamera, isShown: (layer: Layer) => boolean): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    for (const { tag, text } of this.named) {
      const at = tag.at().clone().project(camera);
      const isSeen = isShown(tag.layer) && at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
      text.hidden = !isSeen;
      const [x, y] = [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
      text.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }
}
