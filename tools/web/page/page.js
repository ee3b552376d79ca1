"use strict";
const at = (id) => document.getElementById(id);
const worker = new Worker("worker.js");
const waiting = new Map();
let asked = 0;
worker.onmessage = ({ data }) => { waiting.get(data.number)(data); waiting.delete(data.number); };
worker.onerror = (error) => { at("state").textContent = `The renderer did not start: ${error.message}`; };
const ask = (question, file) => new Promise((resolve) => {
  waiting.set(++asked, resolve);
  worker.postMessage({ number: asked, question, file });
});

let orbit = null, shown = null, layers = null, lists = null, busy = false, again = false, pixel = { x: 0, y: 0 };
const files = new Set();

function question(kind) {
  const q = { do: kind, scene: at("scene").value, algorithm: at("algorithm").value, profile: at("profile").value,
    size: [Number(at("width").value), Number(at("height").value)] };
  if (at("alpha").value !== "") q.alpha = Number(at("alpha").value);
  if (orbit) q.orbit = orbit;
  q.options = {};
  for (const field of document.querySelectorAll("#options [name]")) if (field.value !== "") q.options[field.name] = field.value;
  return q;
}

// The options of the command that have no control of their own.
const rare = () => lists.options.filter((o) => !["size", "alpha", "orbit", "camera"].includes(o.name));
function makeOptions() {
  at("options").append(...rare().map((o) => {
    const label = Object.assign(document.createElement("label"), { textContent: o.name.replaceAll("_", " ") + " ", title: o.help });
    const field = Object.assign(document.createElement(o.words.length ? "select" : "input"), { name: o.name });
    if (o.words.length) field.append(...["", ...o.words].map((word) => Object.assign(document.createElement("option"), { value: word, textContent: word })));
    else field.placeholder = o.default || o.type;
    field.addEventListener("change", render);
    label.append(field);
    return label;
  }));
}

// A flag has no value, and is only given where it changes something.
function wordsOf(o, value) {
  if (o.type !== "") return ` ${o.option} ${value}`;
  return value === o.default ? "" : ` ${o.option}`;
}

function commandOf(q) {
  return `strata render ${q.scene} --size ${q.size.join("x")} --profile ${q.profile} --algorithm ${q.algorithm}` +
    (q.alpha !== undefined ? ` --alpha ${q.alpha}` : "") + (q.orbit ? ` --orbit ${q.orbit.join(",")}` : "") +
    rare().filter((o) => q.options[o.name] !== undefined).map((o) => wordsOf(o, q.options[o.name])).join("");
}

function paint(canvas, q, of) {
  [canvas.width, canvas.height] = q.size;
  const context = canvas.getContext("2d"), image = context.createImageData(canvas.width, canvas.height);
  for (let p = 0; p < canvas.width * canvas.height; ++p) {
    const [r, g, b] = of(p);
    image.data.set([r, g, b, 255], 4 * p);
  }
  context.putImageData(image, 0, 0);
}

function list(id, sentences) {
  at(id).replaceChildren(...sentences.map((sentence) => Object.assign(document.createElement("li"), { textContent: sentence })));
}

// While a question is being answered, further ones wait, and only the last of these is asked.
async function render() {
  if (busy) { again = true; return; }
  busy = true;
  document.body.dataset.ready = "";
  const q = question("render"), begin = performance.now();
  at("state").textContent = "Rendering.";
  const { answer, arrays } = await ask(q);
  const seconds = (performance.now() - begin) / 1000;
  const problem = answer.error ?? answer.refusal;
  if (problem) {
    at("state").textContent = problem;
    at("digest").textContent = "";
  } else {
    shown = { q, picture: arrays.picture };
    paint(at("picture"), q, (p) => arrays.picture.subarray(4 * p, 4 * p + 3));
    at("digest").textContent = answer.digest;
    at("command").textContent = commandOf(q);
    at("state").textContent = `${answer.passes} passes over the geometry, ${answer.format}, ${seconds.toFixed(2)} seconds here.`;
    list("notes", [...answer.diagnostics.map((d) => `${d.fault.replaceAll("_", " ")}: ${d.pixels} pixels. ${d.detail}`), ...answer.warnings]);
    layers = null;
  }
  busy = false;
  if (again) { again = false; return render(); }
  if (!problem) await fetchLayers();
  document.body.dataset.ready = "yes";
}

async function fetchLayers() {
  const q = shown.q, { answer, arrays } = await ask({ ...q, do: "layers" });
  if (answer.error || shown.q !== q) return;
  layers = arrays;
  let deepest = 1;
  for (let p = 0; p + 1 < layers.first.length; ++p) deepest = Math.max(deepest, layers.first[p + 1] - layers.first[p]);
  at("layer").max = deepest - 1;
  drawLayer();
  showFragments();
}

function drawLayer() {
  if (!layers) return;
  const layer = Number(at("layer").value);
  let near = Infinity, far = -Infinity, present = 0;
  for (const z of layers.z) { near = Math.min(near, z); far = Math.max(far, z); }
  const fragment = (p) => layers.first[p] + layer < layers.first[p + 1] ? layers.first[p] + layer : -1;
  paint(at("layer-color"), shown.q, (p) => {
    const f = fragment(p), paper = ((p % shown.q.size[0] >> 3) + (Math.floor(p / shown.q.size[0]) >> 3)) % 2 ? 150 : 180;
    if (f < 0) return [paper, paper, paper];
    ++present;
    return [layers.red, layers.green, layers.blue].map((c) => 255 * layers.alpha[f] * Math.min(1, Math.max(0, c[f])) + (1 - layers.alpha[f]) * paper);
  });
  paint(at("layer-depth"), shown.q, (p) => {
    const f = fragment(p), v = f < 0 ? 0 : 255 * (1 - 0.9 * (layers.z[f] - near) / (far - near || 1));
    return f < 0 ? [40, 40, 60] : [v, v, v];
  });
  const { samples, sample } = shown.q.options;
  at("layer-text").textContent = `${layer} of ${at("layer").max}: ${present} pixels` + (samples > 1 && sample === undefined ? " of sample 0" : "");
}

const hex = (bits) => (bits >>> 0).toString(16).padStart(8, "0");
function showFragments() {
  const p = pixel.y * shown.q.size[0] + pixel.x, bits = layers ? new Uint32Array(layers.z.buffer) : null;
  const rows = [["layer", "triangle", "arrives", "depth", "bits of z", "code", "red", "green", "blue", "alpha"]];
  for (let f = layers.first[p]; f < layers.first[p + 1]; ++f)
    rows.push([f - layers.first[p], layers.primitive[f], layers.order[f], layers.z[f].toPrecision(9), hex(bits[f]), hex(layers.code[f]),
      ...[layers.red, layers.green, layers.blue, layers.alpha].map((c) => c[f].toPrecision(7))]);
  at("fragments").replaceChildren(...rows.map((row, i) => {
    const line = document.createElement("tr");
    line.append(...row.map((cell) => Object.assign(document.createElement(i === 0 ? "th" : "td"), { textContent: cell })));
    return line;
  }));
}

async function inspect(x, y) {
  if (!shown || !layers) return;
  const [width, height] = shown.q.size;
  pixel = { x: Math.max(0, Math.min(width - 1, x)), y: Math.max(0, Math.min(height - 1, y)) };
  at("x").value = pixel.x;
  at("y").value = pixel.y;
  showFragments();
  at("history").textContent = "Looking.";
  document.body.dataset.inspected = "";
  const { answer } = await ask({ ...shown.q, do: "explain", pixel: [pixel.x, pixel.y] });
  at("history").textContent = answer.text ?? answer.error;
  document.body.dataset.inspected = "yes";
}

function turn(dx, dy) {
  const [azimuth, elevation] = orbit ?? [30, 20];
  orbit = [azimuth - dx, Math.max(-90, Math.min(90, elevation + dy))];
  render();
}

function followPointer() {
  const canvas = at("picture");
  let from = null, moved = false;
  canvas.addEventListener("pointerdown", (event) => { from = event; moved = false; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!from || Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) < 4) return;
    turn(Math.round((event.clientX - from.clientX) / 2), Math.round((event.clientY - from.clientY) / 2));
    from = event;
    moved = true;
  });
  canvas.addEventListener("pointerup", (event) => {
    const box = canvas.getBoundingClientRect();
    if (from && !moved) inspect(Math.floor((event.clientX - box.left) / box.width * canvas.width), Math.floor((event.clientY - box.top) / box.height * canvas.height));
    from = null;
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [10, 0], ArrowRight: [-10, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] }[event.key];
    if (event.key === "Enter") inspect(pixel.x, pixel.y);
    if (!step) return;
    event.preventDefault();
    turn(...step);
  });
}

async function open(file) {
  const bytes = await file.arrayBuffer();
  files.add(file.name);
  at("scene").value = file.name;
  orbit = null;
  await ask({ do: "lists" }, { name: file.name, bytes });
  render();
}

function tellAlgorithm() {
  const chosen = lists.algorithms.find((a) => a.name === at("algorithm").value);
  at("about").textContent = chosen.summary + (chosen.paper ? ` (${chosen.paper})` : "");
}

async function start() {
  lists = (await ask({ do: "lists" })).answer;
  const option = (name) => Object.assign(document.createElement("option"), { value: name, textContent: name });
  at("algorithm").append(...lists.algorithms.map((a) => option(a.name)));
  at("profile").append(...lists.profiles.map((p) => option(p.name)));
  at("scenes").append(...lists.scenes.map((s) => option(s.name)));
  at("algorithm").value = "dual";
  at("profile").value = "geforce8";
  tellAlgorithm();
  makeOptions();
  at("choices").addEventListener("submit", (event) => { event.preventDefault(); orbit = null; render(); });
  at("algorithm").addEventListener("change", () => { tellAlgorithm(); render(); });
  at("profile").addEventListener("change", render);
  at("layer").addEventListener("input", drawLayer);
  for (const id of ["x", "y"]) at(id).addEventListener("change", () => inspect(Number(at("x").value), Number(at("y").value)));
  at("file").addEventListener("change", () => { if (at("file").files[0]) open(at("file").files[0]); });
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => { event.preventDefault(); if (event.dataTransfer.files[0]) open(event.dataTransfer.files[0]); });
  followPointer();
  render();
}
start();
