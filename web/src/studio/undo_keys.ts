// Ctrl-Z and Ctrl-Y, or Ctrl-Shift-Z: the model's, but where one is typing the text's own.

type Way = 'undo' | 'redo';

export class UndoKeys {
  /** A field with something typed that isn't stated yet. */
  private typedIn: EventTarget | null = null;

  constructor(private readonly go: (way: Way) => void) {
    window.addEventListener('input', (event) => {
      this.typedIn = event.target;
    });
    // Enter and leaving the field state what was typed.
    window.addEventListener('change', () => {
      this.typedIn = null;
    });
    window.addEventListener('keydown', (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    const way = wayOf(event);
    if (way === null || event.defaultPrevented || this.isOfText(event.target as HTMLElement)) return;
    event.preventDefault();
    this.go(way);
  }

  private isOfText(target: HTMLElement): boolean {
    if (target.matches('textarea, [type=search]')) return true;
    return target === this.typedIn && target.matches('[type=number]');
  }
}

function wayOf({ key, ctrlKey, metaKey, altKey, shiftKey }: KeyboardEvent): Way | null {
  if (altKey || !(ctrlKey || metaKey)) return null;
  if (key.toLowerCase() === 'z') return shiftKey ? 'redo' : 'undo';
  return key.toLowerCase() === 'y' && !shiftKey ? 'redo' : null;
}
