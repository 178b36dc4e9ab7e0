import assert from "node:assert/strict";
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { build } from "esbuild";

async function load(name) {
  const outfile = join(mkdtempSync(join(tmpdir(), "polder-")), `${name}.mjs`);
  await build({ entryPoints: [new URL(`../src/${name}.ts`, import.meta.url).pathname], outfile, bundle: true, format: "esm" });
  return import(pathToFileURL(outfile).href);
}

/** CIE lightness of an sRGB colour. */
function lightness([r, g, b]) {
  const linear = (v) => (v <= 10.31475 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  return y > 0.008856 ? 116 * Math.cbrt(y) - 16 : 903.3 * y;
}

test("lightness runs one way along the sequential maps, and evenly", async () => {
  const { colourMap, mapSize } = await load("colourmap");
  for (const name of ["tide", "ember", "dune"]) {
    const map = colourMap(name);
    const l = Array.from({ length: mapSize }, (_, i) => lightness(map.subarray(4 * i, 4 * i + 3)));
    const way = Math.sign(l.at(-1) - l[0]);
    assert.ok(Math.abs(l.at(-1) - l[0]) > 50, `${name} spans ${l[0]} to ${l.at(-1)}`);
    for (let i = 8; i < mapSize; i += 8) assert.ok(way * (l[i] - l[i - 8]) > 0.5, `${name} turns back at ${i}`);
    const middle = l[mapSize / 2];
    assert.ok(Math.abs(middle - (l[0] + l.at(-1)) / 2) < 8, `${name} is uneven: ${middle} in the middle`);
  }
});

test("the diverging map is lightest at zero and equally dark at its ends", async () => {
  const { colourMap, mapSize } = await load("colourmap");
  const map = colourMap("balance");
  const at = (i) => lightness(map.subarray(4 * i, 4 * i + 3));
  assert.ok(at(mapSize / 2) > 90);
  assert.ok(Math.abs(at(0) - at(mapSize - 1)) < 6);
});

test("numbers read as people write them", async () => {
  const { displayUnit, formatNumber, formatQuantity, formatTime, ticks } = await load("units");
  assert.equal(formatNumber(0.881234), "0.881");
  assert.equal(formatNumber(-1234.5, 5), "−1234.5");
  assert.equal(formatNumber(3e-15), "3·10⁻¹⁵");
  assert.equal(formatNumber(0), "0");
  assert.equal(formatNumber(NaN), "–");
  assert.equal(formatNumber(1234567, 7), "1\u202f234\u202f567");
  assert.equal(formatQuantity(7848, "Pa"), "7.85\u202fkPa");
  assert.deepEqual(displayUnit("m/s", 0.002), { factor: 1000, unit: "mm/s" });
  assert.equal(formatTime(12.25, 0.25, 23), "12.25\u202fs");
  assert.equal(formatTime(5400, 60, 20000), "1.50\u202fh");
  assert.deepEqual(ticks(0, 1, 5).map((v) => Number(v.toFixed(9))), [0, 0.2, 0.4, 0.6, 0.8, 1]);
});
