// SPDX-License-Identifier: Apache-2.0
//
// node scripts/pictures/studio_pictures.mjs NEF: makes the pictures of docs/studio.md, docs/pictures/studio_*.png, in a headless
// Chromium from data of this folder.
import { spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser, findChromium } from "../../tests/view/browser/chromium.mjs";

const [nef] = process.argv.slice(2);
const project = join(dirname(fileURLToPath(import.meta.url)), "../..");
const root = mkdtempSync(join(tmpdir(), "nef-studio-pictures-"));
copyFileSync(join(project, "data", "planner", "s1_tight_hole.json"), join(root, "s1_tight_hole.json"));

const SET = "# a block with a pocket, and a ball beside it\nblock = box(0,0,0, 4,3,2) - translate(cylinder(3, 1), 2,3/2,1);\n" +
  "probe = translate(ball(3/4, 5), 6,4,3);\nblock + probe";

const server = spawn(nef, ["studio", "--no-browser", "--root", root], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((done) => server.stdout.once("data", (bytes) => done(bytes.toString().trim())));
const browser = new Browser(findChromium());
await browser.open(address, 1080, 680, "window.nefStudio?.ready");

async function save(name) {
  await browser.until("document.querySelector('#progress').dataset.running === 'false'");
  await browser.evaluate("document.activeElement.blur(), (document.querySelector('#where').style.visibility = 'hidden')"); // no names of folders
  writeFileSync(join(project, "docs", "pictures", `${name}.png`), await browser.screenshot());
}

await browser.evaluate(`(async () => {
  nefStudio.sets.state = { text: ${JSON.stringify(SET)}, questions: { section: true, axis: "x", offset: "2", from: "block", to: "probe" } };
  await nefStudio.sets.compute();
  nefViewer.reset();
  document.querySelector("#sets-questions").scrollIntoView({ block: "end" });
})()`);
await save("studio_sets");

await browser.evaluate(`(async () => {
  nefStudio.choose("planner", false);
  document.querySelector("#planner-free").checked = true;
  await nefStudio.planner.openFile("s1_tight_hole.json");
  nefViewer.control.turn(-0.3, -0.1);
})()`);
await save("studio_planner");

await browser.close();
server.kill("SIGTERM");
rmSync(root, { recursive: true, force: true });
