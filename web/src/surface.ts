// Where the water ends, from its points: the free surface outside the soil, the phreatic line inside it.
//
// In columns one soil spacing wide or more, the water's top is the top of the lowest unbroken stack of wet boxes, so
// that drops in the air do not count. Where no water points exist, the water's top is where the pore pressure over the
// highest soil point with a positive one would be nought, or the level that is given for the ground of the column.
import type { Page, Point } from "./page";
import type { Series } from "./series";

export interface WaterLines {
  free: Point[][];
  phreatic: Point[][];
  /** Outlines of still water on the ground that has a given level and no points. */
  standing: Point[][];
}

const unitWeight = 9810; // N/m³, for a fraction of a point's spacing

interface Columns {
  count: number;
  width: number;
  x0: number;
}

function columnsOf(size: Point, spacing: number): Columns {
  const width = Math.max(2 * spacing, size[0] / 400);
  return { count: Math.max(1, Math.ceil(size[0] / width)), width, x0: 0 };
}

const columnOf = (c: Columns, x: number) => Math.min(c.count - 1, Math.max(0, Math.floor((x - c.x0) / c.width)));

function soilTop(soil: Series | undefined, frame: number, columns: Columns): Float32Array {
  const top = new Float32Array(columns.count).fill(-Infinity);
  if (!soil) return top;
  for (let e = soil.start[frame]; e < soil.start[frame + 1]; ++e) {
    const c = columnOf(columns, soil.x[e]);
    top[c] = Math.max(top[c], soil.y[e] + soil.spacing / 2);
  }
  return top;
}

function stackTop(water: Series, frame: number, columns: Columns, height: number): Float32Array {
  const boxes = Math.max(1, Math.ceil(height / columns.width) + 1);
  const peak = new Float32Array(columns.count * boxes).fill(-Infinity);
  for (let e = water.start[frame]; e < water.start[frame + 1]; ++e) {
    const box = Math.min(boxes - 1, Math.max(0, Math.floor(water.y[e] / columns.width)));
    const k = columnOf(columns, water.x[e]) * boxes + box;
    peak[k] = Math.max(peak[k], water.y[e] + water.spacing / 2);
  }
  const top = new Float32Array(columns.count).fill(-Infinity);
  for (let c = 0; c < columns.count; ++c) {
    let box = 0;
    while (box < boxes && peak[c * boxes + box] === -Infinity) ++box;
    // In the pores water points lie further apart, so one empty box does not break a stack.
    for (let gap = 0; box < boxes && gap < 2; ++box) {
      const filled = peak[c * boxes + box] > -Infinity;
      gap = filled ? 0 : gap + 1;
      if (filled) top[c] = peak[c * boxes + box];
    }
  }
  return top;
}

function pressureTop(soil: Series, frame: number, columns: Columns): Float32Array {
  const top = new Float32Array(columns.count).fill(-Infinity);
  const pressure = soil.ready("pore_pressure");
  if (!pressure) return top;
  for (let e = soil.start[frame]; e < soil.start[frame + 1]; ++e)
    if (pressure.values[e] > 0) {
      const c = columnOf(columns, soil.x[e]);
      top[c] = Math.max(top[c], soil.y[e] + Math.min(soil.spacing, pressure.values[e] / unitWeight));
    }
  return top;
}

/** A broken line at x; NaN beyond its ends. */
export function along(line: Point[], x: number): number {
  for (let k = 0; k + 1 < line.length; ++k) {
    const [[x0, y0], [x1, y1]] = [line[k], line[k + 1]];
    if (x >= Math.min(x0, x1) && x <= Math.max(x0, x1) && x0 !== x1) return y0 + ((x - x0) / (x1 - x0)) * (y1 - y0);
  }
  return NaN;
}

function levelAt(head: Point[], time: number): number {
  if (time <= head[0][0]) return head[0][1];
  const value = along(head, time);
  return Number.isNaN(value) ? head[head.length - 1][1] : value;
}

/** Whether the way from one point to another crosses a wall. */
function crosses(walls: Point[][], [ax, ay]: Point, [bx, by]: Point): boolean {
  const side = (px: number, py: number, qx: number, qy: number, x: number, y: number) => (qx - px) * (y - py) - (qy - py) * (x - px);
  return walls.some((wall) =>
    wall.some(([cx, cy], k) => {
      if (k + 1 === wall.length) return false;
      const [dx, dy] = wall[k + 1];
      return side(ax, ay, bx, by, cx, cy) * side(ax, ay, bx, by, dx, dy) <= 0 && side(cx, cy, dx, dy, ax, ay) * side(cx, cy, dx, dy, bx, by) < 0;
    }),
  );
}

/** Level of the still water over each column; −∞ where there is none. A line below the ground (a drain) carries none. */
function standingWater(levels: Page["levels"], time: number, ground: Float32Array, columns: Columns, spacing: number): { top: Float32Array; bed: Float32Array } {
  const top = new Float32Array(columns.count).fill(-Infinity);
  const bed = ground.slice();
  for (const { line, head } of levels) {
    const level = levelAt(head, time);
    for (let c = 0; c < columns.count; ++c) {
      const y = along(line, columns.x0 + (c + 0.5) * columns.width);
      // Ground that has not moved ends at the line, where its points end in steps.
      if (Math.abs(y - ground[c]) < 1.5 * spacing) bed[c] = y;
      if (y > ground[c] - 4 * spacing && level > bed[c]) top[c] = level;
    }
  }
  return { top, bed };
}

/** Median of up to five columns, so that one with a hole in its stack (few points, a thinned page) makes no spike. */
function healed(top: Float32Array, walls: Point[][], columns: Columns): Float32Array {
  const middle = (c: number): Point => [columns.x0 + (c + 0.5) * columns.width, top[c]];
  return top.map((v, c) => {
    if (v === -Infinity) return v;
    const near: number[] = [];
    for (let k = Math.max(0, c - 2); k <= Math.min(top.length - 1, c + 2); ++k)
      if (top[k] > -Infinity && (k === c || Math.abs(top[k] - v) < columns.width || !crosses(walls, middle(c), middle(k)))) near.push(top[k]);
    return near.sort((a, b) => a - b)[Math.floor(near.length / 2)];
  });
}

/** Mean of a column and its neighbours that have water, so that single points do not make steps; not through a wall. */
function smoothed(top: Float32Array, walls: Point[][], columns: Columns): Float32Array {
  const middle = (c: number): Point => [columns.x0 + (c + 0.5) * columns.width, top[c]];
  return top.map((v, c) => {
    if (v === -Infinity) return v;
    let [sum, n] = [0, 0];
    for (let k = Math.max(0, c - 2); k <= Math.min(top.length - 1, c + 2); ++k)
      if (top[k] > -Infinity && Math.abs(top[k] - v) < 0.25 * Math.abs(v) + 1e-9 && !crosses(walls, middle(c), middle(k))) [sum, n] = [sum + top[k], n + 1];
    return n ? sum / n : v;
  });
}

export function waterLines(page: Page, time: number, frame: number, soil: Series | undefined, water: Series | undefined): WaterLines {
  const spacing = water?.spacing ?? soil?.spacing ?? page.size[0] / 200;
  const columns = columnsOf(page.size, spacing);
  const ground = soilTop(soil, frame, columns);
  const lines: WaterLines = { free: [], phreatic: [], standing: [] };
  const raw = water && water.start[frame + 1] > water.start[frame] ? stackTop(water, frame, columns, page.size[1]) : soil ? pressureTop(soil, frame, columns) : null;
  if (!raw) return lines;
  const level = smoothed(healed(raw, page.walls, columns), page.walls, columns);
  const { top: stands, bed } = standingWater(page.levels, time, ground, columns, spacing);
  let current: Point[] | null = null;
  let inSoil = false;
  let last: Point | null = null;
  let pool: Point[] = [];
  const closePool = () => {
    if (pool.length > 1) lines.standing.push([...pool.map(([x]): Point => [x, stands[columnOf(columns, x)]]), ...pool.reverse()]);
    pool = [];
  };
  for (let c = 0; c < columns.count; ++c) {
    const pooled = stands[c] > -Infinity;
    const x = columns.x0 + (c + 0.5) * columns.width;
    if (pooled) {
      // To the edge of the section.
      if (c === 0) pool.push([0, bed[0]]);
      pool.push([x, bed[c]]);
      if (c === columns.count - 1) pool.push([page.size[0], bed[c]]);
    } else closePool();
    const top = pooled ? stands[c] : level[c];
    if (top === -Infinity) {
      current = last = null;
      continue;
    }
    const buried = !pooled && ground[c] > top + 0.5 * spacing;
    const point: Point = [x, top];
    if (last && crosses(page.walls, last, point)) current = last = null;
    if (!current || buried !== inSoil) {
      current = last ? [last, point] : [point];
      (buried ? lines.phreatic : lines.free).push(current);
      inSoil = buried;
    } else {
      current.push(point);
    }
    last = point;
  }
  closePool();
  return lines;
}
