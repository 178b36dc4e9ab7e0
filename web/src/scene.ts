// What a painter is given: plain data, the same for WebGL and for the 2D canvas.
import type { Series } from "./series";

/** The window on the section: which world point lies in the middle of the plot, and how large a metre is. */
export interface Camera {
  /** World coordinates of the plot's middle, m. */
  x: number;
  y: number;
  /** CSS pixels per metre. */
  scale: number;
  /** The plot inside the canvas, CSS pixels. */
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface Layer {
  series: Series;
  /** Value per entry; null: the flat colour map[0]. */
  values: Float32Array | null;
  low: number;
  high: number;
  /** 256 colours, RGBA. */
  map: Uint8Array;
  /** Values are numbers of names: map[value], never blended. */
  category: boolean;
  opacity: number;
}

export interface Scene {
  layers: Layer[];
  frame: number;
  /** 0…1 of the way to the next frame. */
  blend: number;
  smooth: boolean;
  camera: Camera;
  missing: [number, number, number];
}

export interface Painter {
  readonly kind: "webgl" | "canvas";
  resize(width: number, height: number, ratio: number): void;
  draw(scene: Scene): void;
}

export function toScreen(camera: Camera, x: number, y: number): [number, number] {
  return [
    camera.left + camera.width / 2 + (x - camera.x) * camera.scale,
    camera.top + camera.height / 2 - (y - camera.y) * camera.scale,
  ];
}

export function toWorld(camera: Camera, px: number, py: number): [number, number] {
  return [
    camera.x + (px - camera.left - camera.width / 2) / camera.scale,
    camera.y - (py - camera.top - camera.height / 2) / camera.scale,
  ];
}
