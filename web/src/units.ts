// Numbers as people read them: few digits, a true minus, and a prefix that suits the size.

export interface DisplayUnit {
  /** Multiply a value in SI by this. */
  factor: number;
  unit: string;
}

/** The unit in which values up to `magnitude` (SI) are shown. */
export function displayUnit(unit: string, magnitude: number): DisplayUnit {
  const m = Math.abs(magnitude);
  if (unit === "Pa" || unit === "J" || unit === "N" || unit === "J/m" || unit === "N/m") {
    if (m >= 1e6) return { factor: 1e-6, unit: "M" + unit };
    if (m >= 1e3) return { factor: 1e-3, unit: "k" + unit };
  }
  if (unit === "s" && m > 0 && m < 0.1) return { factor: 1e3, unit: "ms" };
  if ((unit === "m" || unit === "m/s") && m > 1e-6 && m < 0.01) return { factor: 1e3, unit: "m" + unit };
  return { factor: 1, unit: unit.replace(/([a-z])2\b/g, "$1²").replace(/([a-z])3\b/g, "$1³") };
}

const minus = (text: string) => text.replace(/^-/, "−").replace(/e-/, "e−");

function superscript(exponent: number): string {
  return String(exponent).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(d)]);
}

/** `digits` significant digits, powers of ten for very large and very small numbers. */
export function formatNumber(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  if (size < -4 || size > 6) {
    const mantissa = (value / 10 ** size).toFixed(Math.max(0, digits - 1)).replace(/\.?0+$/, "");
    return minus(`${mantissa}·10${superscript(size)}`);
  }
  const text = value.toFixed(Math.min(8, Math.max(0, digits - 1 - size)));
  const trimmed = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  const [whole, part] = trimmed.split(".");
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, whole.replace("-", "").length > 4 ? "\u202f" : "");
  return minus(part ? `${grouped}.${part}` : grouped);
}

/** Value and unit; SI in. */
export function formatQuantity(value: number, unit: string, digits = 3): string {
  const shown = displayUnit(unit, value);
  const text = formatNumber(value * shown.factor, digits);
  return shown.unit ? `${text}\u202f${shown.unit}` : text;
}

/** Seconds as s, min or h, with the decimals that `step` (s) calls for. */
export function formatTime(seconds: number, step: number, end: number): string {
  const [factor, unit] = end >= 3 * 3600 ? [1 / 3600, "h"] : end >= 300 ? [1 / 60, "min"] : [1, "s"];
  const decimals = Math.min(4, Math.max(0, Math.ceil(-Math.log10(Math.max(1e-6, step * factor)) - 1e-9)));
  const whole = (d: number) => Math.abs(step * factor * 10 ** d - Math.round(step * factor * 10 ** d)) < 1e-6;
  const exact = !whole(decimals) && whole(decimals + 1) ? decimals + 1 : decimals;
  return `${minus((seconds * factor).toFixed(exact))}\u202f${unit}`;
}

/** Round steps for an axis: at most `most` of them between low and high. */
export function ticks(low: number, high: number, most: number): number[] {
  const span = high - low;
  if (!(span > 0) || most < 1) return [];
  const raw = span / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * (1 - 1e-9))!;
  const list: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; ++k) list.push(k * step);
  return list;
}
