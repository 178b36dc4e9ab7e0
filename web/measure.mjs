// node measure.mjs REPORT: how long the report takes to open, what memory it takes and how fast it plays, in a headless
// Chromium that draws with the processor. Prints; asserts nothing. Run it on a quiet machine.
import { readdirSync, readFileSync } from "node:fs";

process.env.POLDER_REPORT = process.argv[2];
const { open } = await import("./test/browser.mjs");

async function play(page, seconds) {
  return page.evaluate(async (s) => {
    const { clock } = window.polder.player;
    clock.seek(0);
    clock.duration = 10;
    clock.play();
    const gaps = [];
    let last = performance.now();
    const begin = last;
    while (last - begin < 1000 * s) {
      await new Promise((done) => requestAnimationFrame(done));
      const now = performance.now();
      gaps.push(now - last);
      last = now;
      if (!clock.playing) {
        clock.seek(0);
        clock.play();
      }
    }
    clock.pause();
    return gaps.slice(2);
  }, seconds);
}

/** Resident memory of everything that this process has started, shared pages counted once, MB. */
function memory() {
  const parents = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name)))
    try {
      parents.set(Number(pid), Number(readFileSync(`/proc/${pid}/stat`, "utf8").split(") ").at(-1).split(" ")[1]));
    } catch {
      // it has ended
    }
  const ours = (pid) => pid > 1 && (parents.get(pid) === process.pid || ours(parents.get(pid) ?? 0));
  let kilobytes = 0;
  for (const pid of parents.keys()) if (ours(pid)) kilobytes += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, "utf8"))?.[1] ?? 0);
  return Math.round(kilobytes / 1024);
}

function told(gaps) {
  const sorted = [...gaps].sort((a, b) => a - b);
  const rate = (share) => (1000 / sorted[Math.floor(share * (sorted.length - 1))]).toFixed(0);
  const mean = (1000 * gaps.length) / gaps.reduce((a, b) => a + b, 0);
  return `${mean.toFixed(0)} frames/s (median ${rate(0.5)}, slowest twentieth ${rate(0.95)})`;
}

for (const [name, args] of [["WebGL, software", []], ["2D canvas", ["--disable-3d-apis"]]]) {
  const opened = [];
  let browser;
  for (let k = 0; k < 3; ++k) {
    if (browser) await browser.close();
    browser = await open({ args });
    opened.push(browser.ready);
  }
  const { page } = browser;
  const { frames, entries } = await page.evaluate(() => ({ frames: window.polder.page.times.length, entries: window.polder.series.reduce((n, s) => n + s.x.length, 0) }));
  console.log(`${name}: ${Math.round(entries / frames)} points x ${frames} frames`);
  console.log(`  opens in ${opened.map((ms) => (ms / 1000).toFixed(2)).join(", ")} s`);
  console.log(`  memory of the browser with the page open: ${memory()} MB; notes: ${(await page.locator(".notes li").allTextContents()).join(" ") || "none"}`);
  console.log(`  points: ${told(await play(page, 6))}`);
  {
    await page.getByLabel("smooth field").check();
    console.log(`  smooth field: ${told(await play(page, 6))}`);
  }
  await browser.close();
}
