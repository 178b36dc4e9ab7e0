// Curves of history.csv over time, tied to the player's clock: a line shows its time, a click sets it.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { cssColour, h, set } from "./dom";
import type { Page } from "./page";
import type { Player } from "./player";
import { displayUnit, formatNumber, formatQuantity } from "./units";

interface Curve {
  name: string;
  unit: string;
  values: (number | null)[];
}

interface Group {
  title: string;
  unit: string;
  curves: Curve[];
}

/** "energy: kinetic" and "energy: potential" share a chart; so do "crest, x" and "crest, y" of one unit. */
function stemOf(name: string): string {
  const cut = name.search(/[:,(]/);
  return cut > 0 ? name.slice(0, cut).trim() : name;
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
const words = (name: string) => capital(name.replace(/_/g, " "));

export function groupCurves(page: Page): Group[] {
  const groups = new Map<string, Group>();
  page.history.columns.forEach(({ name, unit }, k) => {
    const values = page.history.values[k];
    if (k === 0 || !values.some((v) => v !== null)) return;
    const id = `${stemOf(name)}|${unit}`;
    const group = groups.get(id) ?? { title: words(stemOf(name)), unit, curves: [] };
    group.curves.push({ name, unit, values });
    groups.set(id, group);
  });
  return [...groups.values()];
}

const inks = ["--series-1", "--series-2", "--series-3", "--series-4", "--series-5", "--series-6"];

function partName(group: Group, curve: Curve): string {
  const rest = curve.name.slice(stemOf(curve.name).length).replace(/^[:,(\s]+|\)$/g, "");
  return group.curves.length === 1 ? words(curve.name) : rest || curve.name;
}

interface Chart {
  element: HTMLElement;
  build: () => void;
  mark: (time: number) => void;
}

function makeChart(group: Group, times: number[], player: Player, timeUnit: { factor: number; unit: string }): Chart {
  const most = Math.max(...group.curves.flatMap((c) => c.values.map((v) => Math.abs(v ?? 0))));
  const unit = displayUnit(group.unit, most);
  const x = times.map((t) => t * timeUnit.factor);
  const data = [x, ...group.curves.map((c) => c.values.map((v) => (v === null ? null : v * unit.factor)))] as uPlot.AlignedData;
  const readings = group.curves.map(() => h("b"));
  const single = group.curves.length === 1;
  const keys = group.curves.map((curve, k) =>
    h("span", { class: "key" }, single ? null : h("i", { style: `background:var(${inks[k % inks.length]})` }), single ? null : partName(group, curve), readings[k]),
  );
  const title = single ? words(group.curves[0].name) : group.title;
  const place = h("div", { class: "plot" });
  const line = h("div", { class: "now" });
  const element = h(
    "figure",
    { class: "chart" },
    h("figcaption", {}, h("span", { class: "chart-title" }, title), unit.unit ? h("span", { class: "unit" }, unit.unit) : null, h("span", { class: "keys" }, ...keys)),
    place,
  );
  let plot: uPlot | null = null;

  function build() {
    plot?.destroy();
    const axis = (size: number): uPlot.Axis => ({
      stroke: cssColour("--muted"),
      font: '12px "Source Sans 3", system-ui, sans-serif',
      grid: { stroke: cssColour("--grid"), width: 1 },
      ticks: { stroke: cssColour("--grid"), width: 1, size: 4 },
      size,
      gap: 4,
      values: (_, splits) => splits.map((v) => formatNumber(v, 5)),
    });
    plot = new uPlot(
      {
        width: Math.max(120, place.clientWidth),
        height: 150,
        padding: [8, 14, 0, 0],
        scales: { x: { time: false } },
        legend: { show: false },
        cursor: { y: false, points: { size: 6 }, drag: { x: false, y: false } },
        axes: [{ ...axis(26), space: 50 }, { ...axis(52), space: 26 }],
        series: [
          {},
          ...group.curves.map((_, k) => ({
            stroke: cssColour(inks[k % inks.length]),
            width: 1.75,
            points: { show: x.length < 3 },
          })),
        ],
      },
      data,
      place,
    );
    plot.over.append(line);
    plot.over.addEventListener("click", () => {
      const k = plot?.cursor.idx;
      if (k != null) player.clock.seekTime(times[k]);
    });
    mark(player.clock.time());
  }

  function mark(time: number) {
    if (!plot) return;
    const px = plot.valToPos(time * timeUnit.factor, "x");
    line.style.transform = `translateX(${px}px)`;
    let k = 0;
    while (k + 1 < times.length && times[k + 1] <= time + 1e-9) ++k;
    group.curves.forEach((curve, c) => {
      const v = curve.values[k];
      readings[c].replaceChildren(set(v === null || v === undefined ? "–" : formatQuantity(v, group.unit, 3)));
    });
  }
  let width = 0;
  new ResizeObserver(() => {
    if (place.clientWidth === width || place.clientWidth === 0) return;
    width = place.clientWidth;
    if (plot) {
      plot.setSize({ width, height: 150 });
      mark(player.clock.time());
    } else build();
  }).observe(place);
  place.setAttribute("role", "img");
  place.setAttribute("aria-label", `${title} over time`);
  return { element, build, mark };
}

export function makeCurves(page: Page, player: Player): { element: HTMLElement; rebuild: () => void } | null {
  const times = (page.history.values[0] ?? []).map((t) => t ?? 0);
  const groups = times.length > 0 ? groupCurves(page) : [];
  if (groups.length === 0) return null;
  const end = times[times.length - 1];
  const timeUnit = end >= 3 * 3600 ? { factor: 1 / 3600, unit: "h" } : end >= 300 ? { factor: 1 / 60, unit: "min" } : { factor: 1, unit: "s" };
  const still = (g: Group) => g.curves.every((c) => c.values.every((v) => v === null || v === c.values[0]));
  const unchanged = groups.filter(still).flatMap((g) => g.curves.map((c) => `${words(c.name)} ${formatQuantity(c.values[0] ?? 0, c.unit)}`));
  const charts = groups.filter((g) => !still(g)).map((g) => makeChart(g, times, player, timeUnit));
  player.onTime(() => {
    for (const c of charts) c.mark(player.clock.time());
  });
  const element = h(
    "section",
    { class: "curves", id: "curves" },
    h("h2", {}, "Curves"),
    h("p", { class: "lead" }, `Time in ${timeUnit.unit}. The line is the player's time; a click on a curve takes the player there.`),
    h("div", { class: "charts" }, ...charts.map((c) => c.element)),
    unchanged.length ? h("p", { class: "lead unchanged" }, `The same in every row: ${unchanged.join("; ")}.`) : null,
  );
  return { element, rebuild: () => charts.forEach((c) => c.build()) };
}
