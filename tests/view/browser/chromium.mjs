// SPDX-License-Identifier: Apache-2.0
//
// A headless Chromium, driven over its debugging pipe: no package from the npm registry is needed. Messages are JSON,
// each ended by a zero byte (Chrome DevTools Protocol).
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";

const FLAGS = ["--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];

// The path of the browser, or null.
export function findChromium() {
  for (const folder of (process.env.PATH ?? "").split(delimiter)) {
    for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
      if (existsSync(join(folder, name))) return join(folder, name);
    }
  }
  return null;
}

export class Browser {
  constructor(path) {
    this.profile = mkdtempSync(join(tmpdir(), "nef-view-"));
    this.process = spawn(path, [...FLAGS, `--user-data-dir=${this.profile}`, "about:blank"],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.pending = new Map();
    this.next = 1;
    this.errors = [];
    let rest = "";
    this.process.stdio[4].on("data", (bytes) => {
      const parts = (rest + bytes.toString("utf8")).split("\0");
      rest = parts.pop();
      for (const part of parts) this.#receive(JSON.parse(part));
    });
    this.process.on("exit", () => {
      for (const { reject } of this.pending.values()) reject(new Error("the browser ended"));
    });
  }

  #receive(message) {
    if (message.id) {
      const { resolve, reject } = this.pending.get(message.id);
      this.pending.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    } else if (message.method === "Runtime.exceptionThrown") {
      const { exceptionDetails } = message.params;
      this.errors.push(exceptionDetails.exception?.description ?? exceptionDetails.text);
    } else if (message.method === "Runtime.consoleAPICalled" && message.params.type === "error") {
      this.errors.push(message.params.args.map((one) => one.value ?? one.description).join(" "));
    } else if (message.method === "Network.requestWillBeSent") {
      this.requests.push(message.params.request.url);
    }
  }

  send(method, params = {}) {
    const id = this.next++;
    const message = { id, method, params };
    if (this.session) message.sessionId = this.session;
    this.process.stdio[3].write(`${JSON.stringify(message)}\0`);
    return new Promise((resolve, reject) => this.pending.set(id, { resolve, reject }));
  }

  // Opens a page of a file, or at an address, and waits until a condition holds: the viewer runs, if none is given.
  async open(path, width = 1100, height = 760,
    ready = "window.nefViewer || document.querySelector('#message')?.textContent.includes('cannot')") {
    this.session = undefined;
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    this.session = sessionId;
    this.requests = [];
    this.errors = [];
    await this.send("Runtime.enable");
    await this.send("Network.enable");
    await this.send("Page.enable");
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send("Page.navigate", { url: path.startsWith("http") ? path : pathToFileURL(path).href });
    await this.until(ready);
    await this.frame();
  }

  // What a visitor's system says it likes better, such as ("prefers-color-scheme", "dark").
  async prefer(name, value) {
    await this.send("Emulation.setEmulatedMedia", { features: [{ name, value }] });
    await this.frame();
  }

  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate",
      { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async until(condition, seconds = 150) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      if (await this.evaluate(`Boolean(${condition})`).catch(() => false)) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`waited ${seconds} s in vain for ${condition}`);
  }

  // Waits until what was asked for is drawn.
  frame() {
    return this.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
  }

  async mouse(type, x, y, more = {}) {
    await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1,
      clickCount: 1, ...more });
  }

  async click(x, y) {
    await this.mouse("mousePressed", x, y);
    await this.mouse("mouseReleased", x, y);
    await this.frame();
  }

  async drag(from, to) {
    await this.mouse("mousePressed", ...from);
    for (let i = 1; i <= 8; ++i) await this.mouse("mouseMoved", ...from.map((a, k) => a + ((to[k] - a) * i) / 8));
    await this.mouse("mouseReleased", ...to);
    await this.frame();
  }

  async touch(type, points) {
    await this.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  }

  // more: modifiers (1 Alt, 2 Ctrl, 8 Shift), or a text that the key has beside its name.
  async key(key, more = {}) {
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, text: key.length === 1 ? key : undefined, ...more });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, ...more });
    await this.frame();
  }

  // A text into what has the focus, as if it were pasted.
  async type(text) {
    await this.send("Input.insertText", { text });
    await this.frame();
  }

  // A PNG of the page, all of its pixels drawn.
  async screenshot() {
    await this.evaluate("(async () => { await window.nefViewer?.pacer.shown(); window.nefViewer?.draw(); })()");
    await this.frame();
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }

  async close() {
    this.session = undefined;
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    await this.send("Browser.close").catch(() => {});
    await Promise.race([ended, new Promise((resolve) => setTimeout(resolve, 5000))]);
    if (this.process.exitCode === null) this.process.kill("SIGKILL");
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}
