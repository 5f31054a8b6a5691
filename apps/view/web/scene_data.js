// SPDX-License-Identifier: Apache-2.0
//
// The scene of the page, as page_scene (apps/view/page.h) writes it.

const ARRAY_TYPES = { f32: Float32Array, u32: Uint32Array, u16: Uint16Array, i16: Int16Array, u8: Uint8Array };

export const ARTIFICIAL = 0xffffffff; // the index of an item that is none of the set's
export const ORIGIN_OWN = 0;
export const ORIGIN_BOX = 1;
export const ORIGIN_SECTION = 2;
export const isolated = (flags) => (flags & 1) !== 0;
export const originOf = (flags) => flags >> 1;

// Replaces every [type, offset, count] by the array it stands for (text by a function that decodes it when asked).
function withArrays(value, buffer, base) {
  if (Array.isArray(value)) {
    const [type, offset, count] = value;
    if (value.length === 3 && typeof type === "string") {
      if (type !== "text") return new ARRAY_TYPES[type](buffer, base + offset, count);
      let lines = null;
      return () => (lines ??= new TextDecoder().decode(new Uint8Array(buffer, base + offset, count)).split("\n"));
    }
    return value.map((item) => withArrays(item, buffer, base));
  }
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, withArrays(item, buffer, base)]));
}

export function parseScene(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  return withArrays(json, buffer, Math.ceil((4 + length) / 4) * 4);
}

export async function loadScene(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return parseScene(await new Response(stream).arrayBuffer());
}
