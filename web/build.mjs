// Bundles the viewer into dist/viewer.js and dist/viewer.css, which the C++ build embeds and git keeps.
import { build } from "esbuild";

await build({
  entryPoints: { viewer: "src/main.ts" },
  outdir: "dist",
  bundle: true,
  minify: true,
  charset: "utf8",
  format: "iife",
  target: ["chrome100", "firefox100", "safari15.4"],
  loader: { ".woff2": "dataurl" },
  legalComments: "inline",
  logLevel: "info",
});
