// The player: the moving picture, its controls, and what the pointer reads.
import { cssColour, h, iconButton, setIcon, symbol } from "./dom";
import { type Clock, makeClock } from "./clock";
import { type Legend, makeLegend } from "./legend";
import { drawOverlay, type Shown } from "./overlay";
import type { Page } from "./page";
import { animationType, type Picture, record, savePicture, type Recording } from "./picture";
import { type Layer, type Scene, toScreen } from "./scene";
import type { Series } from "./series";
import { type Box, makeStage } from "./stage";
import { formatQuantity, formatTime } from "./units";

export interface Player {
  element: HTMLElement;
  clock: Clock;
  legends: Legend[];
  redraw: () => void;
  /** Calls `f` whenever the time has changed. */
  onTime: (f: () => void) => void;
  timeText: () => string;
  painter: () => string;
  /** Where a point of the section is on the stage, CSS pixels. */
  screenOf: (x: number, y: number) => { x: number; y: number };
  /** For keys: true where the key was used. */
  key: (event: KeyboardEvent) => boolean;
}

interface Found {
  series: Series;
  entry: number;
}

const firstChoice: Record<Series["name"], string[]> = {
  soil: ["deviatoric_strain", "plastic_strain", "displacement", "porosity"],
  water: [],
};

function boundsOf(list: Series[], every: number): Box | null {
  const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (const s of list)
    for (let e = 0; e < s.x.length; e += every) {
      box.x0 = Math.min(box.x0, s.x[e]);
      box.x1 = Math.max(box.x1, s.x[e]);
      box.y0 = Math.min(box.y0, s.y[e]);
      box.y1 = Math.max(box.y1, s.y[e]);
    }
  return box.x1 > box.x0 ? box : null;
}

/** Height that the points reach at the start, or that all but a few thrown-up ones reach later. */
function topOf(list: Series[]): number {
  let first = 0;
  const heights: number[] = [];
  for (const s of list) {
    for (let e = 0; e < s.start[1]; ++e) first = Math.max(first, s.y[e]);
    const every = Math.max(1, Math.floor(s.y.length / 20000));
    for (let e = 0; e < s.y.length; e += every) heights.push(s.y[e]);
  }
  heights.sort((a, b) => a - b);
  return Math.max(first, heights[Math.floor(0.998 * (heights.length - 1))] ?? 0);
}

/** What the run fills, and some air over it; a section that is mostly air would show its soil small. */
function homeBox(page: Page, soil: Series | undefined, water: Series | undefined): Box {
  const [width, height] = page.size;
  const all = { x0: 0, y0: 0, x1: width, y1: height };
  const filled = topOf([soil, water].filter((s): s is Series => s !== undefined));
  if (filled <= 0) return all;
  const levels = page.levels.flatMap(({ line, head }) => (line.some(([, y]) => y > filled / 2) ? head.map(([, y]) => y) : []));
  const top = Math.max(filled, ...levels);
  const home = { ...all, y1: Math.min(height, 1.12 * top) };
  // On a narrow screen a long section would be a thread: begin at the soil instead.
  const body = window.innerWidth <= 640 && width > 2.5 * home.y1 && soil && boundsOf([soil], 1);
  if (!body) return home;
  const air = 0.06 * (body.x1 - body.x0);
  return { x0: Math.max(0, body.x0 - air), x1: Math.min(width, body.x1 + air), y0: 0, y1: Math.min(home.y1, body.y1 + air) };
}

export function makePlayer(page: Page, all: Series[]): Player {
  const soil = all.find((s) => s.name === "soil" && s.x.length > 0);
  const water = all.find((s) => s.name === "water" && s.x.length > 0);
  const layers = [water, soil].filter((s): s is Series => s !== undefined);
  const times = page.times;
  const end = times[times.length - 1] ?? 0;
  const step = times.length > 1 ? (end - times[0]) / (times.length - 1) : 1;
  const timeText = () => formatTime(clock.time(), step, end);
  const listeners: (() => void)[] = [];
  const shown: Shown = { outline: true, water: true, monitors: true, soilArrows: false, waterArrows: false };
  const visible: Record<Series["name"], boolean> = { soil: true, water: true };
  let smooth = false;
  let found: Found | null = null;
  let scheduled = false;
  let recording: Recording | null = null;
  let shownPlaying = false;
  let wasPlaying = false;

  const home = homeBox(page, soil, water);
  const stage = makeStage({ size: page.size, redraw: () => redraw(), point: (at) => point(at), home: () => home });
  const pen = stage.overlay.getContext("2d")!;
  const clockText = h("output", { class: "clock" });
  const tip = h("div", { class: "tip", role: "status", hidden: true });
  stage.element.append(clockText, tip);

  const legends = [soil, water].filter((s): s is Series => s !== undefined).map((series) => {
    const key = firstChoice[series.name].find((k) => series.choices.some((c) => c.key === k)) ?? "";
    return makeLegend(series, key, redraw);
  });
  const legendOf = (series: Series) => legends.find((l) => l.series === series)!;

  const clock = makeClock(times, () => {
    scrubber.value = String(clock.place);
    scrubber.setAttribute("aria-valuetext", timeText());
    // Only on a change: an icon that is replaced under the pointer swallows its click.
    if (clock.playing !== shownPlaying) {
      shownPlaying = clock.playing;
      setIcon(playButton, clock.playing ? "pause" : "play", clock.playing ? "Pause (space)" : "Play (space)");
    }
    for (const l of legends) l.follow(clock.frame);
    for (const f of listeners) f();
    if (wasPlaying && !clock.playing && recording) stopRecording();
    wasPlaying = clock.playing;
    redraw();
  });

  function scene(): Scene {
    const drawn: Layer[] = layers.filter((s) => visible[s.name]).map((series) => {
      const { field, low, high, map, category } = legendOf(series).colouring();
      return { series, values: field?.values ?? null, low, high, map, category, opacity: 1 };
    });
    const missing = cssColour("--missing").split(" ").map((v) => Number(v) / 255) as [number, number, number];
    return { layers: drawn, frame: clock.frame, blend: clock.place - clock.frame, smooth, camera: stage.camera, missing };
  }

  function draw() {
    scheduled = false;
    const painter = stage.painter();
    if (!painter || stage.camera.width < 2) return;
    painter.draw(scene());
    const at = found && found.series.start[clock.frame] <= found.entry && found.entry < found.series.start[clock.frame + 1] ? found : null;
    drawOverlay(pen, stage.element.clientWidth, stage.element.clientHeight, stage.ratio(), {
      page,
      camera: stage.camera,
      frame: clock.frame,
      blend: clock.place - clock.frame,
      time: times[clock.frame] ?? 0,
      soil: visible.soil ? soil : undefined,
      water: visible.water ? water : undefined,
      shown,
      marked: at && { x: at.series.x[at.entry], y: at.series.y[at.entry], size: at.series.spacing * stage.camera.scale },
    });
    clockText.textContent = timeText();
    if (!at) tip.hidden = true;
    recording?.add();
  }

  function redraw() {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(draw);
  }

  function nearest(px: number, py: number): Found | null {
    let best: Found | null = null;
    for (const series of [...layers].reverse()) {
      if (!visible[series.name]) continue;
      const reach = Math.max(8, series.spacing * stage.camera.scale);
      let least = reach * reach;
      for (let e = series.start[clock.frame]; e < series.start[clock.frame + 1]; ++e) {
        const [x, y] = toScreen(stage.camera, series.x[e], series.y[e]);
        const d = (x - px) ** 2 + (y - py) ** 2;
        if (d < least) [least, best] = [d, { series, entry: e }];
      }
      if (best) return best;
    }
    return null;
  }

  async function point(at: { px: number; py: number; firm: boolean } | null) {
    const hit = at && nearest(at.px, at.py);
    found = hit;
    redraw();
    if (!at || !hit) {
      tip.hidden = true;
      return;
    }
    const fields = await Promise.all(hit.series.choices.map((c) => hit.series.field(c.key)));
    if (found !== hit) return;
    const rows = fields.map((f) => {
      const v = f.values[hit.entry];
      const text = f.scale === "category" ? f.categories[v] ?? String(v) : Number.isNaN(v) ? "–" : formatQuantity(v, f.unit, 4);
      return h("tr", {}, h("th", { scope: "row" }, f.label), h("td", { class: "symbol" }, symbol(f.symbol)), h("td", {}, text));
    });
    const { series, entry } = hit;
    const head = `${series.name === "soil" ? "Soil" : "Water"} point ${series.ids[series.track[entry]]}`;
    const where = `x ${formatQuantity(series.x[entry], "m", 4)}, y ${formatQuantity(series.y[entry], "m", 4)}`;
    tip.replaceChildren(h("strong", {}, head), h("span", { class: "where" }, where), h("table", {}, h("tbody", {}, ...rows)));
    tip.hidden = false;
    const { clientWidth, clientHeight } = stage.element;
    const right = at.px + 18 + tip.offsetWidth < clientWidth;
    tip.style.left = `${Math.max(0, right ? at.px + 18 : Math.min(at.px - 18, clientWidth) - tip.offsetWidth)}px`;
    tip.style.top = `${Math.max(0, Math.min(at.py - 20, clientHeight - tip.offsetHeight))}px`;
  }

  // Controls
  const playButton = iconButton("play", "Play (space)", () => (clock.playing ? clock.pause() : clock.play()));
  playButton.classList.add("play");
  const scrubber = h("input", { type: "range", class: "scrubber", min: 0, max: Math.max(1e-6, times.length - 1), step: 0.001, value: 0, "aria-label": "Time" });
  scrubber.addEventListener("input", () => {
    if (clock.playing) clock.pause();
    clock.seek(Math.round(Number(scrubber.value)));
  });
  const speeds: [string, number][] = [
    ["5 s", 5],
    ["10 s", 10],
    ["20 s", 20],
    ["1 min", 60],
  ];
  const real = end - (times[0] ?? 0);
  if (real >= 2 && real <= 120) speeds.push(["real time", real]);
  const speed = h("select", { class: "quiet", "aria-label": "How long the whole run plays", title: "How long the whole run plays" });
  for (const [text, seconds] of speeds) speed.append(h("option", { value: seconds }, text));
  speed.addEventListener("change", () => (clock.duration = Number(speed.value)));
  speed.value = "10";
  clock.duration = 10;

  const saveName = () => `${page.title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "polder"}`;
  const picture = (): Picture => ({
    width: stage.element.clientWidth,
    height: stage.element.clientHeight,
    ratio: stage.ratio(),
    layers: () => [stage.points, stage.overlay],
    title: page.title,
    time: () => `t = ${timeText()}`,
    legends,
  });
  const pictureButton = iconButton("picture", "Save picture (PNG)", () => void savePicture(picture(), `${saveName()}-${clock.time().toFixed(2)}s.png`));
  const animation = animationType();
  const filmButton = iconButton("film", "Save animation", () => {
    if (recording) return clock.playing ? clock.pause() : undefined;
    clock.pause();
    clock.seek(0);
    recording = record(picture(), animation!, saveName());
    filmButton.classList.add("recording");
    setIcon(filmButton, "film", "Stop recording and save");
    const current = recording;
    void current.ready.then(() => recording === current && clock.play());
  });
  function stopRecording() {
    const r = recording!;
    recording = null;
    setTimeout(() => r.stop(), 300);
    filmButton.classList.remove("recording");
    setIcon(filmButton, "film", "Save animation");
  }

  const check = (text: string, on: boolean, set: (on: boolean) => void, key?: string) => {
    const box = h("input", { type: "checkbox", onchange: () => (set(box.checked), redraw()) });
    box.checked = on;
    return { box, row: h("label", { class: "check" }, box, h("span", {}, text), key ? h("kbd", {}, key) : null) };
  };
  const arrowsOn = async (series: Series | undefined) => {
    await series?.field("speed");
    redraw();
  };
  const toggles = {
    soil: soil && check("soil", true, (on) => (visible.soil = on), "S"),
    water: water && check("water", true, (on) => (visible.water = on), "W"),
    smooth: check("smooth field", false, (on) => (smooth = on), "F"),
    lines: check("water lines", true, (on) => (shown.water = on), "L"),
    outline: page.outlines.length ? check("initial outline", true, (on) => (shown.outline = on), "O") : undefined,
    monitors: page.monitors.length ? check("monitors", true, (on) => (shown.monitors = on), "M") : undefined,
    soilArrows: soil?.choices.some((c) => c.key === "speed")
      ? check("soil velocity", false, (on) => ((shown.soilArrows = on), void arrowsOn(soil)), "V")
      : undefined,
    waterArrows: water?.choices.some((c) => c.key === "speed")
      ? check("water velocity", false, (on) => ((shown.waterArrows = on), void arrowsOn(water)), "B")
      : undefined,
  };

  const tools = h(
    "div",
    { class: "tools", role: "group", "aria-label": "View" },
    iconButton("plus", "Zoom in (+)", () => stage.zoom(1.4)),
    iconButton("minus", "Zoom out (−)", () => stage.zoom(1 / 1.4)),
    iconButton("fit", "Show all (0)", () => stage.fit({ x0: 0, y0: 0, x1: page.size[0], y1: page.size[1] })),
    pictureButton,
    animation ? filmButton : null,
  );
  const transport = h(
    "div",
    { class: "transport" },
    playButton,
    iconButton("back", "One frame back (←)", () => move(-1)),
    iconButton("forward", "One frame on (→)", () => move(1)),
    scrubber,
    h("label", { class: "speed" }, h("span", {}, "run in"), speed),
    tools,
  );
  const layersRow = h("fieldset", { class: "layers" }, h("legend", { class: "hidden" }, "What is drawn"));
  for (const t of Object.values(toggles)) if (t) layersRow.append(t.row);

  const element = h(
    "section",
    { class: "player", "aria-label": "Player" },
    stage.element,
    transport,
    h("div", { class: "legends" }, ...legends.map((l) => l.element)),
    layersRow,
  );
  stage.points.setAttribute("aria-label", `The run, moving: ${page.title}. Space plays, the arrow keys step.`);

  function move(frames: number) {
    if (clock.playing) clock.pause();
    clock.seek(Math.round(clock.place) + frames);
  }

  function key(event: KeyboardEvent): boolean {
    const flip = (t: { box: HTMLInputElement } | undefined) => (t && !t.box.disabled ? (t.box.click(), true) : false);
    const far = Math.max(1, Math.round(times.length / 10));
    const pan = event.shiftKey;
    const actions: Record<string, () => unknown> = {
      " ": () => (clock.playing ? clock.pause() : clock.play()),
      ArrowLeft: () => (pan ? stage.pan(40, 0) : move(-1)),
      ArrowRight: () => (pan ? stage.pan(-40, 0) : move(1)),
      PageUp: () => move(-far),
      PageDown: () => move(far),
      Home: () => move(-times.length),
      End: () => move(times.length),
      "+": () => stage.zoom(1.25),
      "=": () => stage.zoom(1.25),
      "-": () => stage.zoom(1 / 1.25),
      "0": () => stage.fit({ x0: 0, y0: 0, x1: page.size[0], y1: page.size[1] }),
      c: () => legends[0]?.step(),
      C: () => legends[1]?.step(),
      s: () => flip(toggles.soil),
      w: () => flip(toggles.water),
      f: () => flip(toggles.smooth),
      l: () => flip(toggles.lines),
      o: () => flip(toggles.outline),
      m: () => flip(toggles.monitors),
      v: () => flip(toggles.soilArrows),
      b: () => flip(toggles.waterArrows),
      p: () => pictureButton.click(),
    };
    if (pan && event.key === "ArrowUp") actions.ArrowUp = () => stage.pan(0, 40);
    if (pan && event.key === "ArrowDown") actions.ArrowDown = () => stage.pan(0, -40);
    const action = actions[event.key];
    action?.();
    return action !== undefined;
  }

  for (const l of legends) void l.choose(l.key());
  // Without water points the phreatic line comes from the pressures.
  if (soil && !water && soil.choices.some((c) => c.key === "pore_pressure")) void soil.field("pore_pressure").then(redraw);
  return {
    element,
    clock,
    legends,
    redraw,
    onTime: (f) => listeners.push(f),
    timeText,
    painter: () => stage.painter().kind,
    screenOf(x, y) {
      const [px, py] = toScreen(stage.camera, x, y);
      return { x: px, y: py };
    },
    key,
  };
}
