// Tests the types of interface.d.ts with tsc --strict: right calls compile, and the wrong ones below do not.
import { Layers, Picture, Refused, Strata, load } from "strata-renderer";

export async function uses(): Promise<number> {
  const strata: Strata = await load({ locateFile: (name, folder) => folder + name });
  strata.addFile("triangle.gltf", new Uint8Array(4));
  const picture: Picture = strata.render({ scene: "teapot", algorithm: "dual", size: [8, 8], background: [1, 1, 1] });
  const layers: Layers = strata.layers({ scene: "teapot", size: [8, 8] });
  const text: string = strata.explain({ scene: "teapot", algorithm: "dual", size: [8, 8], pixel: [1, 1] });
  const error: Error = new Refused("");
  // @ts-expect-error: the algorithm is missing
  strata.render({ scene: "teapot", size: [8, 8] });
  // @ts-expect-error: no such field
  strata.layers({ scene: "teapot", size: [8, 8], height: 8 });
  // @ts-expect-error: a size is two numbers
  strata.layers({ scene: "teapot", size: [8] });
  return picture.codes[0] + layers.z[0] + text.length + error.message.length + strata.lists().algorithms.length;
}
