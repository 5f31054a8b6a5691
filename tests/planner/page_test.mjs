// SPDX-License-Identifier: Apache-2.0
//
// node page_test.mjs PLANNER SCENES FOLDER: the planner writes pages, and a headless Chromium moves robots in them, turns
// one and switches the free space. Exit code 77 and a word if something that is needed is not installed.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Browser, findChromium } from "../view/browser/chromium.mjs";

const [planner, scenes, folderArgument] = process.argv.slice(2);
const folder = resolve(folderArgument);

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

const checkbox = (name) => `[...document.querySelectorAll(".layer")]
  .find((row) => row.textContent.includes("${name}")).querySelector("input[type=checkbox]")`;
const view = (name) => `nefViewer.views[nefViewer.page.layers.findIndex((layer) => layer.name === "${name}")]`;

async function check(browser, page) {
  await browser.open(page);
  const names = await browser.evaluate("nefViewer.page.layers.map((layer) => layer.name)");
  assert.deepEqual(names, ["robot", "robot at the goal", "obstacles", "tight passages", "free space", "path"]);
  // Start (1, 1/2, 1/2), corners (3, 1, 1) and (5, 1, 1), goal (7, 3/2, 3/2): halfway it is at (4, 1, 1).
  assert.equal(await browser.evaluate("document.querySelector('#time').hidden"), false);
  const at = async (share) => {
    await browser.evaluate(`(() => { const s = document.querySelector("#time-slider");
      s.value = ${share}; s.dispatchEvent(new Event("input")); })()`);
    return browser.evaluate(`${view("robot")}.group.position.toArray()`);
  };
  const near = (found, wanted) => found.forEach((x, i) => assert.ok(Math.abs(x - wanted[i]) < 0.01, `${found}`));
  near(await at(0), [0, 0, 0]);
  near(await at(0.5), [3, 0.5, 0.5]);
  await browser.frame();
  writeFileSync(join(folder, "halfway.png"), await browser.screenshot());
  near(await at(1), [6, 1, 1]);
  near(await browser.evaluate(`${view("path")}.group.position.toArray()`), [0, 0, 0]);
  const shown = (name) => browser.evaluate(`${view(name)}.group.visible`);
  assert.equal(await shown("free space"), false);
  assert.equal(await shown("tight passages"), true);
  await browser.evaluate(`${checkbox("free space")}.click()`);
  await browser.evaluate(`${checkbox("tight passages")}.click()`);
  assert.equal(await shown("free space"), true);
  assert.equal(await shown("tight passages"), false);
  assert.deepEqual(browser.errors, []);
}

// A bar goes round the corner of a corridor: from (-12, -1) at 0 degrees to (-1, 12) at 90.
async function checkTurn(browser, page, path) {
  await browser.open(page);
  const place = async (share) => {
    await browser.evaluate(`(() => { const s = document.querySelector("#time-slider");
      s.value = ${share}; s.dispatchEvent(new Event("input")); })()`);
    // Where the middle of the bar and a point on its long axis are.
    return browser.evaluate(`(() => { const group = ${view("robot")}.group; group.updateMatrixWorld(true);
      const at = (x) => { const p = group.position.clone().set(x, 0, 0).applyMatrix4(group.matrix); return [p.x, p.y]; };
      return [at(0), at(1)]; })()`);
  };
  const direction = ([from, to]) => (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
  // The layer is drawn where the robot begins, so it has turned by as much as its axis has.
  const begin = await place(0);
  assert.ok(Math.abs(direction(begin)) < 0.01, `${begin}`);
  let before = -0.01;
  for (const share of [0.25, 0.5, 0.75, 1]) {
    const angle = direction(await place(share));
    assert.ok(angle >= before, `${angle} after ${before} degrees`);
    before = angle - 0.01;
  }
  const end = await place(1);
  assert.ok(Math.abs(direction(end) - 90) < 0.01, `${end}`);
  await browser.frame();
  writeFileSync(join(folder, "turned.png"), await browser.screenshot());
  assert.ok(path.length > 2);
  assert.deepEqual(browser.errors, []);
}

// A crane turns evenly by 1.5 radians: its hook, 2.25 from the axis, is on the circle at each time, and the ground stays.
async function checkLinkage(browser, page) {
  await browser.open(page);
  // How far the hook's origin has gone.
  const way = async (share) => {
    await browser.evaluate(`(() => { const s = document.querySelector("#time-slider");
      s.value = ${share}; s.dispatchEvent(new Event("input")); })()`);
    return browser.evaluate(`(() => { const { group, layer } = ${view("hook")}; group.updateMatrixWorld(true);
      const from = group.position.clone().set(...layer.motion.pivot);
      return from.clone().applyMatrix4(group.matrix).sub(from).toArray(); })()`);
  };
  for (const share of [0, 0.3, 0.5, 1]) {
    const found = await way(share);
    const wanted = [2.25 * Math.cos(1.5 * share) - 2.25, 2.25 * Math.sin(1.5 * share), 0];
    wanted.forEach((x, i) => assert.ok(Math.abs(x - found[i]) < 0.01, `${found} instead of ${wanted}`));
  }
  assert.deepEqual(await browser.evaluate(`${view("ground")}.group.position.toArray()`), [0, 0, 0]);
  await browser.frame();
  writeFileSync(join(folder, "crane.png"), await browser.screenshot());
  assert.deepEqual(browser.errors, []);
}

const chromium = findChromium();
if (!chromium) skip("Chromium is not installed (apt-get install chromium)");
mkdirSync(folder, { recursive: true });
const page = join(folder, "s1.html");
const made = spawnSync(planner, [join(scenes, "s1_tight_hole.json"), "--page", page], { encoding: "utf8" });
if (/viewer bundle|npm/.test(made.stderr)) skip("pages cannot be written: npm was missing when this was configured");
assert.equal(made.status, 0, made.stderr);
const turning = join(folder, "corner.html");
const report = join(folder, "corner.json");
const turned = spawnSync(planner, [join(scenes, "corner.json"), "--quiet", "--page", turning, "-o", report], {
  encoding: "utf8",
});
assert.equal(turned.status, 0, turned.stderr);
const crane = join(folder, "crane.html");
writeFileSync(join(folder, "swing.txt"), "0 0 0\n1.5 0 0\n");
const robot = join(scenes, "linkage", "crane");
const swung = spawnSync(
  planner,
  ["--linkage", `${robot}.urdf`, "--srdf", `${robot}.srdf`, "--path", join(folder, "swing.txt"), "--page", crane],
  { encoding: "utf8" },
);
const readsUrdf = !swung.stderr.includes("does not read URDF files");
if (readsUrdf) assert.equal(swung.status, 0, swung.stderr);
const browser = new Browser(chromium);
try {
  await check(browser, page);
  await checkTurn(browser, turning, JSON.parse(readFileSync(report, "utf8")).path);
  if (readsUrdf) await checkLinkage(browser, crane);
  console.log("the robot moves along its path");
} finally {
  await browser.close();
}
