// On which body a law is put: chosen beside the button, and kept from law to law.

import { element } from '../element';

export class LawPlace {
  readonly root: HTMLElement;
  private readonly list: HTMLSelectElement;
  private labels: string[] = [];

  constructor(private readonly bodies: string[]) {
    this.list = element(
      'select',
      { 'aria-label': 'Acts on', 'data-testid': 'law-place' },
      ...bodies.map((body) => element('option', { value: body }, body)),
    );
    this.root = element('label', {}, 'on ', this.list);
    this.show(null);
  }

  /** What can be added of the law; null while that isn't known. */
  show(labels: string[] | null): void {
    this.labels = labels ?? [];
    const hasBodies = labels === null || labels.some((label) => label.includes('@'));
    this.root.hidden = this.bodies.length < 2 || !hasBodies;
    const options = [...this.list.options];
    for (const option of options)
      option.disabled = labels !== null && this.labelOn(option.value) === undefined;
    const chosen = this.list.selectedOptions[0];
    if (hasBodies && chosen?.disabled)
      this.list.value = options.find((option) => !option.disabled)?.value ?? '';
  }

  /** The label that is chosen, such as `my_drag@a`. */
  get label(): string {
    return this.labelOn(this.list.value) ?? this.labels[0] ?? '';
  }

  private labelOn(body: string): string | undefined {
    return this.labels.find((label) => label.slice(label.indexOf('@') + 1) === body);
  }
}
