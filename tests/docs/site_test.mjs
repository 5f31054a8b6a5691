// SPDX-License-Identifier: Apache-2.0
//
// node site_test.mjs SITE PICTURES: the site of the documentation in a headless Chromium, from a telephone to a desk, in
// light and dark: nothing is wider than the window, text can be read, nothing is fetched from elsewhere, no script fails,
// and the search finds. Leaves screenshots. Exit code 77 and a word if something that is needed is not installed.
import assert from "node:assert/strict";
import { createReadStream, existsSync, mkdirSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize, resolve } from "node:path";
import { Browser, findChromium } from "../view/browser/chromium.mjs";

const [site, pictures] = process.argv.slice(2).map((folder) => resolve(folder));

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

const chromium = findChromium();
if (!chromium) skip("chromium is not installed");
if (!existsSync(join(site, "index.html"))) skip("the site was not built (scripts/docs.sh)");
mkdirSync(pictures, { recursive: true });

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json",
  ".svg": "image/svg+xml", ".png": "image/png" };
const server = createServer((request, response) => {
  const path = join(site, normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)));
  if (!path.startsWith(site) || !existsSync(path) || !statSync(path).isFile()) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "application/octet-stream" });
  createReadStream(path).pipe(response);
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const root = `http://127.0.0.1:${server.address().port}`;

// Runs in the page: the least contrast (WCAG), and where, of headings, paragraphs, table cells and code with what is behind them.
const CONTRAST = `(() => {
  const numbers = (text) => text.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const over = (front, back) => {
    const alpha = front[3] ?? 1;
    return [0, 1, 2].map((i) => front[i] * alpha + back[i] * (1 - alpha));
  };
  const behind = (element) => {
    if (!element) return [255, 255, 255];
    return over(numbers(getComputedStyle(element).backgroundColor), behind(element.parentElement));
  };
  let least = [21];
  for (const element of document.querySelectorAll("article :is(h1, h2, p, td, th, li, a, code)")) {
    if (!element.textContent.trim() || !element.offsetParent || element.matches(".headerlink")) continue;
    const back = behind(element);
    const [a, b] = [light(over(numbers(getComputedStyle(element).color), back)), light(back)];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < least[0]) least = [contrast, element.tagName + ': ' + element.textContent.trim().slice(0, 60)];
  }
  return least;
})()`;

const PAGES = ["index", "nef", "meshes", "cookbook", "results/manifold", "tutorials/ompl"];
const browser = new Browser(chromium);
try {
  for (const page of PAGES) {
    for (const width of [400, 1280]) {
      await browser.open(`${root}/${page}.html`, width, 800, "document.readyState === 'complete'");
      for (const scheme of ["light", "dark"]) {
        const where = `${page}, ${width} pixels, ${scheme}`;
        await browser.prefer("prefers-color-scheme", scheme);
        await browser.evaluate("localStorage.clear(); document.body.dataset.mdColorScheme = \"old\"");
        await browser.send("Page.reload");
        // All of it: a page that is left while its scripts fetch their index reports an error.
        await browser.until(`document.body.dataset.mdColorScheme === "${scheme === "dark" ? "slate" : "default"}"
          && document.readyState === "complete"`);
        await browser.until("document.getAnimations().length === 0");  // colours that change slowly
        assert.ok(await browser.evaluate("document.documentElement.scrollWidth") <= width, `${where}: wider than the window`);
        const [contrast, element] = await browser.evaluate(CONTRAST);
        assert.ok(contrast >= 4, `${where}: a contrast of ${contrast} only: ${element}`);
        if (page === "index") writeFileSync(join(pictures, `${width}_${scheme}.png`), await browser.screenshot());
      }
      assert.deepEqual(browser.errors, [], `${page}: errors`);
      assert.deepEqual(browser.requests.filter((url) => !url.startsWith(root) && !url.startsWith("data:")), [],
        `${page}: fetched from elsewhere`);
    }
  }
  // The search, as a visitor types.
  await browser.open(`${root}/index.html`, 1280, 800, "document.readyState === 'complete'");
  await browser.evaluate("document.querySelector('.md-search__input').focus()");
  for (const letter of "lids") await browser.key(letter);
  // Letters that come before the scripts of the search listen are not lost on a visitor, who goes on typing.
  await browser.until(`(() => {
    const input = document.querySelector('.md-search__input');
    input.dispatchEvent(new Event('focus'));
    input.dispatchEvent(new KeyboardEvent('keyup', { bubbles: true }));
    return document.querySelectorAll('.md-search-result__link').length > 0;
  })()`);
  const found = await browser.evaluate("[...document.querySelectorAll('.md-search-result__link')].map((link) => link.pathname)");
  assert.ok(found.includes("/meshes.html"), `the search for "lids" found ${found}`);
  writeFileSync(join(pictures, "search.png"), await browser.screenshot());
} finally {
  browser.close();
  server.close();
}
console.log(`${PAGES.length} pages at two widths, light and dark; the search finds`);
