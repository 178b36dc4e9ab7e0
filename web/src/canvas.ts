// The painter for browsers without WebGL2: one small square per point, sorted by colour so that the pen changes rarely, or a
// smooth field as a small picture that is stretched.
import { mapSize } from "./colourmap";
import { bodyEdge, type FieldSums, sumField } from "./field";
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

function pictureOf({ nx, ny, data }: FieldSums, layer: Layer, missing: Scene["missing"]): ImageData {
  const picture = new ImageData(nx, ny);
  const [none, full] = bodyEdge;
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      const k = 4 * (j * nx + i);
      if (data[k + 2] <= none) continue;
      const to = 4 * ((ny - 1 - j) * nx + i);
      const known = data[k + 1] > 0.01;
      const colour = 4 * Math.round((mapSize - 1) * (known ? data[k] / data[k + 1] : 0));
      for (let c = 0; c < 3; ++c) picture.data[to + c] = known ? layer.map[colour + c] : Math.round(255 * missing[c]);
      picture.data[to + 3] = Math.round(255 * layer.opacity * Math.min(1, (data[k + 2] - none) / (full - none)));
    }
  return picture;
}

export function canvasPainter(canvas: HTMLCanvasElement): Painter {
  const pen = canvas.getContext("2d")!;
  const small = document.createElement("canvas");
  const smallPen = small.getContext("2d")!;
  let ratio = 1;
  let sums = new Float32Array(0);

  function drawField(layer: Layer, scene: Scene) {
    const field = sumField(layer, scene, ratio, sums);
    sums = field.data;
    [small.width, small.height] = [field.nx, field.ny];
    smallPen.putImageData(pictureOf(field, layer, scene.missing), 0, 0);
    const { left, top, height, scale } = scene.camera;
    const side = field.cell * scale;
    pen.globalAlpha = 1;
    pen.drawImage(small, left, top + height - field.ny * side, field.nx * side, field.ny * side);
  }

  return {
    kind: "canvas",
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
      for (const layer of scene.layers)
        if (scene.smooth && !layer.category) drawField(layer, scene);
        else drawLayer(pen, layer, scene);
      pen.restore();
    },
  };
}
