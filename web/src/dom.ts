// Building the page's elements in few words.

type Attributes = Record<string, string | number | boolean | EventListener | undefined>;
type Child = Node | string | null | undefined | false;

const raised = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** Text with powers of ten set as superscripts: "10⁻⁶" in few fonts looks like one number. */
export function set(text: string): Node {
  const parts = document.createDocumentFragment();
  for (const part of text.split(/([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]*[⁻⁰⁴-⁹][⁻⁰¹²³⁴⁵⁶⁷⁸⁹]*)/)) {
    if (!part) continue;
    if (!/[⁻⁰⁴-⁹]/.test(part)) {
      parts.append(part);
      continue;
    }
    const sup = document.createElement("sup");
    sup.textContent = [...part].map((c) => (c === "⁻" ? "−" : raised.indexOf(c))).join("");
    parts.append(sup);
  }
  return parts;
}

/** A symbol of the theory: "n_max" with its index set low. */
export function symbol(text: string): Node {
  const cut = text.indexOf("_");
  if (cut < 0) return document.createTextNode(text);
  const parts = document.createDocumentFragment();
  const sub = document.createElement("sub");
  sub.textContent = text.slice(cut + 1);
  parts.append(text.slice(0, cut), sub);
  return parts;
}

/** h("p", { class: "note", onclick: f }, "text", child) */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  for (const child of children) if (child) element.append(typeof child === "string" ? set(child) : child);
  return element;
}

const icons = {
  play: "M5 3.5v13l11-6.5z",
  pause: "M5 3.5h3.5v13H5zM11.5 3.5H15v13h-3.5z",
  first: "M4 4h2v12H4zM16 4v12l-9-6z",
  back: "M4.5 10 12 4v12zM13.5 4h2v12h-2z",
  forward: "M15.5 10 8 4v12zM4.5 4h2v12h-2z",
  plus: "M9 4h2v5h5v2h-5v5H9v-5H4V9h5z",
  minus: "M4 9h12v2H4z",
  fit: "M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z",
  picture: "M3 5h3l1.3-2h5.4L14 5h3v11H3zM10 7a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7z",
  film: "M3 4h14v12H3zM5 6v1.5h1.5V6zM5 9.2v1.6h1.5V9.2zM5 12.5V14h1.5v-1.5zM13.5 6v1.5H15V6zM13.5 9.2v1.6H15V9.2zM13.5 12.5V14H15v-1.5z",
  theme: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14z",
  keys: "M2 5h16v10H2zM4 7v1.6h1.6V7zM7 7v1.6h1.6V7zM10 7v1.6h1.6V7zM13 7v1.6h3V7zM5 11.5V13h10v-1.5z",
  print: "M5 3h10v4H5zM3 8h14v6h-3v3H6v-3H3zM7.5 12v3.5h5V12z",
} as const;

export type IconName = keyof typeof icons;

export function icon(name: IconName): SVGElement {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", icons[name]);
  path.setAttribute("fill-rule", "evenodd");
  if (name === "theme") path.setAttribute("d", "M10 2.5a7.5 7.5 0 1 0 0 15 7.5 7.5 0 0 0 0-15zm0 1.8v11.4a5.7 5.7 0 0 1 0-11.4z");
  svg.append(path);
  return svg;
}

export function iconButton(name: IconName, label: string, action: () => void): HTMLButtonElement {
  return h("button", { type: "button", class: "tool", "aria-label": label, title: label, onclick: action as EventListener }, icon(name));
}

export function setIcon(button: HTMLButtonElement, name: IconName, label: string) {
  button.replaceChildren(icon(name));
  button.setAttribute("aria-label", label);
  button.title = label;
}

export const cssColour = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
