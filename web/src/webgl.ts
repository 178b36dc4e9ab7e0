// The WebGL2 painter: points as round sprites, or smooth fields from the sums of field.ts.
import { mapSize } from "./colourmap";
import { bodyEdge, sumField } from "./field";
import type { Layer, Painter, Scene } from "./scene";

// Position and value at this frame and the next; the shader moves the point between them.
const pointVertex = `#version 300 es
precision highp float;
in vec4 position;
in vec2 value;
uniform vec4 window;   // middle x, y; clip units per metre x, y
uniform vec2 range;    // low, 1 / (high - low)
uniform float blend, diameter;
out float colour;
out float known;
void main() {
  vec2 at = mix(position.xy, position.zw, blend);
  gl_Position = vec4((at - window.xy) * window.zw, 0.0, 1.0);
  gl_PointSize = diameter;
  bool here = value.x == value.x, there = value.y == value.y;
  float v = here && there ? mix(value.x, value.y, blend) : here ? value.x : value.y;
  known = here || there ? 1.0 : 0.0;
  colour = known > 0.5 ? (v - range.x) * range.y : 0.0;
}`;

const discFragment = `#version 300 es
precision highp float;
in float colour;
in float known;
uniform sampler2D map;
uniform vec3 missing;
uniform float opacity, diameter;
out vec4 result;
void main() {
  float r = length(gl_PointCoord - 0.5) * diameter;
  float edge = clamp(0.5 * diameter - r + 0.5, 0.0, 1.0);
  if (diameter < 4.9) edge = 1.0;
  if (edge <= 0.0) discard;
  vec3 rgb = texelFetch(map, ivec2(int(clamp(colour, 0.0, 1.0) * ${mapSize - 1}.0 + 0.5), 0), 0).rgb;
  result = vec4(known > 0.5 ? rgb : missing, 1.0) * edge * opacity;
}`;

const quadVertex = `#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

// Sums of the points' splines (field.ts), divided here so that what lies between two cells is a mean by weight.
const fieldFragment = `#version 300 es
precision highp float;
uniform sampler2D field, map;
uniform vec4 window;   // of gl_FragCoord on the grid of sums: offset, factor
uniform vec2 edge;
uniform vec3 missing;
uniform float opacity;
out vec4 result;
void main() {
  vec4 sum = texture(field, window.xy + gl_FragCoord.xy * window.zw);
  float body = smoothstep(edge.x, edge.y, sum.b);
  if (body <= 0.0) discard;
  bool known = sum.g > 0.01;
  float v = known ? sum.r / sum.g : 0.0;
  vec3 rgb = texelFetch(map, ivec2(int(clamp(v, 0.0, 1.0) * ${mapSize - 1}.0 + 0.5), 0), 0).rgb;
  result = vec4(known ? rgb : missing, 1.0) * body * opacity;
}`;

/** Diameter of a disc in spacings of the points: on a full lattice four of them just meet. */
const discWidth = 1.42;

interface Program {
  program: WebGLProgram;
  at: (name: string) => WebGLUniformLocation | null;
}

function link(gl: WebGL2RenderingContext, vertex: string, fragment: string): Program {
  const program = gl.createProgram()!;
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "position");
  gl.bindAttribLocation(program, 1, "value");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "shader");
  const known = new Map<string, WebGLUniformLocation | null>();
  const at = (name: string) => {
    if (!known.has(name)) known.set(name, gl.getUniformLocation(program, name));
    return known.get(name)!;
  };
  return { program, at };
}

/** Vertex data of one layer, kept until frame or field change. */
interface Upload {
  buffer: WebGLBuffer;
  array: WebGLVertexArrayObject;
  count: number;
  frame: number;
  values: Float32Array | null | undefined;
}

function fill(layer: Layer, frame: number): Float32Array {
  const { series, values } = layer;
  const begin = series.start[frame];
  const end = series.start[frame + 1];
  const data = new Float32Array(6 * (end - begin));
  for (let e = begin, k = 0; e < end; ++e, k += 6) {
    const n = series.next[e];
    data[k] = series.x[e];
    data[k + 1] = series.y[e];
    data[k + 2] = series.x[n];
    data[k + 3] = series.y[n];
    data[k + 4] = values ? values[e] : 0;
    data[k + 5] = values ? (layer.category ? values[e] : values[n]) : 0;
  }
  return data;
}

/** Null where the browser has no WebGL2. */
export function webglPainter(canvas: HTMLCanvasElement, lost: () => void): Painter | null {
  const context = canvas.getContext("webgl2", { alpha: true, antialias: false, premultipliedAlpha: true, preserveDrawingBuffer: true });
  if (!context) return null;
  const gl = context;
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    lost();
  });
  const discs = link(gl, pointVertex, discFragment);
  const fields = link(gl, quadVertex, fieldFragment);
  const uploads = new Map<string, Upload>();
  const maps = new Map<string, { texture: WebGLTexture; shown: Uint8Array | null }>();
  const sum = gl.createTexture()!;
  const empty = gl.createVertexArray();
  let [width, height, ratio] = [1, 1, 1];
  let sumSize = [0, 0];
  let sums = new Float32Array(0);

  function upload(layer: Layer, frame: number): Upload {
    let u = uploads.get(layer.series.name);
    if (!u) {
      const buffer = gl.createBuffer()!;
      const array = gl.createVertexArray()!;
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 24, 0);
      gl.enableVertexAttribArray(1);
      gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 24, 16);
      u = { buffer, array, count: 0, frame: -1, values: undefined };
      uploads.set(layer.series.name, u);
    }
    if (u.frame !== frame || u.values !== layer.values) {
      const data = fill(layer, frame);
      gl.bindBuffer(gl.ARRAY_BUFFER, u.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      u.count = data.length / 6;
      u.frame = frame;
      u.values = layer.values;
    }
    return u;
  }

  /** Binds the layer's colours to texture unit 0. */
  function bindMap(layer: Layer) {
    let m = maps.get(layer.series.name);
    if (!m) maps.set(layer.series.name, (m = { texture: gl.createTexture()!, shown: null }));
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, m.texture);
    if (m.shown === layer.map) return;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, mapSize, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, layer.map);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    m.shown = layer.map;
  }

  function points(p: Program, u: Upload, layer: Layer, scene: Scene, diameter: number) {
    const c = scene.camera;
    const middleX = c.x + (width / 2 - c.left - c.width / 2) / c.scale;
    const middleY = c.y - (height / 2 - c.top - c.height / 2) / c.scale;
    gl.useProgram(p.program);
    gl.uniform4f(p.at("window"), middleX, middleY, (2 * c.scale) / width, (2 * c.scale) / height);
    const span = layer.category ? mapSize - 1 : layer.high - layer.low;
    gl.uniform2f(p.at("range"), layer.category ? 0 : layer.low, 1 / (span > 0 ? span : 1));
    gl.uniform1f(p.at("blend"), scene.blend);
    gl.uniform1f(p.at("diameter"), diameter);
    gl.bindVertexArray(u.array);
    gl.drawArrays(gl.POINTS, 0, u.count);
  }

  function clip(scene: Scene, factor: number) {
    const c = scene.camera;
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(c.left * factor, (height - c.top - c.height) * factor, c.width * factor, c.height * factor);
  }

  function drawDiscs(layer: Layer, scene: Scene) {
    const u = upload(layer, scene.frame);
    gl.useProgram(discs.program);
    bindMap(layer);
    gl.uniform1i(discs.at("map"), 0);
    gl.uniform3fv(discs.at("missing"), scene.missing);
    gl.uniform1f(discs.at("opacity"), layer.opacity);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    // Small squares snap to pixels; a little more than their spacing leaves no seams between them.
    const diameter = discWidth * layer.series.spacing * scene.camera.scale * ratio;
    points(discs, u, layer, scene, Math.max(1.5, diameter < 4 ? diameter + 0.9 : diameter));
  }

  function drawField(layer: Layer, scene: Scene) {
    const field = sumField(layer, scene, ratio, sums);
    const { nx, ny, cell } = field;
    sums = field.data;
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, sum);
    if (nx > sumSize[0] || ny > sumSize[1]) {
      sumSize = [Math.max(nx, sumSize[0]), Math.max(ny, sumSize[1])];
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, sumSize[0], sumSize[1], 0, gl.RGBA, gl.FLOAT, null);
      for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
      for (const way of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, way, gl.LINEAR);
    }
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, nx, ny, gl.RGBA, gl.FLOAT, sums);
    gl.useProgram(fields.program);
    bindMap(layer);
    gl.uniform1i(fields.at("map"), 0);
    gl.uniform1i(fields.at("field"), 1);
    // A pixel of the canvas is 1 / (scale · ratio) metres; the plot's lower left corner is the grid's.
    const c = scene.camera;
    const pixel = 1 / (c.scale * ratio * cell);
    const [left, bottom] = [c.left * ratio, (height - c.top - c.height) * ratio];
    gl.uniform4f(fields.at("window"), (-left * pixel) / sumSize[0], (-bottom * pixel) / sumSize[1], pixel / sumSize[0], pixel / sumSize[1]);
    gl.uniform2f(fields.at("edge"), ...bodyEdge);
    gl.uniform3fv(fields.at("missing"), scene.missing);
    gl.uniform1f(fields.at("opacity"), layer.opacity);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.bindVertexArray(empty);
    // Every pixel costs where the processor draws, so none is drawn beyond the points.
    const [right, top] = [left + c.width * ratio, bottom + c.height * ratio];
    const at = (start: number, end: number, cells: number) => Math.min(end, Math.max(start, Math.round(start + cells / pixel)));
    const [l, b, r, t] = [at(left, right, field.box[0]), at(bottom, top, field.box[1]), at(left, right, field.box[2]), at(bottom, top, field.box[3])];
    if (r <= l || t <= b) return;
    gl.scissor(l, b, r - l, t - b);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    clip(scene, ratio);
  }

  return {
    kind: "webgl",
    resize(w, h, r) {
      [width, height, ratio] = [w, h, r];
      canvas.width = Math.round(w * r);
      canvas.height = Math.round(h * r);
    },
    draw(scene) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.disable(gl.SCISSOR_TEST);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.enable(gl.BLEND);
      clip(scene, ratio);
      // Names cannot be averaged, so a category is always drawn as points.
      for (const layer of scene.layers)
        if (scene.smooth && !layer.category) drawField(layer, scene);
        else drawDiscs(layer, scene);
    },
  };
}
