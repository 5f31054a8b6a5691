// SPDX-License-Identifier: Apache-2.0
//
// node bundle.mjs THREE.JS TEMPLATE.HTML PAGE.HTML BUNDLE.CPP HEADER FUNCTION SOURCES...: puts the viewer's modules and
// style, those of a page (SOURCES: .css and .js) and three.js into the page's template, and the result into a C++ file with
// the function that HEADER declares. Plain concatenation: our modules import only each other by the names that they
// export, and three as a whole, so that dropping the import lines and the word `export` joins them.
import { readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const folder = dirname(fileURLToPath(import.meta.url));
const read = (path) => readFileSync(path, "utf8");

// Each after those that it uses at its top level.
const viewer = ["scene_data.js", "vectors.js", "camera_control.js", "draw/frame_pacer.js", "draw/materials.js", "draw/layer_view.js",
  "draw/coarse_view.js", "draw/smooth_frame.js", "draw/section.js", "picking.js", "sphere_regions.js", "sphere_view.js", "item_text.js",
  "panel.js", "viewer.js"].map((name) => join(folder, name));

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

function withoutModuleSyntax(path, _, all) {
  const text = read(path);
  for (const [, imported] of text.matchAll(/^import [^;]* from "\.[^"]*?([^/"]+)";$/gm)) {
    if (!all.some((one) => basename(one) === imported)) throw new Error(`${path} imports ${imported}, which is not joined`);
  }
  const source = text
    .replace(/^import [^;]*;\n/gm, "")
    .replace(/^export (?=(const|let|class|function|async) )/gm, "");
  if (/^(import|export)\b/m.test(source)) throw new Error(`${path}: an import or export that bundle.mjs cannot join`);
  return `// ${basename(path)}\n${source}`;
}

const [threePath, templatePath, pagePath, bundlePath, header, functionName, ...sources] = process.argv.slice(2);
const scripts = [...viewer, ...sources.filter((path) => path.endsWith(".js"))];
const styles = [join(folder, "page.css"), ...sources.filter((path) => path.endsWith(".css"))];
const script = [threeAsObject(read(threePath)), ...scripts.map(withoutModuleSyntax)].join("\n");
if (script.includes("</script")) throw new Error("the script would end its own element");
const page = read(templatePath)
  .replace("@NEF_STYLE@", () => styles.map(read).join(""))
  .replace("@NEF_VIEWER@", () => read(join(folder, "viewer.html")))
  .replace("@NEF_SCRIPT@", () => script);
writeFileSync(pagePath, page);

const bytes = Buffer.from(page, "utf8");
const rows = [];
for (let i = 0; i < bytes.length; i += 32) rows.push([...bytes.subarray(i, i + 32)].join(","));
writeFileSync(bundlePath, `// Written by apps/view/web/bundle.mjs from our scripts and three.js (MIT licence).
#include "${header}"
namespace {
constexpr unsigned char kPage[] = {
${rows.join(",\n")}};
}  // namespace
std::string_view ${functionName}() { return {reinterpret_cast<const char*>(kPage), sizeof kPage}; }
`);
