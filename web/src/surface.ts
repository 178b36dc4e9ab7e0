// Where the water ends, from its points: the free surface outside the soil, the phreatic line inside it.
//
// In columns one soil spacing wide or more, the water's top is the top of the lowest unbroken stack of wet boxes, so
// that drops in the air do not count. Where no water points exist, the water's top is the highest soil point in a
// column whose pore pressure is positive.
import type { Point } from "./page";
import type { Series } from "./series";

export interface WaterLines {
  free: Point[][];
  phreatic: Point[][];
}

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
      top[c] = Math.max(top[c], soil.y[e]);
    }
  return top;
}

/** Mean of a column and its neighbours that have water, so that single points do not make steps. */
function smoothed(top: Float32Array): Float32Array {
  return top.map((v, c) => {
    if (v === -Infinity) return v;
    let [sum, n] = [0, 0];
    for (let k = Math.max(0, c - 2); k <= Math.min(top.length - 1, c + 2); ++k)
      if (top[k] > -Infinity && Math.abs(top[k] - v) < 0.25 * Math.abs(v) + 1e-9) [sum, n] = [sum + top[k], n + 1];
    return n ? sum / n : v;
  });
}

export function waterLines(size: Point, frame: number, soil: Series | undefined, water: Series | undefined): WaterLines {
  const spacing = water?.spacing ?? soil?.spacing ?? size[0] / 200;
  const columns = columnsOf(size, spacing);
  const ground = soilTop(soil, frame, columns);
  const raw = water && water.start[frame + 1] > water.start[frame] ? stackTop(water, frame, columns, size[1]) : soil ? pressureTop(soil, frame, columns) : null;
  const lines: WaterLines = { free: [], phreatic: [] };
  if (!raw) return lines;
  const level = smoothed(raw);
  let current: Point[] | null = null;
  let inSoil = false;
  let last: Point | null = null;
  for (let c = 0; c < columns.count; ++c) {
    if (level[c] === -Infinity) {
      current = last = null;
      continue;
    }
    const buried = ground[c] > level[c] + 0.5 * spacing;
    const point: Point = [columns.x0 + (c + 0.5) * columns.width, level[c]];
    if (!current || buried !== inSoil) {
      current = last ? [last, point] : [point];
      (buried ? lines.phreatic : lines.free).push(current);
      inSoil = buried;
    } else {
      current.push(point);
    }
    last = point;
  }
  return lines;
}
