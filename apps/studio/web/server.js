// SPDX-License-Identifier: Apache-2.0
//
// What the page asks its server (apps/studio/studio.h).
import { parseScene } from "../../view/web/scene_data.js";
import { pieceOf, putTogether } from "./pieces.js";

const TOKEN = new URLSearchParams(location.search).get("token") ?? "";

// A name for this page that no other one has.
export const PAGE = Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(16).padStart(2, "0")).join("");

// What the server refuses: a line, and maybe the field and the place in it (bytes of UTF-8) that is wrong.
export class ServerError extends Error {
  constructor(line, status, { field = null, offset = 0 } = {}) {
    super(line);
    Object.assign(this, { status, field, offset });
  }
  get cancelled() {
    return this.status === 409;
  }
}

// The server is gone, or another one has its place.
export class ServerGone extends Error {}

async function post(name, body) {
  let reply;
  try {
    reply = await fetch(`/api/${name}`, { method: "POST", headers: { "X-Nef-Token": TOKEN }, body });
  } catch {
    throw new ServerGone("The server does not answer. Start it again (nef studio) and open the address that it prints.");
  }
  if (reply.ok) return reply;
  const text = (await reply.text()).trim();
  if (reply.status === 403) {
    throw new ServerGone("The server was started anew. Open the address that it printed.");
  }
  let found = {};
  try {
    found = JSON.parse(text);
  } catch {
    // a line
  }
  throw new ServerError(found.error ?? text, reply.status, found);
}

// The answer to a request as an object.
export async function ask(name, request = {}) {
  return (await post(name, JSON.stringify({ page: PAGE, ...request }))).json();
}

// The pieces of the last scene, by their numbers: what has not changed is not sent again.
let pieces = new Map();

// A panel's computation: its report, and the scene for the viewer.
export async function computePanel(panel, request) {
  const known = pieces; // another computation may end meanwhile
  const reply = await post("compute", JSON.stringify({ page: PAGE, panel, has: [...known.keys()], ...request }));
  const bytes = await reply.arrayBuffer();
  const header = new DataView(bytes);
  let at = 8;
  const part = (length) => bytes.slice(at, (at += length));
  const report = JSON.parse(new TextDecoder().decode(part(header.getUint32(0, true))));
  const scene = parseScene(part(header.getUint32(4, true)));
  const here = new Map();
  for (const [id, length] of report.pieces) here.set(id, length > 0 ? pieceOf(parseScene(part(length))) : known.get(id));
  if (here.size > 0) {
    pieces = here;
    putTogether(scene, [...here.values()]);
  }
  scene.number = report.scene;
  return { report, scene };
}

// The exact coordinates and sphere maps of an item of the scene that is shown.
export const askItem = (scene, item) => ask("item", { scene, ...item });

// Puts a file of the user below the root; returns its name there.
export async function upload(file) {
  const name = file.name.replaceAll(/[\r\n/]/g, "_");
  return (await (await post("upload", new Blob([`${name}\n`, file]))).json()).name;
}
