// SPDX-License-Identifier: Apache-2.0
//
// node pages_test.mjs MAKE_PAGES FOLDER: writes pages and uses them in a headless Chromium as a visitor would. Leaves
// screenshots beside the pages. Exit code 77 and a word if something that is needed is not installed.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Browser, findChromium } from "./chromium.mjs";

const [makePages, folderArgument] = process.argv.slice(2);
const folder = resolve(folderArgument);

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

// Runs in the page: how many pixels of a view pass a test of (r, g, b), right after it was drawn.
const countPixels = (view, test) => `(() => {
  const view = ${view};
  view.draw();
  const copy = Object.assign(document.createElement("canvas"), { width: view.canvas.width, height: view.canvas.height });
  const context = copy.getContext("2d");
  context.drawImage(view.canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const test = ${test};
  let count = 0;
  for (let i = 0; i < data.length; i += 4) count += data[i + 3] > 0 && test(data[i], data[i + 1], data[i + 2]) ? 1 : 0;
  return count;
})()`;
const INK = "(r, g, b) => Math.abs(r - 31) < 12 && Math.abs(g - 58) < 12 && Math.abs(b - 90) < 12";
const ORANGE = "(r, g, b) => Math.abs(r - 217) < 20 && Math.abs(g - 102) < 20 && Math.abs(b - 43) < 20";
const AMBER = "(r, g, b) => r > 110 && r > b + 30 && g > b";

// Where vertex `item` of a layer is on the page.
const whereVertex = (layer, item) =>
  `nefViewer.picker.project(nefViewer.picker.vertexPoint(nefViewer.views[${layer}], ${item})).slice(0, 2)`;
const itemText = "document.querySelector('#item').hidden ? null : document.querySelector('#item-text').textContent";
const vertexNamed = (x, y, z) => `nefViewer.page.layers[0].exact.points().indexOf("${x} ${y} ${z}")`;

const tests = {
  async "a click on a vertex shows its exact coordinates and its sphere map"(browser) {
    await browser.open(join(folder, "mixture.html"));
    assert.equal(await browser.evaluate(itemText), null);
    assert.ok((await browser.evaluate(countPixels("nefViewer", INK))) > 500, "dark edges");
    assert.ok((await browser.evaluate(countPixels("nefViewer", ORANGE))) > 100, "orange edges of the open side");
    const corner = await browser.evaluate(vertexNamed(2, 0, 2));
    await browser.click(...(await browser.evaluate(whereVertex(0, corner))));
    assert.match(await browser.evaluate(itemText), /^Vertex \d+layermixturemark/);
    assert.equal(await browser.evaluate("document.querySelector('#sphere').hidden"), false);
    const { dots, arcs, regions } = await browser.evaluate(
      "(({ dots, arcs, regions }) => ({ dots: dots.length, arcs: arcs.length, regions: regions.length }))(nefViewer.sphere.map)");
    // Three edges of the box and one of the sheet, which goes down along the box's edge and on along x.
    assert.deepEqual([dots, arcs, regions], [4, 4, 2]);
    const blue = "(r, g, b) => b > 1.25 * r && b > 90";
    assert.ok((await browser.evaluate(countPixels("nefViewer.sphere", blue))) > 500, "the selected sface");
    assert.ok((await browser.evaluate(countPixels("nefViewer.sphere", ORANGE))) > 20, "an unselected svertex or sedge");
  },

  async "the sphere map can be turned and tells about its items"(browser) {
    const box = await browser.evaluate("(({ x, y, width }) => [x, y, width])(document.querySelector('#sphere-view').getBoundingClientRect())");
    const centre = [box[0] + box[2] / 2, box[1] + box[2] / 2];
    const before = await browser.evaluate("nefViewer.sphere.camera.position.toArray()");
    await browser.drag(centre, [centre[0] + 60, centre[1] + 20]);
    const after = await browser.evaluate("nefViewer.sphere.camera.position.toArray()");
    assert.ok(Math.hypot(...before.map((x, i) => x - after[i])) > 0.5, "the camera moved");
    await browser.click(...centre);
    assert.match(await browser.evaluate("document.querySelector('#sphere-text').textContent"), /^(Sface|Sedge|Svertex|Sloop) \d+: /);
  },

  async "exact coordinates that no double holds are shown, and facets tell their planes"(browser) {
    const point = await browser.evaluate(vertexNamed("10/3", 1, "5/2"));
    await browser.click(...(await browser.evaluate(whereVertex(0, point))));
    const text = await browser.evaluate(itemText);
    assert.match(text, /x10\/3 \u2248 3\.333333y1z5\/2 \u2248 2\.5/);
    assert.match(text, /isolated/);
    // The middle of the front facet (y = 0), which the box and the sheet do not share.
    await browser.click(...(await browser.evaluate("nefViewer.picker.project([0.8, 0, 0.9].map((x, i) => x - nefViewer.page.center[i])).slice(0, 2)")));
    assert.match(await browser.evaluate(itemText), /^Facet \d+.*planey = 0above/);
  },

  async "keys walk through the vertices, turn, switch and close"(browser) {
    await browser.evaluate("nefViewer.select(null); document.querySelector('#view').focus()");
    await browser.key("n");
    assert.match(await browser.evaluate(itemText), /^Vertex/);
    await browser.key("Escape");
    assert.equal(await browser.evaluate(itemText), null);
    const before = await browser.evaluate("nefViewer.camera.position.toArray()");
    await browser.key("ArrowLeft");
    const after = await browser.evaluate("nefViewer.camera.position.toArray()");
    assert.ok(Math.hypot(...before.map((x, i) => x - after[i])) > 0.1);
    await browser.key("e");
    assert.equal(await browser.evaluate("nefViewer.views[0].shown.edges"), false);
    await browser.key("e");
    assert.equal(await browser.evaluate("nefViewer.views[0].shown.edges"), true);
  },

  async "fingers tap, turn and zoom"(browser) {
    const corner = await browser.evaluate(whereVertex(0, await browser.evaluate(vertexNamed(2, 0, 2))));
    await browser.touch("touchStart", [corner]);
    await browser.touch("touchEnd", []);
    await browser.frame();
    assert.match(await browser.evaluate(itemText), /^Vertex/);
    await browser.evaluate("nefViewer.select(null)");
    const distance = "nefViewer.camera.position.length()";
    const before = await browser.evaluate(distance);
    await browser.touch("touchStart", [[500, 400], [600, 400]]);
    await browser.touch("touchMove", [[450, 400], [650, 400]]);
    await browser.touch("touchEnd", []);
    const after = await browser.evaluate(distance);
    assert.ok(after < 0.7 * before, `spread fingers come nearer: ${before} to ${after}`);
  },

  async "layers are switched and made transparent, sections open them"(browser) {
    await browser.open(join(folder, "layers.html"));
    const box = (layer) => `document.querySelectorAll('.layer input[type=checkbox]')[${layer}]`;
    const amber = () => browser.evaluate(countPixels("nefViewer", AMBER));
    assert.ok(await browser.evaluate("nefViewer.views[1].facets.material.transparent"));
    await browser.evaluate(`${box(0)}.click()`);
    await browser.evaluate(`${box(2)}.click()`);
    const alone = await amber();
    assert.ok(alone > 1000, "the halfspace in the second colour");
    await browser.evaluate(`${box(1)}.click()`);
    assert.equal(await amber(), 0);
    await browser.evaluate(`${box(0)}.click()`);
    // A cut through the cavity: the cap is lighter than any shaded facet.
    const cap = "(r, g, b) => r > 150 && r < 225 && b > r + 20 && b > g";
    const before = await browser.evaluate(countPixels("nefViewer", cap));
    await browser.evaluate("document.querySelector('[data-axis=y]').click()");
    await browser.evaluate("(() => { const s = nefViewer.section; const slider = document.querySelector('#section-offset');"
      + " slider.value = s.normal.y * (3 - nefViewer.page.center[1]) / nefViewer.radius; slider.dispatchEvent(new Event('input')); })()");
    await browser.frame();
    const after = await browser.evaluate(countPixels("nefViewer", cap));
    assert.ok(after > before + 3000, `the cap is seen: ${before} to ${after} pixels`);
    // Cut away: the nearest corner cannot be clicked any more.
    const corner = await browser.evaluate(vertexNamed(6, 0, 6));
    assert.ok(await browser.evaluate(`nefViewer.section.cuts(nefViewer.picker.vertexPoint(nefViewer.views[0], ${corner}))`));
  },

  async "the slider moves the robot"(browser) {
    await browser.evaluate("document.querySelector('#section-on').click()");
    await browser.evaluate("document.querySelectorAll('.layer input[type=checkbox]')[2].click()");
    assert.equal(await browser.evaluate("document.querySelector('#time').hidden"), false);
    const at = async (share) => {
      await browser.evaluate(`(() => { const s = document.querySelector('#time-slider'); s.value = ${share}; s.dispatchEvent(new Event('input')); })()`);
      return browser.evaluate("nefViewer.views[2].group.position.toArray()");
    };
    assert.deepEqual(await at(0), [0, 0, 0]);
    assert.deepEqual(await at(0.5), [0, -3.5, 0]);
    assert.deepEqual(await at(1), [0, -7, 0]);
    const red = await browser.evaluate(countPixels("nefViewer", "(r, g, b) => r > 240 && g < 15 && b < 15"));
    assert.ok(red > 50, "the image of the camera");
  },

  async "the first view is of what is visible, and the legend names what there is"(browser) {
    const legend = "document.querySelector('#legend').textContent";
    assert.match(await browser.evaluate(legend), /the box where unbounded parts are cut off/);
    await browser.open(join(folder, "focus.html"));
    const size = await browser.evaluate(`(() => { const at = (i) => nefViewer.picker.project(nefViewer.picker.vertexPoint(nefViewer.views[0], i));
      const xs = Array.from({ length: 16 }, (_, i) => at(i)[0]); return Math.max(...xs) - Math.min(...xs); })()`);
    assert.ok(size > 250, `the robot is ${size} pixels wide`);
    assert.doesNotMatch(await browser.evaluate(legend), /the box where/);
    assert.doesNotMatch(await browser.evaluate(legend), /volume 1/);
    await browser.open(join(folder, "bodies.html"));
    assert.match(await browser.evaluate(legend), /volume 1volume 2/);
    assert.equal(await browser.evaluate("document.querySelectorAll('#legend .volume .swatch').length"), 2);
  },

  async "a dark page for those who want it"(browser) {
    const paper = "getComputedStyle(document.querySelector('#panel')).backgroundColor";
    const ground = countPixels("nefViewer", "(r, g, b) => r > 230 && g > 230 && b > 230");
    const light = await browser.evaluate(paper);
    assert.ok((await browser.evaluate(ground)) > 10000);
    await browser.prefer("prefers-color-scheme", "dark");
    assert.notEqual(await browser.evaluate(paper), light);
    assert.ok((await browser.evaluate(ground)) < 1000, "the ground is not light any more");
    await browser.prefer("prefers-color-scheme", "light");
    assert.equal(await browser.evaluate(paper), light);
  },

  async "100,000 triangles are usable"(browser) {
    const start = Date.now();
    // A small window: without a graphics card the processor fills the pixels, too.
    await browser.open(join(folder, "terrain.html"), 550, 380);
    const load = Date.now() - start;
    const draw = await browser.evaluate("(() => { const t = performance.now(); nefViewer.control.turn(0.05, 0); nefViewer.draw(); nefViewer.renderer.getContext().readPixels(0, 0, 1, 1, 6408, 5121, new Uint8Array(4)); return performance.now() - t; })()");
    const pick = await browser.evaluate("(() => { const t = performance.now(); window.found = nefViewer.picker.pick(275, 190); return performance.now() - t; })()");
    assert.ok(await browser.evaluate("window.found !== null"));
    console.log(`  loaded in ${load} ms, drawn in ${draw.toFixed(0)} ms (by the processor), picked in ${pick.toFixed(0)} ms`);
    assert.ok(pick < 3000);
  },

  async "few triangles stand for many"(browser) {
    await browser.open(join(folder, "terrain.html"), 550, 380);
    const [whole, few, different, all] = await browser.evaluate(`(() => {
      const { pacer, renderer, canvas } = nefViewer;
      const gl = renderer.getContext();
      const drawn = (share, coarse) => {
        pacer.draw(share, coarse);
        const { triangles } = renderer.info.render;
        const pixels = new Uint8Array(4 * canvas.width * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return { triangles, pixels };
      };
      const whole = drawn(0.7, false);
      const few = drawn(0.7, true);
      let different = 0;
      for (let i = 0; i < whole.pixels.length; i += 4) {
        if ([0, 1, 2].some((k) => Math.abs(whole.pixels[i + k] - few.pixels[i + k]) > 40)) ++different;
      }
      return [whole.triangles, few.triangles, different, whole.pixels.length / 4];
    })()`);
    assert.ok(whole > 90000, `${whole} triangles`);
    assert.ok(few > 4000 && few < 25000, `${few} instead of ${whole} triangles`);
    assert.ok(different < 0.05 * all, `${different} of ${all} pixels differ`);
  },

  // What is drawn while frames seem to take 70 ms, and when nothing moves any more: [share, coarse] of the frames.
  async "slow frames are drawn in few triangles until nothing moves"(browser) {
    const frames = `(async () => {
      const { pacer } = nefViewer;
      await pacer.shown();
      const frames = [];
      const { draw } = pacer;
      pacer.draw = (...what) => {
        frames.push(what);
        draw(...what);
        for (const end = performance.now() + 70; performance.now() < end;);
      };
      for (let i = 0; i < 12; ++i) {
        nefViewer.control.turn(0.05, 0);
        await pacer.shown();
      }
      const moved = frames.length;
      for (const end = performance.now() + 20000; performance.now() < end && !(frames.at(-1)[0] === 1 && !frames.at(-1)[1] && frames.length > moved);) {
        await new Promise((done) => setTimeout(done, 50));
      }
      return [frames[moved - 1], frames.at(-1)];
    })()`;
    await browser.open(join(folder, "terrain.html"), 550, 380);
    const [moving, resting] = await browser.evaluate(frames);
    assert.equal(moving[1], true, "in few triangles");
    assert.ok(moving[0] < 1, "in fewer pixels");
    assert.deepEqual(resting, [1, false]);
    await browser.open(join(folder, "mixture.html"), 550, 380);
    const [small, still] = await browser.evaluate(frames);
    assert.equal(small[1], false, "few triangles stay as they are");
    assert.deepEqual(still, [1, false]);
  },
};

const chromium = findChromium();
if (!chromium) skip("chromium is not installed (apt-get install chromium)");
mkdirSync(folder, { recursive: true });
const made = spawnSync(makePages, [folder], { encoding: "utf8" });
if (made.status === 77) skip(made.stderr.trim().replace(/^skipped: /, ""));
assert.equal(made.status, 0, made.stderr);

const browser = new Browser(chromium);
let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test(browser);
    assert.deepEqual(browser.errors, [], "errors on the console");
    // Only the page itself (and what is written inside it) was asked for.
    const outside = browser.requests.filter((url) => !/^(file|data|blob):/.test(url));
    assert.deepEqual(outside, [], "requests to a network");
    console.log(`passed: ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
  const picture = await browser.screenshot().catch(() => null);
  if (picture) writeFileSync(join(folder, `${name.replaceAll(/[^a-z0-9]+/gi, "_")}.png`), picture);
}
await browser.close();
process.exit(failed ? 1 : 0);
