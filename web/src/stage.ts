// The canvases and the camera: fitting, panning, zooming by mouse, touch and keys, and which painter is at work.
import { canvasPainter } from "./canvas";
import { h } from "./dom";
import type { Point } from "./page";
import { type Camera, type Painter, toWorld } from "./scene";
import { webglPainter } from "./webgl";

export interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

export interface Stage {
  element: HTMLElement;
  camera: Camera;
  points: HTMLCanvasElement;
  overlay: HTMLCanvasElement;
  painter: () => Painter;
  ratio: () => number;
  fit: (box: Box) => void;
  zoom: (factor: number, px?: number, py?: number) => void;
  pan: (dx: number, dy: number) => void;
}

interface Options {
  size: Point;
  redraw: () => void;
  /** The pointer rests at (px, py) of the stage; null: it left. `firm`: a click or tap. */
  point: (at: { px: number; py: number; firm: boolean } | null) => void;
  /** What is framed at the start and after a double click. */
  home: () => Box;
}

const margin = { left: 40, right: 12, top: 12, bottom: 28 };

export function makeStage({ size, redraw, point, home }: Options): Stage {
  const overlay = h("canvas", { class: "overlay", "aria-hidden": "true" });
  const element = h("div", { class: "stage" });
  const camera: Camera = { x: size[0] / 2, y: size[1] / 2, scale: 1, left: margin.left, top: margin.top, width: 1, height: 1 };
  let ratio = 1;
  let framed: Box | null = null;
  let points = h("canvas", { class: "points", tabindex: 0, role: "img" });

  const useCanvas = () => {
    const fresh = h("canvas", { class: "points", tabindex: 0, role: "img", "aria-label": points.getAttribute("aria-label") ?? "" });
    points.replaceWith(fresh);
    points = fresh;
    painter = canvasPainter(points);
    listen();
    resize();
  };
  element.append(points, overlay);
  let painter: Painter | null = null;
  try {
    painter = webglPainter(points, useCanvas);
  } catch (error) {
    console.warn("WebGL is not usable here, drawing on a 2D canvas instead:", error);
  }

  function fit(box: Box) {
    framed = box;
    const [w, hgt] = [Math.max(1e-9, box.x1 - box.x0), Math.max(1e-9, box.y1 - box.y0)];
    camera.scale = Math.min(camera.width / w, camera.height / hgt);
    camera.x = (box.x0 + box.x1) / 2;
    // What is lower than the plot stands on its base.
    camera.y = box.y0 + camera.height / camera.scale / 2;
    redraw();
  }

  function resize() {
    const width = element.clientWidth;
    if (width === 0 || !painter) return;
    const plot = width - margin.left - margin.right;
    const { x0, y0, x1, y1 } = home();
    const wanted = (plot * (y1 - y0)) / (x1 - x0) + margin.top + margin.bottom;
    const height = Math.round(Math.min(Math.max(wanted, Math.min(270, 0.64 * width)), 0.68 * window.innerHeight, 760));
    element.style.height = `${height}px`;
    ratio = Math.min(2, window.devicePixelRatio || 1);
    camera.width = plot;
    camera.height = height - margin.top - margin.bottom;
    painter.resize(width, height, ratio);
    overlay.width = Math.round(width * ratio);
    overlay.height = Math.round(height * ratio);
    fit(framed ?? home());
  }

  function zoom(factor: number, px = camera.left + camera.width / 2, py = camera.top + camera.height / 2) {
    const [x, y] = toWorld(camera, px, py);
    const least = 0.4 * Math.min(camera.width / size[0], camera.height / size[1]);
    camera.scale = Math.min(Math.max(camera.scale * factor, least), 400 * least);
    const [nx, ny] = toWorld(camera, px, py);
    camera.x += x - nx;
    camera.y += y - ny;
    framed = null;
    keepInSight();
    redraw();
  }

  function pan(dx: number, dy: number) {
    camera.x -= dx / camera.scale;
    camera.y += dy / camera.scale;
    framed = null;
    keepInSight();
    redraw();
  }

  function keepInSight() {
    camera.x = Math.min(size[0], Math.max(0, camera.x));
    camera.y = Math.min(size[1], Math.max(0, camera.y));
    const w = camera.width / camera.scale / 2;
    const t = camera.height / camera.scale / 2;
    framed = { x0: camera.x - w, x1: camera.x + w, y0: camera.y - t, y1: camera.y + t };
  }

  function listen() {
    const canvas = points;
    const held = new Map<number, { x: number; y: number }>();
    let moved = 0;
    const place = (event: PointerEvent | WheelEvent | MouseEvent) => {
      const rect = canvas.getBoundingClientRect();
      return { x: event.clientX - rect.left, y: event.clientY - rect.top };
    };
    canvas.addEventListener("pointerdown", (event) => {
      held.set(event.pointerId, place(event));
      if (held.size === 1) moved = 0;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const now = place(event);
      const before = held.get(event.pointerId);
      if (!before) {
        if (event.pointerType !== "touch") point({ px: now.x, py: now.y, firm: false });
        return;
      }
      const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      moved += Math.hypot(now.x - before.x, now.y - before.y);
      if (other) {
        const was = Math.hypot(before.x - other.x, before.y - other.y);
        const is = Math.hypot(now.x - other.x, now.y - other.y);
        if (was > 10) zoom(is / was, (now.x + other.x) / 2, (now.y + other.y) / 2);
        pan((now.x - before.x) / 2, (now.y - before.y) / 2);
      } else if (moved > 3) {
        pan(now.x - before.x, now.y - before.y);
      }
      held.set(event.pointerId, now);
    });
    const release = (event: PointerEvent) => {
      const at = held.get(event.pointerId);
      held.delete(event.pointerId);
      if (at && event.type === "pointerup" && moved <= 3) point({ px: at.x, py: at.y, firm: true });
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", (event) => event.pointerType !== "touch" && point(null));
    canvas.addEventListener("dblclick", () => fit(home()));
    // The wheel scrolls the page unless the picture has been clicked or Ctrl is held.
    canvas.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && document.activeElement !== canvas) return;
        event.preventDefault();
        const { x, y } = place(event);
        zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), x, y);
      },
      { passive: false },
    );
  }

  if (painter) listen();
  else useCanvas();
  new ResizeObserver(resize).observe(element);
  return {
    element,
    camera,
    get points() {
      return points;
    },
    overlay,
    painter: () => painter!,
    ratio: () => ratio,
    fit,
    zoom,
    pan,
  };
}
