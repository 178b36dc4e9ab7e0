// The words and tables around the player.
import { h, symbol } from "./dom";
import type { Fact, Page, Table } from "./page";
import { formatNumber } from "./units";

const statusWords: Record<Page["status"], string> = { running: "running", finished: "finished", failed: "failed", interrupted: "interrupted" };

export function makeHeader(page: Page): HTMLElement {
  return h(
    "header",
    { class: "title" },
    h("p", { class: "brand" }, h("span", {}, "Polder"), h("span", { class: `status ${page.status}` }, statusWords[page.status])),
    h("h1", {}, page.title),
    h("p", { class: "summary" }, page.summary),
  );
}

function fact({ label, value, unit, note }: Fact): HTMLElement {
  return h("div", { class: "fact" }, h("dt", {}, label), h("dd", {}, h("span", { class: "value" }, value), unit ? h("span", { class: "fact-unit" }, `\u202f${unit}`) : null, note ? h("span", { class: "fact-note" }, note) : null));
}

export function makeFacts(page: Page): HTMLElement | null {
  return page.facts.length ? h("dl", { class: "facts", "aria-label": "Key figures" }, ...page.facts.map(fact)) : null;
}

export function makeNotes(page: Page): HTMLElement | null {
  return page.notes.length ? h("ul", { class: "notes" }, ...page.notes.map((n) => h("li", {}, n))) : null;
}

/** Tables with sentences in them, which a phone shows row by row. */
const worded = new Set(["comparison", "validation", "audit"]);

function table(t: Table): HTMLElement {
  const cls = (k: number) => (t.numeric[k] ? "number" : undefined);
  const head = h("tr", {}, ...t.columns.map((c, k) => h("th", { scope: "col", class: cls(k) }, c)));
  const rows = t.rows.map((row) =>
    h(
      "tr",
      {},
      ...row.map((cell, k) =>
        k === 0
          ? h("th", { scope: "row", title: cell.title }, cell.text)
          : h(
              "td",
              { class: [cls(k) ?? "", cell.state ?? ""].join(" ").trim() || undefined, title: cell.title, "data-column": t.columns[k] },
              t.columns[k] === "Symbol" ? symbol(cell.text) : cell.text,
            ),
      ),
    ),
  );
  const kind = t.columns.length === 2 ? "small" : worded.has(t.id) ? "cards" : "";
  return h(
    "section",
    { class: `block ${kind}`.trim(), id: t.id },
    h("h2", {}, t.title),
    t.note ? h("p", { class: "lead" }, t.note) : null,
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t.title }, h("table", {}, h("thead", {}, head), h("tbody", {}, ...rows))),
  );
}

/** Tables of two columns stand side by side, after the others. */
export function makeTables(page: Page, which: (t: Table) => boolean): HTMLElement[] {
  const shown = page.tables.filter((t) => t.rows.length > 0 && which(t));
  const small = shown.filter((t) => t.columns.length === 2).map(table);
  const wide = shown.filter((t) => t.columns.length !== 2).map(table);
  return small.length ? [...wide, h("div", { class: "side-by-side" }, ...small)] : wide;
}

export function makeFigures(page: Page): HTMLElement[] {
  return page.figures.map(({ title, source }) =>
    h("section", { class: "block" }, h("h2", {}, "Model"), h("figure", { class: "drawing" }, h("img", { src: source, alt: title }), h("figcaption", {}, title))),
  );
}

function plainText(value: unknown): string {
  if (typeof value === "number") return formatNumber(value, 6);
  if (value === null) return "–";
  return String(value);
}

const isPlain = (value: unknown) => value === null || typeof value !== "object";

function tree(value: unknown): HTMLElement {
  if (isPlain(value)) return h("span", { class: "leaf" }, plainText(value));
  if (Array.isArray(value)) {
    if (value.every(isPlain)) return h("span", { class: "leaf" }, value.map(plainText).join(", "));
    if (value.every((v) => Array.isArray(v) && v.every(isPlain))) return h("span", { class: "leaf" }, value.map((v) => `(${(v as unknown[]).map(plainText).join(", ")})`).join(" "));
    return h("ol", { class: "tree" }, ...value.map((v) => h("li", {}, tree(v))));
  }
  const items = Object.entries(value as Record<string, unknown>).map(([key, v]) => h("div", { class: isPlain(v) ? "pair" : "pair deep" }, h("dt", {}, key), h("dd", {}, tree(v))));
  return h("dl", { class: "tree" }, ...items);
}

export function makeInputs(page: Page): HTMLElement | null {
  const inputs = page.inputs;
  if (!inputs || typeof inputs !== "object" || Object.keys(inputs).length === 0) return null;
  const details = h("details", { class: "inputs" }, h("summary", {}, "All inputs, with every default filled in (SI units)"), tree(inputs));
  window.addEventListener("beforeprint", () => (details.open = true));
  return h("section", { class: "block", id: "inputs" }, h("h2", {}, "Inputs"), details);
}

const keys: [string, string][] = [
  ["Space", "play or pause"],
  ["← →", "one frame back or on"],
  ["Page Up, Page Down", "a tenth of the run"],
  ["Home, End", "first or last frame"],
  ["+ − 0", "zoom in, out, show all"],
  ["Shift + arrows", "move the picture"],
  ["C, Shift + C", "next colour of the soil, of the water"],
  ["S W F L O M V B", "the switches below the picture"],
  ["P", "save the picture"],
  ["?", "this list"],
];

export function makeHelp(): HTMLDialogElement {
  const dialog = h(
    "dialog",
    { class: "help", "aria-label": "Keys" },
    h("h2", {}, "Keys"),
    h("dl", {}, ...keys.map(([key, does]) => h("div", {}, h("dt", {}, key), h("dd", {}, does)))),
    h("p", { class: "lead" }, "Drag to move, double-click to show all. The wheel zooms once the picture has been clicked, or with Ctrl; two fingers zoom on a touch screen."),
    h("form", { method: "dialog" }, h("button", { class: "plain" }, "Close")),
  );
  return dialog;
}

export function makeFooter(page: Page): HTMLElement {
  return h("footer", {}, h("p", {}, `Polder ${page.version}.`.replace(" .", ".").replace(" ,", ",") + " Between snapshots the player moves points along straight lines; when it stands still it shows a snapshot as computed."));
}
