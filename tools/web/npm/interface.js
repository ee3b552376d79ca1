// The renderer as an object: strata.js and this file are one npm package, and two scripts of the page's worker. interface.d.ts has the types.
"use strict";

class Refused extends Error {}

class Strata {
  #module;
  // The element types of the arrays of an answer, by name.
  static #kinds = { picture: Uint8Array, codes: Uint32Array, first: Uint32Array, code: Uint32Array, primitive: Uint32Array, order: Uint32Array,
    z: Float32Array, red: Float32Array, green: Float32Array, blue: Float32Array, alpha: Float32Array };

  constructor(module) { this.#module = module; }

  addFile(name, bytes) {
    const module = this.#module, copied = new Uint8Array(bytes), address = module._malloc(copied.length);
    module.HEAPU8.set(copied, address);
    module.ccall("strata_keep_file", null, ["string", "number", "number"], [name, address, copied.length]);
    module._free(address);
  }

  // The answer to a question of tools/web/workbench.cpp, and its arrays copied out of the program's memory.
  ask(question) {
    const module = this.#module, answer = JSON.parse(module.ccall("strata_ask", "string", ["string"], [JSON.stringify(question)]));
    const arrays = {};
    for (const [name, Kind] of Object.entries(Strata.#kinds)) {
      if (!Array.isArray(answer[name])) continue;
      const [begin, length] = answer[name];
      arrays[name] = new Kind(module.HEAPU8.slice(begin, begin + length * Kind.BYTES_PER_ELEMENT).buffer);
      delete answer[name];
    }
    return { answer, arrays };
  }

  lists() { return this.#told({ do: "lists" }); }
  render(question) { return this.#told({ ...question, do: "render" }); }
  layers(question) { return this.#told({ ...question, do: "layers" }); }
  explain(question) { return this.#told({ ...question, do: "explain" }).text; }

  #told(question) {
    const { answer, arrays } = this.ask(question);
    if (answer.error) throw new Error(answer.error);
    if (answer.refusal) throw new Refused(answer.refusal);
    return { ...answer, ...arrays };
  }
}

// OPTIONS go to Emscripten's module: `locateFile` returns the path of strata.wasm.
async function load(options = {}) {
  if (typeof require !== "function") return new Strata(await strataModule(options));
  const given = { ...options };
  // Emscripten 3.1.6 would fetch the file's path, but Node.js's fetch (from version 18) only accepts addresses.
  if (typeof process === "object" && process.versions?.node)
    given.wasmBinary = require("fs").readFileSync(options.locateFile?.("strata.wasm", __dirname + "/") ?? __dirname + "/strata.wasm");
  return new Strata(await require("./strata.js")(given));
}

if (typeof module === "object") module.exports = { Refused, Strata, load };
