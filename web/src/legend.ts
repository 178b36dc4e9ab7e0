// What one phase is coloured by: the choice of field, its colour bar with a range that can be typed, and where the
// range comes from.
import { type MapName, categoryMap, colourMap, coloursOf, cssGradient, flatMap, type Rgb } from "./colourmap";
import { h } from "./dom";
import type { Field, Series } from "./series";
import { type DisplayUnit, displayUnit, formatNumber } from "./units";

export type RangeMode = "run" | "frame" | "fixed";

export interface Colouring {
  field: Field | null;
  low: number;
  high: number;
  map: Uint8Array;
  category: boolean;
}

export interface Legend {
  element: HTMLElement;
  series: Series;
  colouring: () => Colouring;
  key: () => string;
  choose: (key: string) => Promise<void>;
  /** The range of the frame, where the range follows it. */
  follow: (frame: number) => void;
  /** Chooses the next field, as the key C does. */
  step: () => void;
}

const plain: Record<Series["name"], Rgb> = { soil: [0.74, 0.62, 0.43], water: [0.5, 0.7, 0.86] };

const mapOf: Record<string, MapName> = {
  porosity: "dune",
  pore_pressure: "tide",
  pressure: "tide",
  saturation: "tide",
};

export function mapFor(field: Field): MapName {
  if (field.scale === "diverging") return "balance";
  return mapOf[field.key] ?? "ember";
}

function frameRange(field: Field, series: Series, frame: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (let e = series.start[frame]; e < series.start[frame + 1]; ++e) {
    const v = field.values[e];
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Zero in the middle where zero is special; never empty. */
function settled(field: Field, [low, high]: [number, number]): [number, number] {
  if (field.scale === "diverging") {
    const most = Math.max(Math.abs(low), Math.abs(high)) || 1;
    return [-most, most];
  }
  // A lowest value that is nothing beside the highest is a rounded nothing.
  if (Math.abs(low) < 1e-3 * high) return [0, high];
  return high > low ? [low, high] : [low, low + (Math.abs(low) || 1)];
}

export function makeLegend(series: Series, initial: string, changed: () => void): Legend {
  const name = series.name === "soil" ? "Soil" : "Water";
  const select = h("select", { id: `colour-${series.name}`, "aria-label": `${name}: colour by` });
  select.append(h("option", { value: "" }, series.name === "soil" ? "plain" : "plain blue"));
  for (const { key, label } of series.choices) select.append(h("option", { value: key }, label));
  const bar = h("div", { class: "bar", role: "img" });
  const lowInput = h("input", { class: "range-end", inputmode: "decimal", "aria-label": `${name}: lowest value of the colour range` });
  const highInput = h("input", { class: "range-end high", inputmode: "decimal", "aria-label": `${name}: highest value of the colour range` });
  const unit = h("span", { class: "unit" });
  const note = h("span", { class: "legend-note" });
  const printed = h("span", { class: "printed" }); // for paper, where lists of choices are hidden
  const mode = h(
    "select",
    { class: "quiet", "aria-label": `${name}: range of colours`, title: "Where the range of colours comes from" },
    h("option", { value: "run" }, "whole run"),
    h("option", { value: "frame" }, "this frame"),
    h("option", { value: "fixed" }, "fixed"),
  );
  const scale = h("div", { class: "scale" }, lowInput, bar, highInput, unit);
  const names = h("div", { class: "names" });
  const element = h("div", { class: `legend ${series.name}` }, h("label", { for: select.id, class: "legend-name" }, name), printed, select, mode, scale, names, note);

  let colouring: Colouring = { field: null, low: 0, high: 1, map: flatMap(plain[series.name]), category: false };
  let shownUnit: DisplayUnit = { factor: 1, unit: "" };
  const fixed = new Map<string, [number, number]>();

  function show() {
    const { field, low, high, map, category } = colouring;
    scale.hidden = mode.hidden = !field || category;
    names.hidden = !category;
    note.textContent = field?.note ?? "";
    printed.textContent = field?.label ?? select.options[0].text;
    names.replaceChildren();
    if (!field) return;
    if (category) {
      const colours = coloursOf(field.colours);
      field.categories.forEach((text, k) => {
        const [r, g, b] = colours[k % colours.length].map((v) => Math.round(255 * v));
        names.append(h("span", { class: "name" }, h("i", { style: `background:rgb(${r} ${g} ${b})` }), text));
      });
      return;
    }
    shownUnit = displayUnit(field.unit, Math.max(Math.abs(low), Math.abs(high)));
    lowInput.value = formatNumber(low * shownUnit.factor);
    highInput.value = formatNumber(high * shownUnit.factor);
    unit.textContent = shownUnit.unit;
    bar.style.background = cssGradient(map);
    bar.setAttribute("aria-label", `Colours from ${lowInput.value} to ${highInput.value} ${shownUnit.unit}`);
    bar.title = field.symbol ? `${field.label} ${field.symbol}` : field.label;
  }

  function applyRange(frame: number) {
    const { field } = colouring;
    if (!field || colouring.category) return;
    const range = mode.value === "fixed" ? fixed.get(field.key) ?? field.bulk : mode.value === "frame" ? frameRange(field, series, frame) : field.bulk;
    const [low, high] = mode.value === "fixed" ? range : settled(field, range);
    colouring = { ...colouring, low, high };
  }

  let lastFrame = 0;
  async function choose(key: string) {
    select.value = key;
    const field = key ? await series.field(key) : null;
    if (select.value !== key) return;
    const category = field?.scale === "category";
    const map = !field ? flatMap(plain[series.name]) : field && category ? categoryMap(coloursOf(field.colours)) : colourMap(mapFor(field));
    colouring = { field, low: 0, high: 1, map, category };
    if (mode.value === "fixed" && field && !fixed.has(field.key)) mode.value = "run";
    applyRange(lastFrame);
    show();
    changed();
  }

  const typed = (text: string) => Number(text.replace("−", "-").replace(/[\s\u202f]/g, "").replace(",", "."));
  const type = () => {
    const { field } = colouring;
    if (!field) return;
    const [low, high] = [typed(lowInput.value) / shownUnit.factor, typed(highInput.value) / shownUnit.factor];
    if (Number.isFinite(low) && Number.isFinite(high) && high > low) {
      fixed.set(field.key, [low, high]);
      mode.value = "fixed";
    }
    applyRange(lastFrame);
    show();
    changed();
  };
  select.addEventListener("change", () => void choose(select.value));
  mode.addEventListener("change", () => {
    if (mode.value === "fixed" && colouring.field) fixed.set(colouring.field.key, [colouring.low, colouring.high]);
    applyRange(lastFrame);
    show();
    changed();
  });
  lowInput.addEventListener("change", type);
  highInput.addEventListener("change", type);
  select.value = initial;

  return {
    element,
    series,
    colouring: () => colouring,
    key: () => select.value,
    choose,
    follow(frame) {
      lastFrame = frame;
      if (mode.value !== "frame") return;
      applyRange(frame);
      show();
    },
    step() {
      const keys = ["", ...series.choices.map((c) => c.key)];
      void choose(keys[(keys.indexOf(select.value) + 1) % keys.length]);
    },
  };
}
