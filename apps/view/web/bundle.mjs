// SPDX-License-Identifier: Apache-2.0
//
// node bundle.mjs THREE.JS PAGE.HTML BUNDLE.CPP: puts the viewer's modules, its style and three.js into one page, and the
// page into a C++ file. Plain concatenation: our modules import only each other by the names that they export, and three
// as a whole, so that dropping the import lines and the word `export` joins them.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const folder = dirname(fileURLToPath(import.meta.url));
const read = (name) => readFileSync(join(folder, name), "utf8");

// Each after those that it uses at its top level.
const modules = ["scene_data.js", "vectors.js", "camera_control.js", "materials.js", "layer_view.js", "section.js",
  "picking.js", "sphere_regions.js", "sphere_view.js", "item_text.js", "panel.js", "main.js"];

// three ends with one export statement `export{a as B,...};`, which becomes an object.
function threeAsObject(source) {
  const match = /export\s*\{([^}]*)\};?\s*$/.exec(source);
  if (!match) throw new Error("three.module.min.js does not end with one export statement; has the version changed?");
  const members = match[1].split(",").map((item) => {
    const [local, name] = item.trim().split(/\s+as\s+/);
    return `${name ?? local}:${local}`;
  });
  return `const THREE = (() => {\n${source.slice(0, match.index)}\nreturn {${members.join(",")}};\n})();\n`;
}

function withoutModuleSyntax(name) {
  const source = read(name)
    .replace(/^import [^;]*;\n/gm, "")
    .replace(/^export (?=(const|let|class|function|async) )/gm, "");
  if (/^(import|export)\b/m.test(source)) throw new Error(`${name}: an import or export that bundle.mjs cannot join`);
  return `// ${name}\n${source}`;
}

const [threePath, pagePath, bundlePath] = process.argv.slice(2);
const script = [threeAsObject(readFileSync(threePath, "utf8")), ...modules.map(withoutModuleSyntax)].join("\n");
if (script.includes("</script")) throw new Error("the script would end its own element");
const page = read("page.html").replace("@NEF_STYLE@", () => read("page.css")).replace("@NEF_SCRIPT@", () => script);
writeFileSync(pagePath, page);

const bytes = Buffer.from(page, "utf8");
const rows = [];
for (let i = 0; i < bytes.length; i += 32) rows.push([...bytes.subarray(i, i + 32)].join(","));
writeFileSync(bundlePath, `// Written by apps/view/web/bundle.mjs from apps/view/web and three.js (MIT licence).
#include "apps/view/page/viewer_bundle.h"
namespace {
constexpr unsigned char kPage[] = {
${rows.join(",\n")}};
}  // namespace
std::string_view nef::view::viewer_bundle() { return {reinterpret_cast<const char*>(kPage), sizeof kPage}; }
`);
