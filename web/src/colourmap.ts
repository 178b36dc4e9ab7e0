// Colour maps in OKLCH: lightness changes evenly along a sequential map, so equal steps in the value look equal, also
// in grey and to colour-blind eyes. The stops are Polder's own.

export type Rgb = [number, number, number];

interface Stop {
  /** Lightness 0…1, chroma, hue in degrees. */
  l: number;
  c: number;
  h: number;
}

export type MapName = "tide" | "ember" | "dune" | "balance";

const stops: Record<MapName, Stop[]> = {
  // Pale green over teal to deep blue: pressures, saturation.
  tide: [
    { l: 0.93, c: 0.06, h: 115 },
    { l: 0.82, c: 0.1, h: 155 },
    { l: 0.66, c: 0.1, h: 205 },
    { l: 0.49, c: 0.12, h: 245 },
    { l: 0.33, c: 0.1, h: 275 },
  ],
  // Sand over red to plum: strains, speeds, whatever says that something happens.
  ember: [
    { l: 0.88, c: 0.06, h: 92 },
    { l: 0.76, c: 0.13, h: 68 },
    { l: 0.61, c: 0.18, h: 30 },
    { l: 0.46, c: 0.17, h: 355 },
    { l: 0.32, c: 0.12, h: 325 },
  ],
  // Umber to sand: porosity.
  dune: [
    { l: 0.3, c: 0.05, h: 50 },
    { l: 0.46, c: 0.08, h: 62 },
    { l: 0.62, c: 0.09, h: 78 },
    { l: 0.78, c: 0.09, h: 125 },
    { l: 0.94, c: 0.06, h: 190 },
  ],
  // Blue through near-white to red: fields whose zero is special.
  balance: [
    { l: 0.38, c: 0.14, h: 255 },
    { l: 0.68, c: 0.1, h: 245 },
    { l: 0.95, c: 0.01, h: 100 },
    { l: 0.68, c: 0.12, h: 45 },
    { l: 0.4, c: 0.14, h: 25 },
  ],
};

const srgb = (v: number) => Math.min(1, Math.max(0, v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));

/** OKLab to sRGB: B. Ottosson, "A perceptual color space for image processing", 2020. */
function labToRgb(l: number, a: number, b: number): Rgb {
  const l3 = (l + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m3 = (l - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s3 = (l - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    srgb(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3),
    srgb(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3),
    srgb(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.707614701 * s3),
  ];
}

function toRgb({ l, c, h }: Stop): Rgb {
  const angle = (h * Math.PI) / 180;
  return labToRgb(l, c * Math.cos(angle), c * Math.sin(angle));
}

/** Distinct at similar lightness; for materials and other names. */
export const categoryColours: Rgb[] = [
  { l: 0.76, c: 0.09, h: 80 },
  { l: 0.55, c: 0.07, h: 50 },
  { l: 0.68, c: 0.08, h: 150 },
  { l: 0.6, c: 0.12, h: 25 },
  { l: 0.62, c: 0.09, h: 300 },
  { l: 0.5, c: 0.05, h: 230 },
].map(toRgb);

export const mapSize = 256;

/** `mapSize` colours, RGBA bytes. */
export function colourMap(name: MapName): Uint8Array {
  const list = stops[name];
  const lab = list.map(({ l, c, h }) => {
    const angle = (h * Math.PI) / 180;
    return [l, c * Math.cos(angle), c * Math.sin(angle)];
  });
  const bytes = new Uint8Array(4 * mapSize);
  for (let i = 0; i < mapSize; ++i) {
    const at = (i / (mapSize - 1)) * (list.length - 1);
    const k = Math.min(list.length - 2, Math.floor(at));
    const f = at - k;
    const mix = (axis: number) => lab[k][axis] * (1 - f) + lab[k + 1][axis] * f;
    const rgb = labToRgb(mix(0), mix(1), mix(2));
    rgb.forEach((v, axis) => (bytes[4 * i + axis] = Math.round(255 * v)));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

/** Colours of categories: the page's own, or else the list above by turns. */
export function coloursOf(hex: string[]): Rgb[] {
  const own = hex.map((text): Rgb => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255) as Rgb);
  return own.length ? own : categoryColours;
}

/** A map with one flat colour per category, spread over the 256 entries by category number modulo their count. */
export function categoryMap(colours: Rgb[]): Uint8Array {
  const bytes = new Uint8Array(4 * mapSize);
  for (let i = 0; i < mapSize; ++i) {
    const rgb = colours[i % colours.length];
    rgb.forEach((v, axis) => (bytes[4 * i + axis] = Math.round(255 * v)));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

export function flatMap(colour: Rgb): Uint8Array {
  const bytes = new Uint8Array(4 * mapSize);
  for (let i = 0; i < mapSize; ++i) bytes.set([...colour.map((v) => Math.round(255 * v)), 255], 4 * i);
  return bytes;
}

export function cssGradient(map: Uint8Array): string {
  const parts: string[] = [];
  for (let i = 0; i < mapSize; i += 15) parts.push(`rgb(${map[4 * i]} ${map[4 * i + 1]} ${map[4 * i + 2]})`);
  return `linear-gradient(to right, ${parts.join(", ")})`;
}
