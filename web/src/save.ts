// Files that the page hands out.

import { element } from './element';

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

/** Only letters, digits and what no system minds: names come from scenes. */
function fileName(name: string): string {
  return name.replace(/[^\p{L}\p{N}._+-]+/gu, '_').slice(0, 120);
}
