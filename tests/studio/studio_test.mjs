// SPDX-License-Identifier: Apache-2.0
//
// node studio_test.mjs NEF DATA FOLDER [WORD]: uses the studio in a headless Chromium as people do, by mouse and by keyboard.
// Leaves screenshots in FOLDER. With WORD only the tests that have it in their names. Exit code 77 and a word if something that is needed is not installed.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { addDecimals, decimalNear, stepNumber } from "../../apps/studio/web/exact.js";
import { movedPart, partAt, scaledPart, turnedPart, withDefinitions } from "../../apps/studio/web/parts/part_at.js";
import { Browser, findChromium } from "../view/browser/chromium.mjs";

const [nef, data, folderArgument, only = ""] = process.argv.slice(2);
const folder = resolve(folderArgument);
const root = join(folder, "root");

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

// A running server; its address is the first line that it prints.
async function startServer(...options) {
  const child = spawn(nef, ["studio", "--no-browser", "--root", root, ...options], { stdio: ["ignore", "pipe", "pipe"] });
  let errors = "";
  child.stderr.on("data", (bytes) => (errors += bytes));
  const address = await new Promise((done) => {
    child.stdout.once("data", (bytes) => done(bytes.toString().trim()));
    child.once("exit", () => done(null));
  });
  if (address === null) {
    if (/not built|not part of this build/.test(errors)) skip(errors.trim());
    throw new Error(errors);
  }
  const ended = new Promise((done) => child.once("exit", done));
  return { address, child, end: async (signal = "SIGTERM") => {
    child.kill(signal);
    return ended;
  } };
}

const text = (selector) => `document.querySelector(${JSON.stringify(selector)}).textContent`;
const value = (selector) => `document.querySelector(${JSON.stringify(selector)}).value`;
const place = (selector) => `(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`;
const hiddenNow = (selector) => `document.querySelector(${JSON.stringify(selector)}).hidden`;
const READY = "window.nefStudio?.ready || /cannot/.test(document.querySelector('#message')?.textContent)";
const AREA = "#sets-editor textarea";

// The page before stays open: it saves what it has to save before the new one reads the state.
async function openStudio(browser, address, width = 1280, height = 800) {
  if (browser.session) await browser.until(`!window.nefStudio?.keeping || ${text("#kept")} !== ""`);
  await browser.open(address, width, height, READY);
  assert.equal(await browser.evaluate(text("#message")), "");
}

async function click(browser, selector) {
  await browser.evaluate(`document.querySelector(${JSON.stringify(selector)}).scrollIntoView({ block: "nearest" })`);
  await browser.click(...(await browser.evaluate(place(selector))));
}

async function focus(browser, selector) {
  await browser.evaluate(`document.querySelector(${JSON.stringify(selector)}).focus()`);
}

// The page of a session in front, where it is drawn.
async function turnTo(browser, session) {
  browser.session = session;
  await browser.send("Page.bringToFront");
}

// Selects all of a field and types something else.
async function type(browser, selector, words) {
  await focus(browser, selector);
  await browser.evaluate("document.activeElement.select()");
  await browser.type(words);
}

const measure = (table, name) => `[...document.querySelectorAll("#${table} tr")].find((row) => row.cells[0].textContent === ${JSON.stringify(name)})?.cells[1].textContent`;

const countPixels = (test) => `(() => {
  const view = window.nefViewer;
  view.draw();
  const copy = Object.assign(document.createElement("canvas"), { width: view.canvas.width, height: view.canvas.height });
  const context = copy.getContext("2d");
  context.drawImage(view.canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const test = ${test};
  let count = 0;
  for (let i = 0; i < data.length; i += 4) count += test(data[i], data[i + 1], data[i + 2]) ? 1 : 0;
  return count;
})()`;
const BLUE = "(r, g, b) => b > 1.25 * r && b > 90";

// A place of the page where a layer is seen, maybe behind others.
const placeOf = (name) => `(() => {
  const layer = nefViewer.views.findIndex(({ layer }) => layer.name === ${JSON.stringify(name)});
  const box = nefViewer.canvas.getBoundingClientRect();
  for (let x = 10; x < box.width; x += 6) for (let y = 10; y < box.height; y += 6) {
    if (document.elementFromPoint(box.x + x, box.y + y) === nefViewer.canvas && nefViewer.picker.facets(x, y).some((hit) => hit.layer === layer)) return [box.x + x + 3, box.y + y + 3];
  }
})()`;

// The pictures that people should look at, by name.
async function picture(browser, name) {
  await browser.frame();
  writeFileSync(join(folder, `${name}.png`), await browser.screenshot());
}

let server = null;

const tests = {
  async "decimals are added exactly"() {
    assert.equal(addDecimals("0.1", "0.2"), "0.3");
    assert.equal(addDecimals("-1", "0.95"), "-0.05");
    assert.equal(addDecimals("123456789012345678901234567890", "-0.5"), "123456789012345678901234567889.5");
    assert.equal(addDecimals("1/2", "0.1"), "0.6");
    assert.equal(decimalNear(1.23456, 0.01), "1.23");
    assert.equal(decimalNear(-0.001, 0.1), "0");
    assert.deepEqual(stepNumber("box(0,-1,1.50)", 7, true), { begin: 6, end: 8, number: "0" });
    assert.deepEqual(stepNumber("a - 3", 5, false), { begin: 4, end: 5, number: "2" });
    assert.deepEqual(stepNumber("ball(0.25, 3)", 9, true), { begin: 5, end: 9, number: "0.26" });
    assert.equal(stepNumber("h2", 2, true), null);
  },

  async "parts of a text are found, moved, turned and scaled"() {
    const part = (text, at) => {
      const found = partAt(text, at);
      return found && text.slice(found.begin, found.end);
    };
    const text = 'a = box(0,0,0, 1,1,1); # box(\n a - translate(file("x)#(y"), [1,2,3]) + (b)';
    assert.equal(part(text, 8), "box(0,0,0, 1,1,1)");
    assert.equal(part(text, text.indexOf("x)")), 'file("x)#(y")');
    assert.equal(part(text, text.indexOf("2,3")), 'translate(file("x)#(y"), [1,2,3])');
    assert.equal(part(text, text.length - 1), null);
    const defined = "a = polygon(0,0,0; 1,1,1); b = a; a + ball(1,2)";
    assert.equal(withDefinitions(defined, partAt(defined, defined.length)), "a = polygon(0,0,0; 1,1,1); b = a;\nball(1,2)");
    assert.equal(movedPart("ball(1,2)", ["0.1", "0", "-2"]), "translate(ball(1,2), 0.1,0,-2)");
    assert.equal(movedPart("translate(ball(1,2), 0.1,0,-2)", ["0.2", "1", "0"]), "translate(ball(1,2), 0.3,1,-2)");
    assert.equal(movedPart("translate(ball(1,2), 0.1,0,-2)", ["-0.1", "0", "2"]), "ball(1,2)");
    assert.equal(movedPart("translate(a, h,0,0)", ["1", "0", "0"]), "translate(translate(a, h,0,0), 1,0,0)");
    const once = turnedPart("box(0,0,0, 2,2,2)", "z", "30", ["1", "1", "1"]);
    assert.equal(once, "translate(rotate(translate(box(0,0,0, 2,2,2), -1,-1,-1), z, 30), 1,1,1)");
    assert.equal(turnedPart(once, "z", "-10", ["1", "1", "1"]), once.replace("30", "20"));
    assert.equal(turnedPart("ball(1,2)", "x", "5", ["0", "0", "0"]), "rotate(ball(1,2), x, 5)");
    assert.equal(scaledPart("ball(1,2)", "0.5", ["0", "0", "0"]), "scale(ball(1,2), 0.5)");
  },

  async "sets: a text becomes a set, with its measures"(browser) {
    await openStudio(browser, server.address);
    await browser.until(measure("sets-measures", "Volume"));
    await picture(browser, "sets_1280");
    await type(browser, AREA, "box(0,0,0, 2,2,2) - box(1,1,1, 2,2,2)");
    await browser.until(`${measure("sets-measures", "Volume")} === "7"`);
    assert.match(await browser.evaluate(measure("sets-measures", "Items")), /^14 vertices, 21 edges, 9 facets/);
    assert.ok((await browser.evaluate(countPixels(BLUE))) > 20000, "the solid is seen");
    assert.match(await browser.evaluate(text("#sets-commands")), /nef eval 'box\(0,0,0, 2,2,2\) - box\(1,1,1, 2,2,2\)' -o result\.nef/);
  },

  async "sets: what is wrong is underlined, words are completed, numbers stepped"(browser) {
    await type(browser, AREA, "box(0,0,0, 2,2,2) + bxo(1,1,1, 3,3,3)");
    await browser.until(`${text("#sets-editor .error")} !== ""`);
    assert.match(await browser.evaluate(text("#sets-editor .error")), /column 21.*did you mean 'box'/);
    assert.equal(await browser.evaluate(text("#sets-editor .wrong")), "bxo");
    await picture(browser, "sets_error");
    assert.equal(await browser.evaluate(measure("sets-measures", "Volume")), "7", "the last result stays");
    await type(browser, AREA, "cyl");
    assert.equal(await browser.evaluate(hiddenNow("#sets-editor .words")), false);
    await picture(browser, "sets_words");
    await browser.key("Tab");
    assert.equal(await browser.evaluate(value(AREA)), "cylinder(");
    await browser.type("2, 1)");
    await browser.key("Escape");
    await browser.until(`${measure("sets-measures", "Items")}?.startsWith("64 vertices")`);
    await browser.evaluate(`document.querySelector("${AREA}").setSelectionRange(10, 10)`);
    await browser.key("ArrowUp", { modifiers: 1 });
    assert.equal(await browser.evaluate(value(AREA)), "cylinder(3, 1)");
    await browser.until(`${measure("sets-measures", "Volume")}?.includes("9.3")`);
  },

  async "sets: undo and redo go through the versions"(browser) {
    await type(browser, AREA, "box(0,0,0, 5,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "5"`);
    await type(browser, AREA, "box(0,0,0, 6,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "6"`);
    await click(browser, "#sets-undo");
    await browser.until(`${measure("sets-measures", "Volume")} === "5"`);
    assert.equal(await browser.evaluate(value(AREA)), "box(0,0,0, 5,1,1)");
    await focus(browser, "#sets-redo");
    await browser.key("Enter", { text: "\r" });
    await browser.until(`${measure("sets-measures", "Volume")} === "6"`);
  },

  async "sets: versions are kept in the state"(browser) {
    await browser.until(`${text("#kept")} === "saved"`);
    await openStudio(browser, server.address);
    await browser.until(`${measure("sets-measures", "Volume")} === "6"`);
    await click(browser, "#sets-undo");
    await browser.until(`${measure("sets-measures", "Volume")} === "5"`);
    await click(browser, "#sets-redo");
    await browser.until(`${measure("sets-measures", "Volume")} === "6"`);
  },

  async "sets: an exact section by the slider, the distance of two parts, shapes by colour"(browser) {
    await type(browser, AREA, "a = box(0,0,0, 3,3,3);\nb = translate(box(0,0,0, 1,1,1), 5,4,7);\na - box(1,1,1, 2,2,2) + b");
    await browser.until(`${measure("sets-measures", "Volume")} === "27"`);
    await click(browser, "#sets-questions summary");
    await click(browser, "#exact-on");
    await browser.until(`${measure("questions-measures", "Section")} === "1 polygon, area 9"`);
    await focus(browser, "#exact-slider");
    while (Number(await browser.evaluate(value("#exact-offset"))) < 1.4) await browser.key("ArrowRight");
    await browser.until(`${measure("questions-measures", "Section")} === "1 polygon, area 8"`); // with a hole
    assert.equal(await browser.evaluate("nefViewer.views.some(({ layer }) => layer.name === 'section')"), true);
    await type(browser, "#exact-name", "cut");
    await click(browser, "#exact-save");
    await browser.until(`${text("#exact-saved")} === "cut.svg written"`);
    assert.match(readFileSync(join(root, "cut.svg"), "utf8"), /<path d="M.*M/); // the ring and its hole
    // The nearest points of the cube and the box beside it, by name and by the cursor.
    await type(browser, "#distance-from", "a");
    await browser.evaluate(`document.querySelector("${AREA}").setSelectionRange(32, 32)`);
    await click(browser, "#distance-to-here");
    assert.equal(await browser.evaluate(value("#distance-to")), "translate(box(0,0,0, 1,1,1), 5,4,7)");
    await browser.until(`${measure("questions-measures", "Distance")} === "4.582575695, the root of 21"`);
    assert.equal(await browser.evaluate(measure("questions-measures", "From")), "3, 3, 3");
    assert.equal(await browser.evaluate(measure("questions-measures", "To")), "5, 4, 7");
    await picture(browser, "sets_questions");
    assert.ok((await browser.evaluate(countPixels("(r, g, b) => r > 170 && g < 80 && b > 70 && b < 150"))) > 100, "the way between them is drawn");
    assert.match(await browser.evaluate(text("#sets-commands")), /nef distance from\.nef to\.nef/);
    await type(browser, "#distance-to", "a +");
    await browser.until(`${text("#questions-error")}.startsWith("to: ")`);
    await type(browser, "#distance-to", "");
    await click(browser, "#exact-on");
    await click(browser, "#shapes-on");
    await browser.until("nefViewer.views.map(({ layer }) => layer.name).sort().join() === 'shape 1,shape 2'");
    await picture(browser, "sets_shapes");
    assert.ok((await browser.evaluate(countPixels("(r, g, b) => r > 1.4 * b && g > b"))) > 500, "another colour");
    await click(browser, "#shapes-on");
    await browser.until("nefViewer.views.map(({ layer }) => layer.name).join() === 'result'");
  },

  async "a click in the view shows what it hits, with its sphere map"(browser) {
    await type(browser, AREA, "interior(box(0,0,0, 1,1,1)) + point(1,0,1)");
    await browser.until(`${measure("sets-measures", "It is")}?.includes("not closed")`);
    const findCorner = `(() => {
      const { center, layers: [{ vertices: { xyz } }] } = nefViewer.page;
      for (let v = 0; 3 * v < xyz.length; ++v) if ([1, 0, 1].every((x, i) => xyz[3 * v + i] + center[i] === x)) return v;
    })()`;
    await browser.until(`${findCorner} !== undefined`); // measures come before the picture
    const corner = await browser.evaluate(findCorner);
    const [x, y] = await browser.evaluate(`(() => {
      const [x, y] = nefViewer.picker.project(nefViewer.picker.vertexPoint(nefViewer.views[0], ${corner}));
      const box = nefViewer.canvas.getBoundingClientRect();
      return [box.x + x, box.y + y];
    })()`);
    await browser.click(x, y);
    await browser.until(`${text("#item-text")}.includes("sphere map")`); // asked for
    assert.match(await browser.evaluate(text("#item-text")), /^Vertex \d+.*x1y0z1sphere map3 svertices, 3 sedges, 0 sloops, 2 sfaces/);
    assert.equal(await browser.evaluate(hiddenNow("#sphere")), false);
    await picture(browser, "sets_vertex");
    await browser.evaluate("nefViewer.select(null)");
  },

  async "sets: files are added, uploaded and written, by the keyboard"(browser) {
    await browser.evaluate('document.querySelector("#file").value = "rotor.off"');
    await click(browser, "#file-insert");
    await browser.until(`${value(AREA)}.includes('file("rotor.off")')`);
    const { root: page } = await browser.send("DOM.getDocument");
    const { nodeId } = await browser.send("DOM.querySelector", { nodeId: page.nodeId, selector: "#file-pick" });
    await browser.send("DOM.setFileInputFiles", { nodeId, files: [join(folder, "away", "cross_quad.off")] });
    await browser.until(`${value(AREA)}.includes('file("cross_quad.off")')`);
    assert.ok(existsSync(join(root, "cross_quad.off")));
    await type(browser, AREA, 'file("hole.off")');
    await browser.until("!document.querySelector('#export').hidden");
    await browser.until("document.querySelector('#progress').dataset.running === 'false'");
    await type(browser, "#export-name", "written");
    await browser.evaluate('document.querySelector("#export-format").value = "stl"');
    await browser.key("Enter", { text: "\r" });
    await browser.until(`${text("#export-said")}.includes("bytes written")`);
    assert.ok(readFileSync(join(root, "written.stl")).length > 84);
    await browser.key("Enter", { text: "\r" });
    await browser.until(`${text("#export-said")}.includes("there already")`);
    await picture(browser, "sets_export");
  },

  async "sets: a mesh whose faces cross asks what is inside"(browser) {
    await browser.evaluate(`(() => { document.querySelector("${AREA}").value = ""; nefStudio.sets.use('file("two.off")'); })()`);
    await browser.until(`${measure("sets-measures", "Volume")}?.startsWith("15/8")`);
    assert.equal(await browser.evaluate(hiddenNow("#sets-crossing")), false);
    assert.equal(await browser.evaluate(text("#sets-crossing-text")), "6 pairs of faces cross. What is inside?");
    await picture(browser, "sets_crossing");
    const choose = (rule) => browser.evaluate(`(() => { const list = document.querySelector("#sets-crossings"); list.value = "${rule}"; list.dispatchEvent(new Event("change")); })()`);
    await choose("odd");
    await browser.until(`${measure("sets-measures", "Volume")}?.startsWith("7/4")`);
    assert.match(await browser.evaluate(text("#sets-commands")), /--crossings odd/);
    await choose("refuse");
    await browser.until(`${text("#sets-editor .error")}.includes("cross each other")`);
    assert.equal(await browser.evaluate(hiddenNow("#sets-crossing")), false);
    await choose("union");
    await browser.until(`${measure("sets-measures", "Volume")}?.startsWith("15/8")`);
  },

  async "sets: a part is moved, turned and scaled by its handles and by numbers"(browser) {
    await type(browser, AREA, "box(0,0,0, 2,2,2) + box(5,0,0, 6,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "9"`);
    assert.equal(await browser.evaluate(hiddenNow("#sets-crossing")), true);
    await browser.evaluate(`document.querySelector("${AREA}").setSelectionRange(26, 26)`);
    await click(browser, "#parts-on");
    await browser.until("nefStudio.sets.mover.gizmo.group !== null");
    assert.equal(await browser.evaluate(text("#parts-name")), "box(5,0,0, 6,1,1)");
    await picture(browser, "sets_gizmo");
    const handle = (share) => `(() => {
      const { gizmo } = nefStudio.sets.mover;
      const { x, y, z } = gizmo.group.position;
      const [px, py] = nefViewer.picker.project([x + ${share[0]} * gizmo.length, y + ${share[1]} * gizmo.length, z + ${share[2]} * gizmo.length]);
      const box = nefViewer.canvas.getBoundingClientRect();
      return [box.x + px, box.y + py];
    })()`;
    const middle = await browser.evaluate(handle([0, 0, 0]));
    const tip = await browser.evaluate(handle([1, 0, 0]));
    await browser.drag(tip, tip.map((x, i) => x + 0.8 * (x - middle[i])));
    await browser.until(`/translate\\(box\\(5,0,0, 6,1,1\\), [.\\d]+,0,0\\)$/.test(${value(AREA)})`);
    await browser.until(`document.querySelector("#progress").dataset.running === "false" && ${measure("sets-measures", "Volume")} === "9"`);
    // Back by the versions, and on by numbers.
    await click(browser, "#sets-undo");
    await browser.until(`${value(AREA)} === "box(0,0,0, 2,2,2) + box(5,0,0, 6,1,1)"`);
    await browser.until("document.querySelector('#progress').dataset.running === 'false'");
    await browser.evaluate(`document.querySelector("${AREA}").setSelectionRange(26, 26), document.querySelector("${AREA}").dispatchEvent(new Event("pointerup"))`);
    await browser.until("!document.querySelector('#parts-turn').disabled");
    await type(browser, "#parts-by", "3");
    await click(browser, "#parts-scale");
    await browser.until(`${measure("sets-measures", "Volume")} === "35"`);
    await browser.until("document.querySelector('#progress').dataset.running === 'false'");
    await type(browser, "#parts-by", "90");
    await browser.evaluate('document.querySelector("#parts-axis").value = "z"');
    await click(browser, "#parts-turn");
    await browser.until(`${value(AREA)}.includes(", z, 90)")`);
    await browser.until(`document.querySelector("#progress").dataset.running === "false" && ${measure("sets-measures", "Volume")} === "35"`);
    await picture(browser, "sets_gizmo_turned");
    await click(browser, "#parts-on");
    assert.equal(await browser.evaluate("nefStudio.sets.mover.gizmo.group"), null);
  },

  async "sets: a large set is changed in pieces"(browser) {
    await type(browser, AREA, "sphere(10, 200) - translate(box(-1,-1,-1, 1,1,1), 0,0,10)");
    await browser.until(`${measure("sets-measures", "In tiles")}?.includes("triangles")`);
    await browser.evaluate("new Promise((done) => setTimeout(() => done(true), 300))");
    await picture(browser, "sets_tiles");
    const pieces = await browser.evaluate("(window.before = nefViewer.views.slice()).length");
    assert.ok(pieces > 20, `${pieces} pieces`);
    assert.equal(await browser.evaluate("document.querySelectorAll('#layers .layer').length"), 1, "one row for all pieces");
    await type(browser, AREA, "sphere(10, 200) - translate(box(-1,-1,-1, 1,1,1), 1,0,10)");
    await browser.until("document.querySelector('#progress').dataset.running === 'false' && !before.every((view) => nefViewer.views.includes(view))");
    const kept = await browser.evaluate("before.filter((view) => nefViewer.views.includes(view)).length");
    assert.ok(kept > pieces / 2, `${kept} of ${pieces} stay drawn`);
    // An item of a piece tells its exact coordinates; the section's cut is filled.
    await browser.evaluate("nefViewer.walk(1)");
    await browser.until(`/sphere map/.test(${text("#item-text")})`);
    await browser.evaluate("nefViewer.select(null)");
    await browser.evaluate("document.querySelector('#section-on').click()");
    await picture(browser, "sets_tiles_section");
    assert.ok((await browser.evaluate(countPixels("(r, g, b) => b > 150 && b > 1.1 * r"))) > 20000, "the cut is filled");
    await browser.evaluate("document.querySelector('#section-on').click()");
    // In few triangles it looks the same, also far from the origin, where cells have large numbers.
    await type(browser, AREA, "translate(sphere(10, 200), 1000000000,0,0)");
    await browser.until("nefViewer.page.center[0] > 999999000 && document.querySelector('#progress').dataset.running === 'false'");
    const different = await browser.evaluate(`(() => {
      const { pacer, renderer, canvas } = nefViewer;
      const gl = renderer.getContext();
      const pixels = (coarse) => {
        pacer.draw(0.5, coarse);
        const found = new Uint8Array(canvas.width * canvas.height * 4);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, found);
        return found;
      };
      const [whole, few] = [pixels(false), pixels(true)];
      return whole.filter((x, i) => Math.abs(x - few[i]) > 40).length / whole.length;
    })()`);
    assert.ok(different < 0.05, `${different} of the numbers of the picture differ`);
  },

  async "sums: operands, an offset by the slider, the tabs by the keyboard"(browser) {
    await focus(browser, "#tabs [data-panel=sets]");
    await browser.key("ArrowRight");
    await browser.until(measure("sums-measures", "Volume"));
    await type(browser, "#sums-a textarea", "box(0,0,0, 2,2,2)");
    await type(browser, "#sums-b textarea", "box(0,0,0, 1,1,1)");
    await browser.until(`${measure("sums-measures", "Volume")} === "27"`);
    await picture(browser, "sums_1280");
    await browser.evaluate(`(() => { const kind = document.querySelector("#sums-kind"); kind.value = "offset"; kind.dispatchEvent(new Event("change")); })()`);
    await browser.until(measure("sums-measures", "Radius is off by at most"));
    const [x, y] = await browser.evaluate(place("#sums-slider"));
    await browser.click(x + 60, y);
    const radius = await browser.evaluate(value("#sums-radius"));
    assert.ok(Number(radius) > 0.3, radius);
    // Between the volumes of the inner and the outer ball's offset lies that of the round one.
    const r = Number(radius);
    const round = 8 + 24 * r + 6 * Math.PI * r * r + (4 / 3) * Math.PI * r ** 3;
    const volume = (side) => `Number(${measure("sums-measures", `Volume, ${side}`)}?.split("\u2248").pop().split("\u00b1")[0])`;
    await browser.until(`${volume("inner")} < ${round} && ${round} < ${volume("outer")}`);
    await picture(browser, "sums_offset");
    const kind = (name) => browser.evaluate(`(() => { const kind = document.querySelector("#sums-kind"); kind.value = "${name}"; kind.dispatchEvent(new Event("change")); })()`);
    // The way out of each other, drawn as an arrow.
    await kind("penetration");
    await type(browser, "#sums-b textarea", "box(1,1,3/2, 3,3,3)");
    await browser.until(`${measure("sums-measures", "Shortest translation of B to contact")} === "0, 0, 1/2"`);
    assert.equal(await browser.evaluate(measure("sums-measures", "They")), "overlapping");
    assert.ok(await browser.evaluate("nefViewer.page.layers.some(({ lines }) => lines.some(({ name }) => name === 'translation'))"));
    await picture(browser, "sums_penetration");
    // A tool of side 2 does not get into a slot of width 1.
    await type(browser, "#sums-a textarea", "box(0,0,0, 5,5,5) - box(1,-1,2, 2,6,6)");
    await type(browser, "#sums-b textarea", "box(0,0,0, 2,2,2)");
    await kind("reach");
    await browser.until(`![undefined, "none"].includes(${measure("sums-measures", "Boundary untouched")})`);
    await picture(browser, "sums_reach");
    assert.ok((await browser.evaluate(countPixels("(r, g, b) => r > 1.5 * b && r > 150"))) > 1000, "what it does not touch is seen");
    assert.match(await browser.evaluate(text("#sums-commands")), /minkowski b\.nef a\.nef --reach -o positions\.nef/);
    await type(browser, "#sums-from", "1,1");
    await browser.until(`${text("#sums-error")}.includes("is not a point")`);
    await type(browser, "#sums-from", "9,9,9");
    await browser.until(`${text("#sums-error")} === "" && document.querySelector('#progress').dataset.running === 'false'`);
    await kind("offset");
    await type(browser, "#sums-a textarea", "box(0,0");
    await browser.until(`${text("#sums-a .error")} !== ""`);
  },

  async "hulls: views switched off and on, outlines by the slider"(browser) {
    await click(browser, "#tabs [data-panel=hulls]");
    await browser.evaluate('document.querySelector("#hulls-file").value = "eight.json"');
    await click(browser, "#hulls-open");
    await browser.until(measure("hulls-measures", "Volume"));
    const volume = `parseFloat(${measure("hulls-measures", "Volume")}.split("\u2248").pop())`;
    const all = await browser.evaluate(volume);
    await browser.evaluate('document.querySelector("#hulls-residuals").click()');
    await browser.until('/%/.test(document.querySelector("#hulls-views .residual")?.textContent)');
    await picture(browser, "hulls_1280");
    await browser.evaluate('document.querySelector("#hulls-residuals").click()');
    await click(browser, "#hulls-views li:nth-child(4) button");
    await browser.until(`!${hiddenNow("#hulls-overlay")} && document.querySelector("#hulls-overlay-image").naturalWidth > 100`);
    await browser.evaluate('document.querySelector("#hulls-overlay").scrollIntoView()');
    await picture(browser, "hulls_overlay");
    await click(browser, "#hulls-views li:nth-child(4) button");
    await browser.until(hiddenNow("#hulls-overlay"));
    await click(browser, "#hulls-views li:nth-child(2) input");
    await browser.until(`${volume} > ${all}`);
    await focus(browser, "#hulls-views li:nth-child(3) input");
    const some = await browser.evaluate(volume);
    await browser.key(" ");
    await browser.until(`${volume} > ${some}`);
    assert.equal(await browser.evaluate('document.querySelector("#hulls-views li:nth-child(3) input").checked'), false);
    assert.match(await browser.evaluate(text("#hulls-commands")), /visual_hull eight\.json -o hull\.nef --without eight_01\.png eight_02\.png --simplify/);
    assert.match(await browser.evaluate(text("#hulls-commands")), /read\("eight\.json", without=\["eight_01\.png","eight_02\.png"\], /);
    await click(browser, "#hulls-all");
    await browser.until(`${volume} === ${all}`);
    const [x, y] = await browser.evaluate(place("#hulls-slider"));
    await browser.click(x, y);
    await browser.until(`${volume} !== ${all}`);
    assert.match(await browser.evaluate(text("#hulls-commands")), /visual_hull eight\.json -o hull\.nef --simplify 4/);
  },

  async "planner: a scene of a file, the robot dragged, an obstacle moved"(browser) {
    await click(browser, "#tabs [data-panel=planner]");
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    await browser.evaluate('document.querySelector("#planner-file").value = "s1_tight_hole.json"');
    await click(browser, "#planner-open");
    await browser.until(`${text("#planner-title")} === "s1_tight_hole.json"`);
    await browser.evaluate('document.querySelector("#planner-free").click()');
    await browser.until(`${measure("planner-measures", "Tight passages")}?.startsWith("1: lines")`);
    await picture(browser, "planner_1280");
    // By the keyboard: the wall aside by a half; the hole is another one then, but there is still one.
    await browser.evaluate('(() => { const list = document.querySelector("#planner-obstacle"); list.value = "1"; list.dispatchEvent(new Event("change")); })()');
    await focus(browser, "#planner-move-y");
    for (let i = 0; i < 5; ++i) await browser.key("ArrowUp");
    assert.equal(await browser.evaluate(value("#planner-move-y")), "0.5");
    await browser.key("ArrowDown");
    assert.equal(await browser.evaluate(value("#planner-move-y")), "0.4");
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    // By the mouse: the robot from its start into the floor.
    const before = await browser.evaluate(value("#planner-start-x"));
    const [x, y] = await browser.evaluate(placeOf("robot"));
    await browser.drag([x, y], [x - 90, y]);
    const after = await browser.evaluate(value("#planner-start-x"));
    assert.notEqual(after, before);
    assert.match(after, /^-?\d+(\.\d+)?$/);
    await browser.until(`document.querySelector("#planner-status").className.includes("invalid_start") || ${text("#planner-status")} === "There is a path."`);
    for (const [axis, number] of [["x", "4"], ["y", "1/2"], ["z", "1/2"]]) await type(browser, `#planner-start-${axis}`, number);
    await browser.until(`document.querySelector("#planner-status").className === "status invalid_start"`);
    await picture(browser, "planner_invalid");
    await type(browser, "#planner-start-x", "1");
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    // The wall, which is seen through the walls of the room.
    await click(browser, "#planner-drag");
    await browser.until(`document.querySelector("#progress").dataset.running === "false"`);
    const wall = await browser.evaluate(placeOf("obstacle 1"));
    await browser.drag(wall, [wall[0] + 40, wall[1]]);
    await browser.until(`document.querySelector("#progress").dataset.running === "false"`);
    assert.ok((await browser.evaluate(`["x", "y", "z"].some((axis) => !["0", "0.4"].includes(document.querySelector("#planner-move-" + axis).value))`)), "it was moved");
    await click(browser, "#planner-drag");
    for (const [axis, number] of [["x", "0"], ["y", "0.4"], ["z", "0"]]) await type(browser, `#planner-move-${axis}`, number);
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    assert.match(await browser.evaluate(text("#planner-commands")), /planner saved-scene\.json --start 1,1\/2,1\/2 /);
    await browser.evaluate(`document.querySelectorAll("#planner details").forEach((one) => (one.open = true))`);
    await click(browser, "#planner-save");
    await browser.until(`${text("#planner-saved")} === "saved-scene.json written"`);
    const saved = JSON.parse(readFileSync(join(root, "saved-scene.json"), "utf8"));
    assert.match(saved.obstacles[1], /^translate\(.*, 0,0\.4,0\)$/);
    // The path is in the picture, and the motion can be played.
    assert.equal(await browser.evaluate(hiddenNow("#time")), false);
  },

  async "planner: one axis, all rotations, a .cfg scene, an OMPL planner beside ours"(browser) {
    const open = async (name) => {
      await browser.evaluate(`document.querySelector("#planner-file").value = "${name}"`);
      await click(browser, "#planner-open");
      await browser.until(`${text("#planner-title")} === "${name}" && document.querySelector("#progress").dataset.running === "false"`);
    };
    await openStudio(browser, server.address);
    await click(browser, "#tabs [data-panel=planner]");
    // A bar round a corner, which takes a turn by 90 degrees.
    await open("corner.json");
    await browser.until(`${text("#planner-status")} === "There is a path, certified."`);
    assert.equal(await browser.evaluate(value("#planner-goal-turn")), "90");
    await picture(browser, "planner_corner");
    const poses = () => browser.evaluate("(({ motion }) => [...motion.times.keys()].length > 1 && motion.turns.length)(nefViewer.page.layers[0])");
    assert.ok((await poses()) > 1, "it turns on its way");
    // The motion is played.
    const time = () => browser.evaluate(`Number(document.querySelector("#time-slider").value)`);
    const place = () => browser.evaluate("nefViewer.views[0].group.position.toArray().join()");
    const [shareBefore, placeBefore] = [await time(), await place()];
    await click(browser, "#play");
    await browser.until(`Number(document.querySelector("#time-slider").value) > ${shareBefore} + 0.05`);
    assert.notEqual(await place(), placeBefore, "the robot moves while it plays");
    await click(browser, "#play");
    const stopped = await time();
    await new Promise((done) => setTimeout(done, 300));
    assert.equal(await time(), stopped, "it stands still after that");
    const ompl = (name) => browser.evaluate(`(() => { const list = document.querySelector("#planner-ompl"); list.value = "${name}"; list.dispatchEvent(new Event("change")); })()`);
    const omplFinds = async () => {
      await ompl("RRTConnect");
      // It draws poses at random, and has a minute for them.
      await browser.until(`/^a path, [0-9]+ way-points/.test(${measure("planner-measures", "RRTConnect")} ?? "")`, 90);
      assert.ok(await browser.evaluate('nefViewer.page.layers.some(({ name }) => name === "path of RRTConnect")'));
      await ompl("");
      await browser.until(`${measure("planner-measures", "RRTConnect")} === undefined`);
    };
    await type(browser, "#planner-seconds", "60");
    await omplFinds();
    await type(browser, "#planner-goal-turn", "0");
    await browser.until(`document.querySelector("#planner-status").className === "status invalid_goal"`);
    // The same bar past a wall, which may turn about all axes.
    await open("rigid.json");
    await browser.until(`${text("#planner-status")} === "There is a path, certified." && ${measure("planner-measures", "Motions")} === "rigid"`);
    assert.equal(await browser.evaluate(value("#planner-goal-turn")), "1, 0, 0, 1");
    await picture(browser, "planner_rigid");
    await omplFinds();
    // OMPL.app's file: the fields get what it says; the hole has the robot's size, so that sampling finds none.
    await open("wall.cfg");
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    assert.equal(await browser.evaluate(value("#planner-start-x")), "2");
    assert.match(await browser.evaluate(text("#planner-commands")), /planner wall\.cfg --start 2,1,-1 --goal 7,3\/2,-3\/2/);
    await type(browser, "#planner-seconds", "1");
    await ompl("RRTConnect");
    await browser.until(`${measure("planner-measures", "RRTConnect")} !== undefined`);
    await picture(browser, "planner_ompl");
    await ompl("");
    // Tight passages by name.
    await open("s1_tight_hole.json");
    if (!(await browser.evaluate('document.querySelector("#planner-free").checked'))) await click(browser, "#planner-free");
    await browser.until(`/^line 0: \\(.*on the path$/.test(document.querySelector("#planner-passages li")?.textContent)`);
    await click(browser, "#planner-passages button");
  },

  async "a computation is cancelled in the middle"(browser) {
    await click(browser, "#tabs [data-panel=sets]");
    await type(browser, AREA, "minkowski(sphere(1, 100) - box(0,0,0, 1,1,1), sphere(1, 90))");
    await browser.until("!document.querySelector('#progress').hidden");
    await browser.until(`/^[a-z ]+, \\d+\\.\\d s$/i.test(${text("#progress-text")})`);
    await picture(browser, "progress");
    await click(browser, "#cancel");
    await browser.until("document.querySelector('#progress').hidden", 20);
    await type(browser, AREA, "box(0,0,0, 3,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "3"`);
  },

  async "two pages compute at once, and do not overwrite each other's state"(browser) {
    await openStudio(browser, server.address, 900, 700);
    const first = browser.session;
    await openStudio(browser, server.address, 900, 700);
    const second = browser.session;
    await type(browser, AREA, "minkowski(sphere(1, 100) - box(0,0,0, 1,1,1), sphere(1, 90))");
    await browser.until("!document.querySelector('#progress').hidden");
    await turnTo(browser, first);
    await type(browser, AREA, "box(0,0,0, 4,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "4"`);
    await browser.until(`!${hiddenNow("#conflict")} || ${text("#kept")} === "saved"`);
    await turnTo(browser, second);
    assert.equal(await browser.evaluate(hiddenNow("#progress")), false, "it computes still");
    await click(browser, "#cancel");
    await browser.until("document.querySelector('#progress').hidden", 20);
    await type(browser, AREA, "box(0,0,0, 8,1,1)");
    await browser.until(`!${hiddenNow("#conflict")} || ${text("#kept")} === "saved"`);
    const conflicts = [];
    for (const session of [first, second]) {
      await turnTo(browser, session);
      conflicts.push(!(await browser.evaluate(hiddenNow("#conflict"))));
    }
    assert.ok(conflicts.includes(true), "one of them is told that the other one has saved");
    await turnTo(browser, second);
    await browser.until(`${measure("sets-measures", "Volume")} === "8"`);
    if (!(await browser.evaluate(hiddenNow("#conflict")))) await click(browser, "#overwrite-state");
    await browser.until(`${hiddenNow("#conflict")}`);
    assert.match(readFileSync(join(root, "studio.nefstudio"), "utf8"), /box\(0,0,0, 8,1,1\)/);
  },

  async "the server is killed and started again: nothing is lost"(browser) {
    await openStudio(browser, server.address);
    await type(browser, AREA, "# kept\nbox(0,0,0, 9,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "9"`);
    await browser.until(`${text("#kept")} === "saved"`);
    await browser.evaluate("new Promise((done) => setTimeout(() => done(true), 900))");
    await server.end("SIGKILL");
    await type(browser, AREA, "# not sent\nbox(0,0,0, 9,1,1)");
    await browser.until(`!${hiddenNow("#gone")}`);
    assert.match(await browser.evaluate(text("#gone")), /does not answer. Start it again/);
    await picture(browser, "gone");
    browser.errors = [];
    server = await startServer();
    await openStudio(browser, server.address);
    assert.equal(await browser.evaluate(value(AREA)), "# kept\nbox(0,0,0, 9,1,1)");
    await browser.until(`${measure("sets-measures", "Volume")} === "9"`);
  },

  async "narrow, light and dark"(browser) {
    await openStudio(browser, server.address);
    await browser.prefer("prefers-color-scheme", "dark");
    await type(browser, AREA, "h = 5;  # a pipe\nouter = cylinder(h, 3/2);\nouter - cylinder(h, 1)");
    await browser.until(`${measure("sets-measures", "Items")}?.startsWith("128 vertices")`);
    const seen = await browser.evaluate(`nefViewer.page.focus.map((corner) => nefViewer.picker.project(corner)).every(([x, y]) =>
      x > 0 && x < nefViewer.canvas.clientWidth && y > 0 && y < nefViewer.canvas.clientHeight)`);
    assert.ok(seen, "a set of another size is framed anew");
    await picture(browser, "dark_sets_1280");
    await click(browser, "#tabs [data-panel=planner]");
    await browser.until(`${text("#planner-status")} === "There is a path."`);
    await picture(browser, "dark_planner_1280");
    for (const scheme of ["dark", "light"]) {
      await openStudio(browser, server.address, 400, 800);
      await browser.prefer("prefers-color-scheme", scheme);
      for (const panel of ["sets", "sums", "hulls", "planner"]) {
        await click(browser, `#tabs [data-panel=${panel}]`);
        await browser.until(`document.querySelector("#progress").dataset.running === "false"`);
        await picture(browser, `${scheme}_${panel}_400`);
        const wide = await browser.evaluate("[document.documentElement.scrollWidth, document.querySelector('#work').scrollWidth]");
        assert.ok(Math.max(...wide) <= 400, `${panel}: ${wide} pixels wide`);
      }
    }
    await browser.prefer("prefers-color-scheme", "light");
  },

  async "the page stops its server"(browser) {
    await openStudio(browser, server.address);
    await click(browser, "#stop");
    assert.equal(server.child.exitCode, null, "asked once more");
    await click(browser, "#stop");
    await browser.until(`!${hiddenNow("#gone")}`);
    assert.equal(await server.end(), 0);
  },
};

const chromium = findChromium();
if (!chromium) skip("chromium is not installed (apt-get install chromium)");
rmSync(folder, { recursive: true, force: true });
mkdirSync(root, { recursive: true });
mkdirSync(join(folder, "away"));
for (const name of ["rotor.off", "hole.off"]) copyFileSync(join(data, "meshes", name), join(root, name));
copyFileSync(join(data, "meshes", "cross_quad.off"), join(folder, "away", "cross_quad.off"));
// Two cubes in one mesh that cross.
const cube = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2]);
const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
writeFileSync(join(root, "two.off"), `OFF\n16 12 0\n${[...cube, ...cube.map((p) => p.map((x) => x + 0.5))].map((p) => p.join(" ")).join("\n")}\n` +
  `${[...sides, ...sides.map((side) => side.map((i) => i + 8))].map((side) => `4 ${side.join(" ")}`).join("\n")}\n`);
for (const name of ["s1_tight_hole.json", "corner.json", "omplapp/wall.cfg", "omplapp/cube.dae", "omplapp/wall.dae"]) {
  copyFileSync(join(data, "planner", name), join(root, basename(name)));
}
writeFileSync(join(root, "rigid.json"), JSON.stringify({
  robot: "box(-1,-1/4,-1/4, 1,1/4,1/4)", obstacles: ["box(2,-5,-5, 3,5,5)"], box: [[-4, -4, -4], [4, 4, 4]], rotation: "SO(3)",
  start: { position: [0, 0, 0], quaternion: [1, 0, 0, 0] }, goal: { position: [1.5, 1, 0], quaternion: [1, 0, 0, 1] },
}));
cpSync(join(data, "visual_hull", "eight"), root, { recursive: true });
server = await startServer();

const browser = new Browser(chromium);
const patiently = browser.until.bind(browser);
browser.until = (condition, seconds = 40) => patiently(condition, seconds); // rather than as long as large pages may take
let failed = 0;
for (const [name, test] of Object.entries(tests).filter(([title]) => title.includes(only))) {
  const begin = Date.now();
  try {
    await test(browser);
    const errors = (browser.errors ?? []).filter((line) => !/Failed to load resource/.test(line));
    assert.deepEqual(errors, [], "errors on the console");
    const outside = (browser.requests ?? []).filter((url) => !/^(http:\/\/127\.0\.0\.1:|data:|blob:)/.test(url));
    assert.deepEqual(outside, [], "requests to a network");
    console.log(`passed: ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED: ${name}\n${error.stack}`);
    await picture(browser, `failed_${name.replaceAll(/[^a-z0-9]+/gi, "_")}`).catch(() => {});
  }
}
await browser.close();
server.child.kill("SIGKILL");
process.exit(failed ? 1 : 0);
