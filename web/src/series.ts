// The points of one phase: tracks, and fields that are decoded when they are first looked at.
//
// Entries are stored frame after frame; within a frame by track. Decoding mirrors src/polder/report/encode.cpp.
import { readBlob } from "./inflate";
import type { FieldDescription, SetDescription } from "./page";

export const noValue = 65535;

/** A field that can be read: stored, or made from stored ones. */
export interface Field {
  readonly key: string;
  readonly label: string;
  readonly symbol: string;
  readonly unit: string;
  readonly note: string;
  readonly scale: FieldDescription["scale"];
  readonly categories: string[];
  readonly colours: string[];
  /** One value per entry; NaN where there is none. */
  readonly values: Float32Array;
  readonly low: number;
  readonly high: number;
  /** Range without the outermost half per cent on either side. */
  readonly bulk: [number, number];
}

export interface Series {
  readonly description: SetDescription;
  readonly name: "soil" | "water";
  readonly spacing: number;
  readonly frames: number;
  /** Entries of frame f are [start[f], start[f + 1]). */
  readonly start: Uint32Array;
  /** Track of each entry. */
  readonly track: Uint32Array;
  /** Entry of the same track in the next frame, or the entry itself where there is none. */
  readonly next: Uint32Array;
  readonly ids: string[];
  readonly first: Uint16Array;
  readonly x: Float32Array;
  readonly y: Float32Array;
  /** Keys that can be coloured by, in order. */
  readonly choices: { key: string; label: string }[];
  field(key: string): Promise<Field>;
  /** The field if it has been decoded already. */
  ready(key: string): Field | undefined;
}

function unpredict(bytes: Uint8Array, count: number, how: FieldDescription["prediction"], layout: Layout): Uint16Array {
  const q = new Uint16Array(count);
  const last = new Uint16Array(layout.first.length);
  const beforeLast = new Uint16Array(layout.first.length);
  const { start, track, first } = layout;
  for (let frame = 0; frame + 1 < start.length; ++frame) {
    let left = 0;
    let leftChange = 0;
    for (let entry = start[frame]; entry < start[frame + 1]; ++entry) {
      const t = track[entry];
      const age = frame - first[t];
      let guess = left;
      if (age > 0) {
        guess = last[t];
        if (how === "neighbour") guess += leftChange;
        else if (how === "linear" && age > 1) guess = 2 * guess - beforeLast[t];
      }
      const z = (bytes[entry] << 8) | bytes[count + entry];
      const value = (guess + ((z >> 1) ^ -(z & 1))) & 65535;
      leftChange = age > 0 ? value - last[t] : 0;
      left = value;
      beforeLast[t] = last[t];
      last[t] = value;
      q[entry] = value;
    }
  }
  return q;
}

interface Layout {
  start: Uint32Array;
  track: Uint32Array;
  next: Uint32Array;
  first: Uint16Array;
  ids: string[];
}

function readLayout(bytes: Uint8Array, set: SetDescription, frames: number): Layout {
  const n = set.tracks;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const ids: string[] = [];
  const first = new Uint16Array(n);
  const last = new Uint16Array(n);
  for (let t = 0; t < n; ++t) {
    ids.push(view.getBigUint64(8 * t, true).toString());
    first[t] = view.getUint16(8 * n + 2 * t, true);
    last[t] = view.getUint16(10 * n + 2 * t, true);
  }
  const start = new Uint32Array(frames + 1);
  const track = new Uint32Array(set.entries);
  const next = new Uint32Array(set.entries);
  const entryOf = new Int32Array(n).fill(-1);
  let entry = 0;
  for (let frame = 0; frame < frames; ++frame) {
    start[frame] = entry;
    for (let t = 0; t < n; ++t) {
      if (first[t] > frame || last[t] < frame) continue;
      track[entry] = t;
      next[entry] = entry;
      if (entryOf[t] >= 0) next[entryOf[t]] = entry;
      entryOf[t] = entry++;
    }
  }
  start[frames] = entry;
  return { start, track, next, first, ids };
}

function dequantise(q: Uint16Array, low: number, step: number): Float32Array {
  const values = new Float32Array(q.length);
  for (let i = 0; i < q.length; ++i) values[i] = q[i] === noValue ? NaN : low + step * q[i];
  return values;
}

function bulkRange(values: Float32Array): [number, number] {
  const stride = Math.max(1, Math.floor(values.length / 50000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += stride) if (!Number.isNaN(values[i])) sample.push(values[i]);
  if (sample.length === 0) return [0, 1];
  const sorted = Float32Array.from(sample).sort();
  const tail = Math.floor(sorted.length / 200);
  return [sorted[tail], sorted[sorted.length - 1 - tail]];
}

function describeField(d: Omit<FieldDescription, "low" | "step" | "prediction" | "blob" | "shown">, values: Float32Array): Field {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (!(low <= high)) [low, high] = [0, 1];
  const { key, label, symbol, unit, note, scale, categories, colours } = d;
  return { key, label, symbol, unit, note, scale, categories, colours, values, low, high, bulk: bulkRange(values) };
}

/** Fields made from stored ones. */
const derived = {
  speed: { key: "speed", label: "Velocity", symbol: "|v|", unit: "m/s", note: "", scale: "sequential" as const, categories: [], colours: [] },
  displacement: {
    key: "displacement",
    label: "Displacement",
    symbol: "|u|",
    unit: "m",
    note: "from where the point was first seen",
    scale: "sequential" as const,
    categories: [],
    colours: [],
  },
};

function magnitude(a: Float32Array, b: Float32Array): Float32Array {
  return a.map((v, i) => Math.hypot(v, b[i]));
}

function travelled(layout: Layout, x: Float32Array, y: Float32Array): Float32Array {
  const x0 = new Float32Array(layout.first.length);
  const y0 = new Float32Array(layout.first.length);
  const values = new Float32Array(x.length);
  for (let frame = 0; frame + 1 < layout.start.length; ++frame)
    for (let e = layout.start[frame]; e < layout.start[frame + 1]; ++e) {
      const t = layout.track[e];
      if (layout.first[t] === frame) [x0[t], y0[t]] = [x[e], y[e]];
      values[e] = Math.hypot(x[e] - x0[t], y[e] - y0[t]);
    }
  return values;
}

export async function openSeries(set: SetDescription, frames: number): Promise<Series> {
  const layout = readLayout(await readBlob(set.blob), set, frames);
  const stored = async (description: FieldDescription) => {
    const q = unpredict(await readBlob(description.blob), set.entries, description.prediction, layout);
    return dequantise(q, description.low, description.step);
  };
  const find = (key: string) => set.fields.find((f) => f.key === key);
  const x = await stored(set.fields[0]);
  const y = await stored(set.fields[1]);

  const choices = set.fields.filter((f) => f.shown).map((f) => ({ key: f.key, label: f.label }));
  const moves = find("velocity_x") && find("velocity_y");
  if (set.name === "soil" && !find("displacement")) choices.push({ key: "displacement", label: derived.displacement.label });
  if (moves) choices.push({ key: "speed", label: derived.speed.label });

  const done = new Map<string, Field>();
  const pending = new Map<string, Promise<Field>>();
  const make = async (key: string): Promise<Field> => {
    const description = find(key);
    if (description) return describeField(description, await stored(description));
    if (key === "displacement") return describeField(derived.displacement, travelled(layout, x, y));
    if (key === "speed" && moves) {
      const [vx, vy] = await Promise.all([field("velocity_x"), field("velocity_y")]);
      return describeField(derived.speed, magnitude(vx.values, vy.values));
    }
    throw new Error(`the ${set.name} has no field ${key}`);
  };
  const field = (key: string): Promise<Field> => {
    let promise = pending.get(key);
    if (!promise) {
      promise = make(key).then((f) => (done.set(key, f), f));
      pending.set(key, promise);
    }
    return promise;
  };
  return {
    description: set,
    name: set.name,
    spacing: set.spacing,
    frames,
    ...layout,
    x,
    y,
    choices,
    field,
    ready: (key) => done.get(key),
  };
}
