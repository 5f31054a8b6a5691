// SPDX-License-Identifier: Apache-2.0
//
// node bench/studio/browser.mjs NEF [STEPS]: how long a page of the studio takes from a change to its picture, in a headless
// Chromium, which draws by software. Rows as in latency.py, and a sphere of 300,000 triangles that is turned and cut.
// Prints milliseconds: the median and the largest until it is on the screen, and medians of the parts of that: the request
// until its last byte, the page's own work, and the frame, with the share of the pixels of a side in which it was drawn. Then
// milliseconds a step of a drag, in which the next step is computed while the picture of the last one is drawn, with the numbers of answers and
// of pictures.
import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser, findChromium } from "../../tests/view/browser/chromium.mjs";

const [nef, stepsText = "12"] = process.argv.slice(2);
const steps = Number(stepsText);
const data = join(dirname(fileURLToPath(import.meta.url)), "../../data");
const root = mkdtempSync(join(tmpdir(), "nef-studio-bench-"));
cpSync(join(data, "visual_hull", "eight"), root, { recursive: true });

// One of 200 boxes, as in latency.py but for where they are.
let seed = 43;
const dice = (low, high) => low + ((seed = (seed * 1103515245 + 12345) % 2 ** 31) >> 8) % (high - low);
const boxes = Array.from({ length: 200 }, () => {
  const [x, y, z] = [dice(2, 38), dice(2, 38), dice(2, 38)];
  return `box(${x},${y},${z}, ${x + dice(1, 4)},${y + dice(1, 4)},${z + dice(1, 4)})`;
});
const scene = JSON.stringify({ robot: "box(0,0,0, 1/2,1/2,1/2)", obstacles: boxes, box: [[0, 0, 0], [42, 42, 42]], start: [0, 0, 0], goal: [41, 41, 41] });

// In the page: prepare(), then change(i) returns what ends when its answer is there.
const rows = {
  "a small set": ["null", '((p) => { p.editor.text = `box(0,0,0, 2,2,2) - translate(ball(6/5, 4), ${i}/100,0,0)`; return p.compute(false); })(nefStudio.sets)'],
  "a view of twelve": ['nefStudio.choose("hulls", false), nefStudio.hulls.openFile("eight.json")',
    '((p) => { p.off = new Set(i % 2 ? [i % 12] : []); return p.compute(); })(nefStudio.hulls)'],
  "an obstacle among 200": [`nefStudio.choose("planner", false), (nefStudio.planner.state = { text: ${JSON.stringify(scene)} }), (document.querySelector("#planner-drag").checked = true), (nefStudio.planner.obstacle = 100), nefStudio.planner.compute()`,
    '((p) => { p.moves[100] = ["0", `0.${10 + i}`, "0"]; return p.compute(true); })(nefStudio.planner)'],
  "a cube over 131,000 triangles": ['nefStudio.choose("sets", false), nefStudio.sets.use("sphere(10, 362) - translate(box(-1,-1,-1, 1,1,1), 0,0,10)")',
    '((p) => { p.editor.text = `sphere(10, 362) - translate(box(-1,-1,-1, 1,1,1), ${i}/10,0,10)`; return p.compute(false); })(nefStudio.sets)'],
  "a cube over 300,000 triangles": ['nefStudio.sets.use("sphere(10, 548) - translate(box(-1,-1,-1, 1,1,1), 0,0,10)")',
    '((p) => { p.editor.text = `sphere(10, 548) - translate(box(-1,-1,-1, 1,1,1), ${i}/10,0,10)`; return p.compute(false); })(nefStudio.sets)'],
  // Away from the pole, where 362 triangles meet.
  "a cube beside the pole of 131,000": ['nefStudio.sets.use("sphere(10, 362) - translate(box(-1,-1,-1, 1,1,1), 2,0,19/2)")',
    '((p) => { p.editor.text = `sphere(10, 362) - translate(box(-1,-1,-1, 1,1,1), ${i + 20}/10,0,19/2)`; return p.compute(false); })(nefStudio.sets)'],
  "300,000 triangles turned": ['nefStudio.sets.use("sphere(10, 548)")', "Promise.resolve(nefViewer.control.turn(0.1, 0.02))"],
};

const server = spawn(nef, ["studio", "--no-browser", "--root", root], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((done) => server.stdout.once("data", (bytes) => done(bytes.toString().trim())));
const browser = new Browser(findChromium());
await browser.open(address, 1280, 800, "window.nefStudio?.ready");
console.log("| from a change to its picture | median ms | largest ms | request | page | frame | share |\n| --- | --- | --- | --- | --- | --- | --- |");
for (const [name, [prepare, change]] of Object.entries(rows)) {
  const times = await browser.evaluate(`(async () => {
    await (${prepare});
    await nefViewer.pacer.shown();
    const requests = () => performance.getEntriesByType("resource").filter(({ name }) => name.endsWith("/api/compute"));
    const times = [];
    for (let i = 1; i <= ${steps}; ++i) {
      performance.clearResourceTimings();
      const begin = performance.now();
      await (${change});
      const answered = performance.now();
      await nefViewer.pacer.shown();
      const all = performance.now() - begin;
      await new Promise((done) => setTimeout(done)); // the entry is there by then
      const request = requests().at(-1)?.duration ?? 0;
      times.push([all, request, answered - begin - request, all - (answered - begin), nefViewer.sharpness]);
    }
    return times;
  })()`);
  const median = (k) => times.map((time) => time[k]).sort((a, b) => a - b)[Math.floor(times.length / 2)];
  const largest = Math.max(...times.map(([all]) => all)).toFixed(0);
  console.log(`| ${name} | ${median(0).toFixed(0)} | ${largest} | ${[1, 2, 3].map((k) => median(k).toFixed(0)).join(" | ")} | ${median(4)} |`);
}

// A drag: an event every 8 ms, each of which asks for what is next, as handles do. What is asked for while something is computed replaces
// what waits.
console.log("\n| while it is dragged | ms a step | steps | pictures |\n| --- | --- | --- | --- |");
for (const name of ["a cube over 131,000 triangles", "a cube over 300,000 triangles", "a cube beside the pole of 131,000"]) {
  const [prepare, change] = rows[name];
  const [milliseconds, answers, pictures] = await browser.evaluate(`(async () => {
    const { pacer } = nefViewer;
    const { computing } = nefStudio;
    await (${prepare});
    await pacer.shown();
    const { draw } = pacer;
    const { onScene } = computing;
    let pictures = 0;
    let answers = 0;
    pacer.draw = (...what) => {
      ++pictures;
      draw(...what);
    };
    computing.onScene = (scene) => {
      ++answers;
      return onScene(scene);
    };
    const dragFor = async (milliseconds) => {
      const begin = performance.now();
      for (let now = begin; now < begin + milliseconds; now = performance.now()) {
        const i = Math.floor(now / 40) % 20;
        computing.next(() => (${change}));
        await new Promise((done) => setTimeout(done, 8));
      }
      return performance.now() - begin;
    };
    await dragFor(2000); // until the pace is found
    pictures = answers = 0;
    const took = await dragFor(3000);
    const found = [took / answers, answers, pictures];
    Object.assign(pacer, { draw });
    computing.onScene = onScene;
    return found;
  })()`);
  console.log(`| ${name} | ${milliseconds.toFixed(0)} | ${answers} | ${pictures} |`);
}
await browser.close();
server.kill("SIGTERM");
rmSync(root, { recursive: true, force: true });
