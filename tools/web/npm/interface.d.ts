// Strata in JavaScript. The fields of a question have the names and meanings of the command's options; omitted ones have the command's defaults.

export interface View {
  /** A built-in scene with its parameters ("random:triangles=300"), or a name given to `addFile`. */
  scene: string;
  /** Width and height in pixels, 1 to 2048 each. */
  size: [number, number];
  /** A built-in profile's name; default "geforce8". */
  profile?: string;
  /** The alpha of every surface, 0 to 1; absent: the scene's own. */
  alpha?: number;
  /** Red, green and blue, 0 to 1, encoded as sRGB. */
  background?: [number, number, number];
  /** Azimuth and elevation in degrees; absent: the scene's own camera, else 30 and 20. */
  orbit?: [number, number];
  /** Where colours are blended; default "encoded". */
  color_space?: "encoded" | "linear";
  /** Further options of the command by their names (`lists().options`): { samples: 4, sort: "exact" }. */
  options?: Record<string, string | number | boolean | number[]>;
}

export interface Question extends View {
  /** A name of `lists().algorithms`. */
  algorithm: string;
  /** Compare the picture with the exact one: more diagnostics, and slower; default false. */
  audit?: boolean;
}

export interface Picture {
  /** The digest that `strata render` prints. */
  digest: string;
  /** The digest of the depth target; "" without one. */
  depth_digest: string;
  /** The colour target's format: "rgba8" for one. */
  format: string;
  /** Passes over the geometry. */
  passes: number;
  full_screen: number;
  /** r, g, b, a, straight, one byte each; rows from the top. */
  picture: Uint8Array;
  /** The stored codes of the colour target. */
  codes: Uint32Array;
  /** The device's errors in the picture. */
  diagnostics: { fault: string; pixels: number; detail: string }[];
  has_own_view: boolean;
  warnings: string[];
}

/** Every fragment, near to far: those of pixel p = y * width + x are `first[p]` to `first[p + 1] - 1` of the other arrays. */
export interface Layers {
  first: Uint32Array;
  /** The stored code of the depth. */
  code: Uint32Array;
  /** The number of the triangle. */
  primitive: Uint32Array;
  /** The fragment's position in the order of submission. */
  order: Uint32Array;
  /** The depth in the shader, 0 to 1. */
  z: Float32Array;
  red: Float32Array;
  green: Float32Array;
  blue: Float32Array;
  alpha: Float32Array;
}

export interface Lists {
  algorithms: { name: string; summary: string; paper: string }[];
  profiles: { name: string; description: string }[];
  scenes: { name: string; parameters: string; description: string }[];
  /** The options of the command on which bits depend; `words` are the values of an option that has few. */
  options: { name: string; option: string; type: string; help: string; words: string[]; default: string }[];
}

/** The algorithm needs a feature that the profile lacks; the message names it. */
export class Refused extends Error {}

/** Every call throws an `Error` with a sentence that names the field, the expected and the found value. */
export class Strata {
  /** Stores a copy of the bytes of a .glb or .gltf file, which questions name as their scene. */
  addFile(name: string, bytes: ArrayBuffer | Uint8Array): void;
  lists(): Lists;
  render(question: Question): Picture;
  layers(view: View): Layers;
  /** The history of the pixel x, y, as `strata explain` prints it. */
  explain(question: Question & { pixel: [number, number] }): string;
}

export function load(options?: { locateFile?: (name: string, folder: string) => string }): Promise<Strata>;
