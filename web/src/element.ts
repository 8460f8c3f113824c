// The page's only way to make elements. Texts become text nodes, never markup: names come from
// files of strangers.

export type Child = Node | string | number | null | false | undefined;
type Attribute = string | number | boolean | null | undefined | ((event: never) => void);

/** Attributes that start with `on` are listeners; false, null and undefined leave one out. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, Attribute> = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === 'function') made.addEventListener(name.slice(2), value as EventListener);
    else made.setAttribute(name, value === true ? '' : String(value));
  }
  made.append(...present(children));
  return made;
}

/** The children that are there. */
export function present(children: Child[]): (Node | string)[] {
  const kept: (Node | string)[] = [];
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    kept.push(typeof child === 'number' ? String(child) : child);
  }
  return kept;
}

/** Puts new children in; what had the focus (by its `id`) or was scrolled is so again. */
export function refill(parent: Element, ...children: Child[]): void {
  const focused = document.activeElement;
  const id = focused !== null && parent.contains(focused) ? focused.id : '';
  const places = scrollers(parent).map((one) => [one.scrollLeft, one.scrollTop]);
  parent.replaceChildren(...present(children));
  scrollers(parent).forEach((one, index) => one.scrollTo(places[index]?.[0] ?? 0, places[index]?.[1] ?? 0));
  if (id !== '') document.getElementById(id)?.focus({ preventScroll: true });
}

const scrollers = (parent: Element): Element[] => [...parent.querySelectorAll('.scroll')];

let counter = 0;

/** An id for an element that another one refers to. */
export function freshId(stem: string): string {
  counter += 1;
  return `${stem}-${counter}`;
}
