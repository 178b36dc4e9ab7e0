// The painter for browsers without WebGL2: one small square per point, sorted by colour so that the pen changes rarely.
import { mapSize } from "./colourmap";
import type { Layer, Painter, Scene } from "./scene";

const missingColour = mapSize;

function colourIndices(layer: Layer, begin: number, end: number): Uint16Array {
  const indices = new Uint16Array(end - begin);
  const values = layer.values;
  if (!values) return indices;
  const span = layer.high - layer.low || 1;
  for (let e = begin; e < end; ++e) {
    const v = values[e];
    const place = layer.category ? v : ((v - layer.low) / span) * (mapSize - 1);
    indices[e - begin] = Number.isNaN(v) ? missingColour : Math.min(mapSize - 1, Math.max(0, Math.round(place)));
  }
  return indices;
}

function drawLayer(pen: CanvasRenderingContext2D, layer: Layer, scene: Scene) {
  const { series, map } = layer;
  const { camera, frame, blend } = scene;
  const begin = series.start[frame];
  const end = series.start[frame + 1];
  const indices = colourIndices(layer, begin, end);
  const order = Uint32Array.from(indices.keys()).sort((a, b) => indices[a] - indices[b]);
  const side = Math.max(1.5, 1.1 * series.spacing * camera.scale);
  const originX = camera.left + camera.width / 2 - side / 2;
  const originY = camera.top + camera.height / 2 - side / 2;
  pen.globalAlpha = layer.opacity;
  let current = -1;
  for (const k of order) {
    if (indices[k] !== current) {
      current = indices[k];
      const rgb = current === missingColour ? scene.missing.map((v) => Math.round(255 * v)) : [map[4 * current], map[4 * current + 1], map[4 * current + 2]];
      pen.fillStyle = `rgb(${rgb[0]} ${rgb[1]} ${rgb[2]})`;
    }
    const e = begin + k;
    const n = series.next[e];
    const x = series.x[e] + blend * (series.x[n] - series.x[e]);
    const y = series.y[e] + blend * (series.y[n] - series.y[e]);
    pen.fillRect(originX + (x - camera.x) * camera.scale, originY - (y - camera.y) * camera.scale, side, side);
  }
}

export function canvasPainter(canvas: HTMLCanvasElement): Painter {
  const pen = canvas.getContext("2d")!;
  let ratio = 1;
  return {
    kind: "canvas",
    canSmooth: false,
    resize(w, h, r) {
      ratio = r;
      canvas.width = Math.round(w * r);
      canvas.height = Math.round(h * r);
    },
    draw(scene) {
      const { left, top, width, height } = scene.camera;
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.globalAlpha = 1;
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.save();
      pen.beginPath();
      pen.rect(left, top, width, height);
      pen.clip();
      for (const layer of scene.layers) drawLayer(pen, layer, scene);
      pen.restore();
    },
  };
}
