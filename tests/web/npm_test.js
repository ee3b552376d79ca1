// node npm_test.js STRATA: the installed package against the program: digests, refusals, a pixel's history, a file in memory, and error messages.
"use strict";
const assert = require("assert");
const { execFileSync, spawnSync } = require("child_process");
const { Refused, load } = require("strata-renderer");

const program = process.argv[2];
const told = (scene, ...options) => Object.fromEntries(JSON.parse(spawnSync(program,
  ["render", scene, ...options, "--algorithm", "all", "--no-audit", "--stats", "-"], { encoding: "utf8" }).stdout)
  .map((row) => [row.algorithm, row.digest.color || null]));

// One green triangle with alpha 0.5 that covers the whole picture.
function triangle() {
  const corners = new Float32Array([-9, -9, 0, 9, -9, 0, 0, 9, 0]);
  const uri = "data:application/octet-stream;base64," + Buffer.from(corners.buffer).toString("base64");
  return Buffer.from(JSON.stringify({ asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
    materials: [{ alphaMode: "BLEND", doubleSided: true, pbrMetallicRoughness: { baseColorFactor: [0, 1, 0, 0.5] } }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [-9, -9, 0], max: [9, 9, 0] }],
    bufferViews: [{ buffer: 0, byteLength: 36 }], buffers: [{ byteLength: 36, uri }] }));
}

async function main() {
  const strata = await load();
  let pictures = 0, refused = 0;
  for (const [scene, options, question] of [
    ["teapot", ["--size", "48x40"], { size: [48, 40] }],
    ["random:triangles=60", ["--size", "33x17", "--profile", "geforce3", "--alpha", "0.5"], { size: [33, 17], profile: "geforce3", alpha: 0.5 }],
  ]) {
    const digests = told(scene, ...options);
    assert.deepStrictEqual(Object.keys(digests).sort(), strata.lists().algorithms.map((a) => a.name).sort());
    for (const [algorithm, digest] of Object.entries(digests)) {
      if (digest === null) {
        assert.throws(() => strata.render({ scene, algorithm, ...question }), Refused, `${scene} by ${algorithm}`);
        ++refused;
        continue;
      }
      const picture = strata.render({ scene, algorithm, ...question });
      assert.strictEqual(picture.digest, digest, `${scene} by ${algorithm}`);
      assert.strictEqual(picture.picture.length, 4 * question.size[0] * question.size[1]);
      ++pictures;
    }
  }
  assert.ok(pictures > 0 && refused > 0, `${pictures} pictures, ${refused} refusals`);

  const view = { scene: "teapot", size: [48, 40] };
  assert.strictEqual(strata.explain({ ...view, algorithm: "dual", pixel: [24, 20] }),
    execFileSync(program, ["explain", "teapot", "--size", "48x40", "--algorithm", "dual", "--pixel", "24,20"], { encoding: "utf8" }));

  strata.addFile("triangle.gltf", triangle());
  const layers = strata.layers({ scene: "triangle.gltf", size: [5, 4] });
  assert.deepStrictEqual([layers.first.length, layers.alpha[0]], [21, 0.5]);
  const center = layers.first[2 * 5 + 2];
  assert.deepStrictEqual([layers.first[2 * 5 + 3] - center, layers.primitive[center], layers.green[center] > layers.red[center]], [1, 0, true]);

  const mistakes = [
    [{ ...view, scene: "teapott", algorithm: "dual" }, /teapot/],
    [{ ...view, algorithm: "duel" }, /algorithm/],
    [{ ...view, size: [0, 4], algorithm: "dual" }, /from 1 to/],
    [{ ...view, size: [4096, 4], algorithm: "dual" }, /1 to 2048/],
    [{ scene: "teapot", algorithm: "dual" }, /size/],
  ];
  for (const [question, sentence] of mistakes) assert.throws(() => strata.render(question), sentence);
  console.log(`${pictures} pictures and ${refused} refusals, a history, a file and ${mistakes.length} mistakes as expected`);
}

main().catch((error) => { console.error(error); process.exit(1); });
