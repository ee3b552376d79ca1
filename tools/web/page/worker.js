// The renderer, off the page's own thread. A message {number, question, file?} is answered by {number, answer, arrays}: every
// [address, length] of the answer whose name says what it holds is copied out.
importScripts("strata.js");

const kinds = { picture: Uint8Array, codes: Uint32Array, first: Uint32Array, code: Uint32Array, primitive: Uint32Array, arrival: Uint32Array,
  z: Float32Array, red: Float32Array, green: Float32Array, blue: Float32Array, alpha: Float32Array };
const ready = strataModule();

function keep(module, file) {
  const bytes = new Uint8Array(file.bytes), place = module._malloc(bytes.length);
  module.HEAPU8.set(bytes, place);
  module.ccall("strata_keep_file", null, ["string", "number", "number"], [file.name, place, bytes.length]);
  module._free(place);
}

onmessage = async ({ data }) => {
  const module = await ready;
  if (data.file) keep(module, data.file);
  const answer = JSON.parse(module.ccall("strata_ask", "string", ["string"], [JSON.stringify(data.question)]));
  const arrays = {};
  for (const [name, Kind] of Object.entries(kinds)) {
    if (!Array.isArray(answer[name])) continue;
    const [begin, length] = answer[name];
    const bytes = module.HEAPU8.slice(begin, begin + length * Kind.BYTES_PER_ELEMENT);
    arrays[name] = new Kind(bytes.buffer);
    delete answer[name];
  }
  postMessage({ number: data.number, answer, arrays }, Object.values(arrays).map((array) => array.buffer));
};
