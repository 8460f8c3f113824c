// What the graphics card holds of things that are drawn no more, given back.

import type { BufferGeometry, Material, Object3D } from 'three';

export function dispose(group: Object3D): void {
  group.traverse((part) => {
    const { geometry, material } = part as { geometry?: BufferGeometry; material?: Material };
    geometry?.dispose();
    material?.dispose();
  });
}
