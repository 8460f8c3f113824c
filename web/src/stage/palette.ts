// The colours of canvases, read from the style sheet: it alone knows light from dark.

export interface Palette {
  ground: string;
  ink: string;
  faint: string;
  quiet: string;
  grid: string;
  before: string;
  after: string;
  bodies: string[];
  difference: string;
  band: string;
  alarm: string;
}

export function palette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string): string => style.getPropertyValue(`--${name}`).trim();
  return {
    ground: colour('stage'),
    ink: colour('ink'),
    faint: colour('faint'),
    quiet: colour('quiet'),
    grid: colour('grid'),
    before: colour('before'),
    after: colour('after'),
    bodies: [colour('body-a'), colour('body-b')],
    difference: colour('difference'),
    band: colour('band'),
    alarm: colour('alarm'),
  };
}
