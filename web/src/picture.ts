// Saving what is seen: a PNG of the moment, a WebM of the run. Both carry title, time and colour bars.
import { cssColour } from "./dom";
import type { Legend } from "./legend";
import { coloursOf, mapSize } from "./colourmap";
import { displayUnit, formatNumber } from "./units";

export interface Picture {
  width: number;
  height: number;
  ratio: number;
  layers: () => HTMLCanvasElement[];
  title: string;
  time: () => string;
  legends: Legend[];
}

const footer = 46;

function drawLegend(pen: CanvasRenderingContext2D, legend: Legend, x: number, y: number): number {
  const { field, low, high, map, category } = legend.colouring();
  if (!field) return x;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillStyle = cssColour("--ink");
  const label = `${legend.series.name}: ${field.label.toLowerCase()}`;
  pen.fillText(label, x, y - 9);
  if (category) {
    let at = x;
    const colours = coloursOf(field.colours);
    field.categories.forEach((name, k) => {
      pen.fillStyle = `rgb(${colours[k % colours.length].map((v) => Math.round(255 * v)).join(" ")})`;
      pen.fillRect(at, y + 3, 12, 12);
      pen.fillStyle = cssColour("--ink");
      pen.fillText(name, at + 17, y + 9);
      at += 30 + pen.measureText(name).width;
    });
    return Math.max(at, x + pen.measureText(label).width + 30);
  }
  const unit = displayUnit(field.unit, Math.max(Math.abs(low), Math.abs(high)));
  const [from, to] = [formatNumber(low * unit.factor), `${formatNumber(high * unit.factor)} ${unit.unit}`];
  const start = x + pen.measureText(from).width + 6;
  pen.fillText(from, x, y + 9);
  for (let i = 0; i < 120; ++i) {
    const k = 4 * Math.round((i / 119) * (mapSize - 1));
    pen.fillStyle = `rgb(${map[k]} ${map[k + 1]} ${map[k + 2]})`;
    pen.fillRect(start + i, y + 4, 1.5, 10);
  }
  pen.fillStyle = cssColour("--ink");
  pen.fillText(to, start + 126, y + 9);
  return start + 126 + pen.measureText(to).width + 30;
}

export function compose(target: HTMLCanvasElement, picture: Picture) {
  const { width, height, ratio } = picture;
  const pen = target.getContext("2d")!;
  // Even numbers of pixels: encoders of moving pictures want them.
  const even = (v: number) => 2 * Math.round(v / 2);
  const [w, h] = [even(width * ratio), even((height + 34 + footer) * ratio)];
  if (target.width !== w || target.height !== h) [target.width, target.height] = [w, h];
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.fillStyle = cssColour("--panel");
  pen.fillRect(0, 0, width, height + 34 + footer);
  pen.fillStyle = cssColour("--ink");
  pen.textBaseline = "middle";
  pen.textAlign = "left";
  pen.font = '600 16px "Source Sans 3", system-ui, sans-serif';
  const time = picture.time();
  pen.fillText(picture.title, 12, 19, width - 140);
  pen.textAlign = "right";
  pen.fillText(time, width - 12, 19);
  for (const layer of picture.layers()) pen.drawImage(layer, 0, 34, width, height);
  pen.font = '400 13px "Source Sans 3", system-ui, sans-serif';
  let x = 12;
  for (const legend of picture.legends) x = drawLegend(pen, legend, x, height + 34 + 20);
}

function save(blob: Blob, name: string) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export function savePicture(picture: Picture, name: string): Promise<void> {
  const canvas = document.createElement("canvas");
  compose(canvas, { ...picture, ratio: Math.max(2, picture.ratio) });
  return new Promise((done, fail) =>
    canvas.toBlob((blob) => (blob ? (save(blob, name), done()) : fail(new Error("the browser made no picture"))), "image/png"),
  );
}

/** The kind of moving picture that this browser can write; null: none. */
export function animationType(): string | null {
  if (typeof MediaRecorder === "undefined" || !("captureStream" in HTMLCanvasElement.prototype)) return null;
  return ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"].find((t) => MediaRecorder.isTypeSupported(t)) ?? null;
}

export interface Recording {
  /** Resolves when the encoder is at work; what is drawn before that is lost. */
  ready: Promise<void>;
  /** To be called after every drawn moment. */
  add: () => void;
  stop: () => void;
}

/** An encoder that has given more than its header is at work. */
const headerSize = 1000;
/** Milliseconds after which an encoder that gives nothing is no longer waited for. */
const patience = 15_000;

export function record(picture: Picture, type: string, name: string): Recording {
  const canvas = document.createElement("canvas");
  compose(canvas, picture);
  // Frames are handed over one by one where the browser allows it, so that none is missed on a slow machine.
  const oneByOne = "CanvasCaptureMediaStreamTrack" in window;
  const stream = canvas.captureStream(oneByOne ? 0 : 30);
  const track = stream.getVideoTracks()[0] as CanvasCaptureMediaStreamTrack;
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 8_000_000 });
  const parts: Blob[] = [];
  let size = 0;
  let begun = () => {};
  recorder.ondataavailable = (event) => {
    parts.push(event.data);
    size += event.data.size;
    if (size > headerSize) begun();
  };
  recorder.onstop = () => save(new Blob(parts, { type }), `${name}.${type.startsWith("video/mp4") ? "mp4" : "webm"}`);
  const add = () => {
    compose(canvas, picture);
    if (oneByOne) track.requestFrame();
  };
  recorder.start(200);
  const feed = setInterval(add, 100);
  const ready = new Promise<void>((done) => {
    begun = done;
    setTimeout(done, patience);
  }).finally(() => clearInterval(feed));
  return { ready, add, stop: () => recorder.stop() };
}
