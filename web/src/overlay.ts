// What lies over the points: axes, the initial outline, walls, water lines, arrows, monitors. Drawn on a 2D canvas.
import { cssColour } from "./dom";
import type { Page, Point } from "./page";
import { type Camera, toScreen, toWorld } from "./scene";
import type { Series } from "./series";
import { waterLines } from "./surface";
import { formatNumber, ticks } from "./units";

export interface Shown {
  outline: boolean;
  water: boolean;
  monitors: boolean;
  soilArrows: boolean;
  waterArrows: boolean;
}

export interface OverlayInput {
  page: Page;
  camera: Camera;
  frame: number;
  blend: number;
  /** s */
  time: number;
  soil?: Series;
  water?: Series;
  shown: Shown;
  /** Where the pointer has found a point. */
  marked: { x: number; y: number; size: number } | null;
}

const font = (size: number, weight = 400) => `${weight} ${size}px "Source Sans 3", system-ui, sans-serif`;

function polyline(pen: CanvasRenderingContext2D, camera: Camera, points: Point[]) {
  points.forEach(([x, y], k) => {
    const [px, py] = toScreen(camera, x, y);
    if (k) pen.lineTo(px, py);
    else pen.moveTo(px, py);
  });
}

function axes(pen: CanvasRenderingContext2D, { camera, page }: OverlayInput) {
  const { left, top, width, height } = camera;
  const [x0, y1] = toWorld(camera, left, top);
  const [x1, y0] = toWorld(camera, left + width, top + height);
  pen.strokeStyle = cssColour("--axis");
  pen.fillStyle = cssColour("--muted");
  pen.lineWidth = 1;
  pen.font = font(12);
  pen.beginPath();
  pen.moveTo(left + 0.5, top);
  pen.lineTo(left + 0.5, top + height + 0.5);
  pen.lineTo(left + width, top + height + 0.5);
  pen.textBaseline = "top";
  pen.textAlign = "center";
  const across = ticks(x0, x1, width / 80);
  const labelled = across.filter((x) => toScreen(camera, x, 0)[0] < left + width - 8);
  for (const x of across) {
    const px = Math.round(toScreen(camera, x, 0)[0]) + 0.5;
    pen.moveTo(px, top + height);
    pen.lineTo(px, top + height + 4);
    if (!labelled.includes(x)) continue;
    pen.fillText(formatNumber(x, 6) + (x === labelled[labelled.length - 1] ? "\u202fm" : ""), px, top + height + 7);
  }
  pen.textBaseline = "middle";
  pen.textAlign = "right";
  for (const y of ticks(y0, y1, height / 42)) {
    const py = Math.round(toScreen(camera, 0, y)[1]) + 0.5;
    pen.moveTo(left, py);
    pen.lineTo(left - 4, py);
    if (py > top + 6) pen.fillText(formatNumber(y, 6), left - 7, py);
  }
  pen.stroke();
  pen.strokeStyle = cssColour("--line");
  pen.beginPath();
  polyline(pen, camera, [[0, page.size[1]], [0, 0], [page.size[0], 0], [page.size[0], page.size[1]]]);
  clipped(pen, camera, () => pen.stroke());
}

function clipped(pen: CanvasRenderingContext2D, { left, top, width, height }: Camera, draw: () => void) {
  pen.save();
  const path = new Path2D();
  path.rect(left, top, width, height);
  pen.clip(path);
  draw();
  pen.restore();
}

function outlines(pen: CanvasRenderingContext2D, { camera, page, shown }: OverlayInput) {
  pen.strokeStyle = cssColour("--ink");
  pen.lineJoin = "round";
  pen.lineWidth = 3;
  pen.setLineDash([]);
  for (const wall of page.walls) {
    pen.beginPath();
    polyline(pen, camera, wall);
    pen.stroke();
  }
  if (!shown.outline) return;
  pen.lineWidth = 1.25;
  pen.setLineDash([5, 4]);
  for (const outline of page.outlines) {
    pen.beginPath();
    polyline(pen, camera, outline);
    pen.stroke();
  }
  pen.setLineDash([]);
}

/** The draughtsman's sign of a water level: a triangle on the line and two strokes below. */
function levelSign(pen: CanvasRenderingContext2D, x: number, y: number) {
  pen.beginPath();
  pen.moveTo(x, y - 1);
  pen.lineTo(x - 6, y - 11);
  pen.lineTo(x + 6, y - 11);
  pen.closePath();
  pen.fill();
  pen.beginPath();
  pen.moveTo(x - 6, y + 4);
  pen.lineTo(x + 6, y + 4);
  pen.moveTo(x - 3.5, y + 7);
  pen.lineTo(x + 3.5, y + 7);
  pen.stroke();
}

function water(pen: CanvasRenderingContext2D, { page, camera, frame, time, soil, water: points }: OverlayInput) {
  const { free, phreatic, standing } = waterLines(page, time, frame, soil, points);
  pen.fillStyle = cssColour("--still-water");
  for (const outline of standing) {
    pen.beginPath();
    polyline(pen, camera, outline);
    pen.fill();
  }
  pen.strokeStyle = pen.fillStyle = cssColour("--water-line");
  pen.lineWidth = 1.75;
  pen.lineJoin = "round";
  for (const line of free) {
    pen.beginPath();
    polyline(pen, camera, line);
    pen.stroke();
  }
  pen.setLineDash([7, 4]);
  for (const line of phreatic) {
    pen.beginPath();
    polyline(pen, camera, line);
    pen.stroke();
  }
  pen.setLineDash([]);
  pen.lineWidth = 1.25;
  const byLength = (a: Point[], b: Point[]) => b.length - a.length;
  const longest = free.filter((line) => line.length > 7).sort(byLength)[0] ?? phreatic.sort(byLength)[0];
  if (longest) levelSign(pen, ...toScreen(camera, ...longest[Math.floor(longest.length / 2)]));
}

/** Mean velocities over squares of the screen; the fastest half per cent of the run is one square long. */
function arrows(pen: CanvasRenderingContext2D, series: Series, colour: string, { camera, frame }: OverlayInput) {
  const vx = series.ready("velocity_x");
  const vy = series.ready("velocity_y");
  const speed = series.ready("speed");
  if (!vx || !vy || !speed) return;
  const square = 30;
  const top = speed.bulk[1] || speed.high || 1;
  const across = Math.ceil(camera.width / square);
  const sums = new Map<number, [number, number, number, number, number]>();
  for (let e = series.start[frame]; e < series.start[frame + 1]; ++e) {
    const [px, py] = toScreen(camera, series.x[e], series.y[e]);
    const [i, j] = [Math.floor((px - camera.left) / square), Math.floor((py - camera.top) / square)];
    if (i < 0 || i >= across || j < 0 || py > camera.top + camera.height || Number.isNaN(vx.values[e])) continue;
    const s = sums.get(j * across + i) ?? [0, 0, 0, 0, 0];
    s[0] += px;
    s[1] += py;
    s[2] += vx.values[e];
    s[3] += vy.values[e];
    s[4] += 1;
    sums.set(j * across + i, s);
  }
  const draw = (width: number, stroke: string) => {
    pen.strokeStyle = stroke;
    pen.lineWidth = width;
    pen.lineCap = "round";
    pen.beginPath();
    for (const [px, py, ux, uy, n] of sums.values()) {
      const length = Math.min(1.5, Math.hypot(ux, uy) / n / top) * square;
      if (length < 2) continue;
      const angle = Math.atan2(-uy, ux);
      const [x, y] = [px / n, py / n];
      const [ex, ey] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
      const head = Math.min(6, 0.4 * length);
      pen.moveTo(x, y);
      pen.lineTo(ex, ey);
      pen.moveTo(ex - head * Math.cos(angle - 0.5), ey - head * Math.sin(angle - 0.5));
      pen.lineTo(ex, ey);
      pen.lineTo(ex - head * Math.cos(angle + 0.5), ey - head * Math.sin(angle + 0.5));
    }
    pen.stroke();
  };
  draw(2.75, cssColour("--halo"));
  draw(1.4, colour);
}

interface Label {
  text: string;
  px: number;
  py: number;
}

/** Monitors at one place share a label. */
function labelsOf(page: Page, camera: Camera): Label[] {
  const labels: Label[] = [];
  for (const { name, points } of page.monitors) {
    if (!points.length) continue;
    const [px, py] = toScreen(camera, ...points[0]);
    const near = labels.find((l) => Math.hypot(l.px - px, l.py - py) < 6);
    if (near) near.text += `, ${name}`;
    else labels.push({ text: name, px, py });
  }
  return labels;
}

/** Beside its place, where it covers no other label and leaves the plot least. */
function placeLabel(pen: CanvasRenderingContext2D, { text, px, py }: Label, camera: Camera, taken: number[][]): [number, number] {
  const w = pen.measureText(text).width;
  const places = [[7, -4], [7, 18], [-7 - w, -4], [-7 - w, 18], [7, 34], [7, -20]].map(([dx, dy]) => [px + dx, py + dy]);
  const free = places.find(
    ([x, y]) => x >= camera.left && x + w <= camera.left + camera.width && taken.every(([l, t, r, b]) => x > r || x + w < l || y < t || y - 15 > b),
  );
  const [x, y] = free ?? places[0];
  taken.push([x, y - 15, x + w, y]);
  return [x, y];
}

function monitors(pen: CanvasRenderingContext2D, { page, camera }: OverlayInput) {
  pen.lineWidth = 1.5;
  for (const monitor of page.monitors) {
    const places = monitor.points.map(([x, y]) => toScreen(camera, x, y));
    if (!places.length) continue;
    pen.strokeStyle = cssColour("--accent");
    pen.fillStyle = cssColour("--panel");
    pen.beginPath();
    if (places.length > 1) polyline(pen, camera, monitor.points);
    pen.stroke();
    for (const [px, py] of places) {
      pen.beginPath();
      pen.arc(px, py, 4, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }
  if (camera.width < 520) return;
  pen.font = font(12, 600);
  pen.textAlign = "left";
  pen.textBaseline = "bottom";
  const taken: number[][] = [];
  for (const label of labelsOf(page, camera)) {
    const [x, y] = placeLabel(pen, label, camera, taken);
    pen.lineWidth = 3;
    pen.strokeStyle = cssColour("--halo");
    pen.strokeText(label.text, x, y);
    pen.fillStyle = cssColour("--ink");
    pen.fillText(label.text, x, y);
  }
}

export function drawOverlay(pen: CanvasRenderingContext2D, width: number, height: number, ratio: number, input: OverlayInput) {
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  axes(pen, input);
  clipped(pen, input.camera, () => {
    outlines(pen, input);
    if (input.shown.water) water(pen, input);
    if (input.shown.waterArrows && input.water) arrows(pen, input.water, cssColour("--water-line"), input);
    if (input.shown.soilArrows && input.soil) arrows(pen, input.soil, cssColour("--ink"), input);
    if (input.shown.monitors) monitors(pen, input);
    if (input.marked) {
      const [px, py] = toScreen(input.camera, input.marked.x, input.marked.y);
      for (const [w, colour] of [[4, cssColour("--halo")], [1.75, cssColour("--ink")]] as const) {
        pen.lineWidth = w;
        pen.strokeStyle = colour;
        pen.beginPath();
        pen.arc(px, py, Math.max(5, input.marked.size / 2 + 2), 0, 2 * Math.PI);
        pen.stroke();
      }
    }
  });
}
