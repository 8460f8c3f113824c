// An arrow of a shaft and a head, as thick as one says.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';

const UP = new Vector3(0, 1, 0);

export class Arrow extends Group {
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(
    colour: string,
    private readonly thickness: number,
  ) {
    super();
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    this.shaft = new Mesh(new CylinderGeometry(thickness / 2, thickness / 2, 1, 12), material);
    this.head = new Mesh(new ConeGeometry(1.6 * thickness, 4 * thickness, 16), material);
    this.add(this.shaft, this.head);
    this.renderOrder = 3;
    this.shaft.renderOrder = this.head.renderOrder = 3;
  }

  /** From `tail`, along `along` by its length; nothing where that has none. */
  point(tail: Vector3, along: Vector3): void {
    const length = along.length();
    this.visible = length > 0 && Number.isFinite(length);
    if (!this.visible) return;
    const head = Math.min(4 * this.thickness, length / 2);
    this.shaft.scale.y = length - head;
    this.shaft.position.y = (length - head) / 2;
    this.head.scale.setScalar(head / (4 * this.thickness));
    this.head.position.y = length - head / 2;
    this.position.copy(tail);
    this.quaternion.setFromUnitVectors(UP, along.clone().normalize());
  }
}
