// Files that the page hands out.

import { element } from './element';
import { svgFile } from './svg';

export function save(name: string, type: string, content: BlobPart): void {
  saveBlob(name, new Blob([content], { type }));
}

export function saveBlob(name: string, blob: Blob): void {
  const address = URL.createObjectURL(blob);
  const link = element('a', { href: address, download: fileName(name) });
  document.body.append(link);
  link.click();
  link.remove();
  // Some browsers read the file only after the click has returned.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

export function saveCanvas(canvas: HTMLCanvasElement, name: string): void {
  canvas.toBlob((blob) => blob && saveBlob(name, blob), 'image/png');
}

/** An SVG as PNG, on white, each of its units two pixels. */
export async function saveImage(root: SVGSVGElement, name: string): Promise<void> {
  const { width, height } = root.viewBox.baseVal;
  const canvas = element('canvas', { width: 2 * width, height: 2 * height });
  // Without a size of its own, browsers differ in how large they draw it.
  root.setAttribute('width', String(canvas.width));
  root.setAttribute('height', String(canvas.height));
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svgFile(root))}`;
  await image.decode();
  const context = canvas.getContext('2d');
  if (context === null) return;
  context.fillStyle = '#ffffff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0);
  saveCanvas(canvas, name);
}

/** Only letters, digits and what no system minds: names come from scenes. */
function fileName(name: string): string {
  return name.replace(/[^\p{L}\p{N}._+-]+/gu, '_').slice(0, 120);
}
