// node pictures.mjs REPORT OUT.png [width=1280] [height=0] [time=s] [soil=field] [water=field] [scheme=light] [open=inputs]: a page
// as a reader sees it, for the documents. height 0: the whole page. Prints what overflows or overlaps.
import { faults } from "./test/faults.mjs";

const [, , report, out, ...rest] = process.argv;
const chosen = { width: "1280", height: "0", scheme: "light", ...Object.fromEntries(rest.map((r) => r.split("="))) };
process.env.POLDER_REPORT = report;
const { open, settle } = await import("./test/browser.mjs");

const { page, seen, close } = await open({ width: Number(chosen.width), height: Number(chosen.height) || 900, scheme: chosen.scheme });
await page.evaluate(async ({ time, soil, water, smooth }) => {
  const player = window.polder?.player;
  if (!player) return;
  for (const legend of player.legends) {
    const field = { soil, water }[legend.series.name];
    if (field !== undefined) await legend.choose(field);
  }
  if (time !== undefined) player.clock.seekTime(Number(time));
  if (smooth) document.querySelector("label.check:has(kbd)") && [...document.querySelectorAll("label.check")].find((l) => l.textContent.startsWith("smooth")).click();
}, chosen);
await settle(page);
await page.screenshot({ path: out, fullPage: Number(chosen.height) === 0 });
for (const fault of await page.evaluate(faults)) console.log(fault);
for (const error of seen.errors) console.log(error);
await close();
