"use strict";
// All pictures are drawn from the numbers in this file: #data is a document, and each .blob an array (byte planes, deflate, base64).
const report = JSON.parse(document.getElementById("data").textContent);
const blobs = [...document.querySelectorAll("script.blob")].map((element) => element.textContent);
const { width, height } = report, [originX, originY] = report.origin;
const at = (id) => document.getElementById(id);
const fates = ["none", "masked by its material's alpha", "discarded by the program", "alpha test", "sequential depth unit",
  "stencil test", "depth test"];
const palette = ["#000000", "#f0e442", "#56b4e9", "#e69f00", "#cc79a7", "#d55e00", "#009e73", "#ffffff"];  // also in order of lightness

async function bytesOf(number) {
  const packed = Uint8Array.from(atob(blobs[number]), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function wordsOf(number, size) {
  const bytes = await bytesOf(number), count = bytes.length / size;
  const words = size === 1 ? bytes : size === 2 ? new Uint16Array(count) : new Uint32Array(count);
  if (size === 1) return words;
  for (let plane = 0; plane < size; ++plane)
    for (let i = 0; i < count; ++i) words[i] = (words[i] | (bytes[plane * count + i] << (8 * plane))) >>> 0;
  return words;
}

const floatsOf = async (number) => new Float32Array((await wordsOf(number, 4)).buffer);
const hex = (word, digits = 8) => (word >>> 0).toString(16).padStart(digits, "0");

function halfValue(code) {
  const sign = code & 0x8000 ? -1 : 1, exponent = (code >> 10) & 31, fraction = code & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

const single = new DataView(new ArrayBuffer(4));
function valueOf(code, format) {
  if (format.includes("32f")) { single.setUint32(0, code); return single.getFloat32(0); }
  return format.includes("16f") ? halfValue(code) : code / 255;
}

// Frames that blend linear light are encoded for the screen; others have sRGB values.
const encoded = (v) => report.colour !== "linear" ? v : v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
const byte = (v) => Math.max(0, Math.min(255, Math.round(v * 255)));

function paint(canvas, colorOf) {
  canvas.width = width; canvas.height = height;
  const context = canvas.getContext("2d"), image = context.createImageData(width, height);
  for (let p = 0; p < width * height; ++p) {
    const [r, g, b] = colorOf(p);
    image.data.set([r, g, b, 255], 4 * p);
  }
  context.putImageData(image, 0, 0);
}

function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function fillRow(row, cells, name = "td") {
  for (const cell of cells) {
    const made = element(name, cell instanceof Node ? undefined : String(cell.text ?? cell));
    if (cell instanceof Node) made.append(cell);
    if (cell.bits) made.className = "bits";
    row.append(made);
  }
}

const shown = report.algorithms.filter((algorithm) => algorithm.refusal === null);
const exact = () => shown.find((algorithm) => algorithm.name === "a_buffer");
let columns, history, pixel = { x: 0, y: 0 };

async function unpack() {
  for (const algorithm of shown) {
    const { codes, channels, format } = algorithm.picture;
    algorithm.codes = await wordsOf(codes, 4);
    algorithm.values = Float32Array.from(algorithm.codes, (code) => valueOf(code, format));
    algorithm.channels = channels;
    for (const sample of algorithm.samples)
      sample.values = Float32Array.from(await wordsOf(sample.codes, 4), (code) => valueOf(code, sample.format));
    algorithm.taken = algorithm.taken == null ? null : await wordsOf(algorithm.taken, 2);
    algorithm.killer = algorithm.killer == null ? null : await wordsOf(algorithm.killer, 1);
  }
  const f = report.fragments;
  columns = { count: await wordsOf(f.count, 2), all: await wordsOf(f.all, 2), z: await floatsOf(f.z), code: await wordsOf(f.code, 4),
    primitive: await wordsOf(f.primitive, 4), arrival: await wordsOf(f.arrival, 4), color: [] };
  for (const channel of f.color) columns.color.push(await floatsOf(channel));
  columns.first = new Uint32Array(width * height + 1);
  for (let p = 0; p < width * height; ++p) columns.first[p + 1] = columns.first[p] + columns.count[p];
  if (report.history !== null)
    history = { ...report.history, begin: await wordsOf(report.history.begin, 4), text: await bytesOf(report.history.text) };
}

const colorAt = (algorithm, p) => [0, 1, 2].map((c) => byte(encoded(algorithm.values[p * algorithm.channels + c])));
function differenceAt(algorithm, p) {
  let most = 0;
  for (let c = 0; c < 3; ++c)
    most = Math.max(most, Math.abs(algorithm.values[p * algorithm.channels + c] - exact().values[p * exact().channels + c]));
  return most;
}
const heat = (v) => { const t = Math.min(1, v) * 3; return [byte(t), byte(t - 1), byte(t - 2)]; };

const drawings = [];  // functions that draw again when a control changes
function drawSheet() {
  const gain = 2 ** Number(at("gain").value);
  at("gain-value").textContent = gain;
  for (const draw of drawings) draw(gain);
}

// A long name may break after its underscores.
function broken(tag, name) {
  const whole = element(tag);
  name.split(/(?<=_)/).forEach((part, i) => whole.append(...(i > 0 ? [element("wbr")] : []), part));
  return whole;
}

function buildSheet() {
  if (!exact()) at("sheet-text").textContent = "Choose one to look at it closely. Differences from the exact picture are drawn where a_buffer is among the algorithms.";
  at("gain-row").hidden = !exact();
  for (const algorithm of report.algorithms) {
    const card = element("article", undefined, { class: "card", "data-algorithm": algorithm.name });
    card.append(broken("h3", algorithm.name), element("p", algorithm.summary + "."));
    at("sheet").append(card);
    if (algorithm.refusal !== null) { card.append(element("p", "Refused: " + algorithm.refusal)); continue; }
    const picture = element("canvas", undefined, { role: "img", tabindex: "0", "aria-label": "Picture by " + algorithm.name });
    const error = element("canvas", undefined, { role: "img", "aria-label": "Difference of " + algorithm.name + " from the A-buffer" });
    const s = algorithm.stats;
    const words = s.max_difference_from_a_buffer === null ? "" : "at most " + s.max_difference_from_a_buffer.toFixed(3) + "/255 off; ";
    card.append(picture, ...(exact() ? [error] : []), element("p", words + s.geometry_passes + (s.geometry_passes === 1 ? " pass" : " passes") +
      (s.order_errors ? "; " + s.order_errors + " fragments out of order" : "") + (s.lost_by_ties ? "; " + s.lost_by_ties + " lost by ties" : "")));
    paint(picture, (p) => colorAt(algorithm, p));
    const row = element("div", undefined, { class: "samples" });
    for (const [i, sample] of algorithm.samples.entries()) {
      row.append(element("canvas", undefined, { role: "img", "aria-label": `Sample ${i} of the picture by ${algorithm.name}` }));
      paint(row.lastChild, (p) => colorAt(sample, p));
    }
    if (row.firstChild) card.append(element("p", "Its samples, which the picture above resolves:"), row);
    picture.addEventListener("click", (event) => { at("right").value = algorithm.name; drawCompare(); pick(event, picture); });
    followKeys(picture);
    if (exact()) drawings.push((gain) => paint(error, (p) => heat(gain * differenceAt(algorithm, p))));
  }
}

const named = (name) => shown.find((algorithm) => algorithm.name === name);
function drawCompare() {
  const left = named(at("left").value), right = named(at("right").value);
  if (!left || !right) return;
  const edge = Math.round(width * at("divide").value / 100);
  paint(at("compare"), (p) => p % width === edge && edge > 0 && edge < width ? [255, 0, 255] : colorAt(p % width < edge ? left : right, p));
  let differing = 0;
  for (let p = 0; p < width * height; ++p)
    for (let c = 0; c < 3; ++c)
      if (left.codes[p * left.channels + c] !== right.codes[p * right.channels + c]) { ++differing; break; }
  at("compare-text").textContent = `${left.name} and ${right.name}: ${differing} of ${width * height} pixels differ.`;
}

const deepest = () => columns.count.reduce((most, count) => Math.max(most, count), 0);
function drawLayer() {
  const layer = Number(at("layer").value), near = Number(at("near").value), far = Number(at("far").value);
  let present = 0;
  for (let p = 0; p < width * height; ++p) present += columns.count[p] > layer ? 1 : 0;
  at("layer-value").textContent = `${layer} of 0 to ${deepest() - 1}: ${present} pixels`;
  const fragment = (p) => columns.count[p] > layer ? columns.first[p] + layer : -1;
  const paper = (p) => ((p % width >> 3) + (Math.floor(p / width) >> 3)) % 2 ? [150, 150, 150] : [180, 180, 180];
  paint(at("layer-color"), (p) => {
    const f = fragment(p);
    if (f < 0) return paper(p);
    const alpha = columns.color[3][f], under = paper(p);
    return [0, 1, 2].map((c) => Math.round(alpha * byte(encoded(columns.color[c][f])) + (1 - alpha) * under[c]));
  });
  paint(at("layer-depth"), (p) => {
    const f = fragment(p);
    if (f < 0) return [40, 40, 60];
    const v = byte(1 - (columns.z[f] - near) / (far - near || 1) * 0.9);
    return [v, v, v];
  });
}

function fitDepth() {
  let near = Infinity, far = -Infinity;
  for (const z of columns.z) { near = Math.min(near, z); far = Math.max(far, z); }
  at("near").value = Number.isFinite(near) ? near : 0;
  at("far").value = Number.isFinite(far) ? far : 1;
}

const passOf = (taken) => (taken & 0x7fff) - 1;
const maps = {
  "depth complexity": { of: (p) => columns.all[p], text: "Fragments of a pixel" },
  "ties": { of: tiesAt, text: `Fragments whose exact depth has the ${report.depth_format} code of another one's of their pixel`,
    note: "An algorithm loses those that tie by the depth that it computes itself, so that its number of fragments lost by ties may be another one." },
  "difference from the A-buffer": { needs: () => exact(), lacks: "a_buffer is not among the algorithms", of: (p, a) => differenceAt(a, p) * 255, text: "Largest difference of a channel, in 255ths" },
  "fragments never composited": { needs: (a) => a.taken, of: lostAt, text: "Fragments that no pass composited" },
  "pass that took the nearest": { needs: (a) => a.taken, of: firstTakenAt, text: "Number of the pass and 1; 0: none did" },
  "test that killed most": { needs: (a) => a.killer, of: (p, a) => a.killer[p], classes: fates, text: "Which test rejected most fragments of a pixel in all passes" },
};
function tiesAt(p) {
  const codes = columns.code.slice(columns.first[p], columns.first[p + 1]).sort();  // sorted as codes, because two codes may have one float
  return codes.reduce((ties, code, i) => ties + (code === codes[i - 1] || code === codes[i + 1] ? 1 : 0), 0);
}
function lostAt(p, a) {
  let lost = 0;
  for (let f = columns.first[p]; f < columns.first[p + 1]; ++f) lost += a.taken[f] === 0 ? 1 : 0;
  return lost;
}
function firstTakenAt(p, a) {
  return columns.count[p] ? Math.max(0, passOf(a.taken[columns.first[p]]) + 1) : 0;
}

// The numbers of a legend: all if there are few, else the ends and two between.
const steps = (most) => Number.isInteger(most) && most <= 9 ? Array.from({ length: most + 1 }, (_, i) => i) : [0, most / 3, 2 * most / 3, most];

function drawMap() {
  const map = maps[at("map").value], algorithm = named(at("map-algorithm").value);
  at("legend").replaceChildren();
  if (!algorithm || (map.needs && !map.needs(algorithm))) {
    paint(at("map-canvas"), () => [40, 40, 60]);
    at("map-text").textContent = `${at("map-algorithm").value} has no such map: ${map.lacks ?? "it does not say what it composites"}.`;
    return;
  }
  const values = Array.from({ length: width * height }, (_, p) => map.of(p, algorithm));
  const most = values.reduce((a, b) => Math.max(a, b), 0);
  const rgb = (text) => [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
  paint(at("map-canvas"), (p) => map.classes ? rgb(palette[values[p]]) : heat(most > 0 ? values[p] / most : 0));
  const sum = values.reduce((a, b) => a + b, 0);
  at("map-text").textContent = map.classes ? map.text + "." : `${map.text}: at most ${+most.toFixed(3)}, in all ${+sum.toFixed(3)}.` + (map.note ? " " + map.note : "");
  const legend = map.classes ? map.classes.map((name, i) => [palette[i], name]) : steps(most).map((v) => ["#" + heat(most > 0 ? v / most : 0).map((c) => hex(Math.round(c), 2)).join(""), String(+v.toFixed(3))]);
  for (const [color, name] of legend) {
    const entry = element("span"), swatch = element("span", undefined, { class: "swatch" });
    swatch.style.background = color;
    entry.append(swatch, name);
    at("legend").append(entry);
  }
}

function meshOf(primitive) {
  let name = "";
  for (const mesh of report.meshes) if (mesh.first <= primitive) name = mesh.name;
  return name;
}

function emptyTable(id, names) {
  const head = element("tr");
  fillRow(head, names, "th");
  at(id).replaceChildren(head);
  return at(id);
}

function showFragments(p) {
  const tracing = shown.filter((algorithm) => algorithm.taken);
  const table = emptyTable("fragments", ["layer", "mesh", "triangle", "arrives", "depth", "bits of z", "code", "red", "green", "blue", "alpha",
    ...tracing.map((a) => a.name)]);
  for (let f = columns.first[p]; f < columns.first[p + 1]; ++f) {
    const row = element("tr");
    single.setFloat32(0, columns.z[f]);
    fillRow(row, [f - columns.first[p], meshOf(columns.primitive[f]), columns.primitive[f], columns.arrival[f], columns.z[f].toPrecision(9),
      { text: hex(single.getUint32(0)), bits: true }, { text: hex(columns.code[f]), bits: true },
      ...columns.color.map((channel) => channel[f].toPrecision(7)),
      ...tracing.map((a) => a.taken[f] === 0 ? "never" : `pass ${passOf(a.taken[f])}, ${a.taken[f] & 0x8000 ? "far" : "near"} end`)]);
    table.append(row);
  }
}

function showStored(p) {
  const table = emptyTable("stored", ["algorithm", "stores (bits)", "red", "green", "blue"]);
  for (const algorithm of shown) {
    const row = element("tr"), codes = [...algorithm.codes.slice(p * algorithm.channels, (p + 1) * algorithm.channels)];
    const digits = algorithm.picture.format.includes("32f") ? 8 : algorithm.picture.format.includes("16f") ? 4 : 2;
    fillRow(row, [algorithm.name, { text: codes.map((code) => hex(code, digits)).join(" "), bits: true },
      ...[0, 1, 2].map((c) => algorithm.values[p * algorithm.channels + c].toPrecision(7))]);
    table.append(row);
  }
}

function historyAt(x, y) {
  if (!history) return "";
  const [x0, y0, x1, y1] = history.box;
  if (x < x0 || x >= x1 || y < y0 || y >= y1) return "";
  const slot = (y - y0) * (x1 - x0) + x - x0;
  return new TextDecoder().decode(history.text.slice(history.begin[slot], history.begin[slot + 1]));
}

function select(x, y) {
  pixel = { x: Math.max(0, Math.min(width - 1, x)), y: Math.max(0, Math.min(height - 1, y)) };
  const x0 = pixel.x + originX, y0 = pixel.y + originY;  // in the frame
  at("x").value = x0; at("y").value = y0;
  const p = pixel.y * width + pixel.x;
  at("pixel-text").textContent = `Pixel ${x0},${y0}: ${columns.all[p]} fragments` +
    (columns.all[p] > columns.count[p] ? `, the nearest ${columns.count[p]} of them here.` : ".");
  showFragments(p);
  showStored(p);
  const algorithm = history ? history.algorithm : shown[0].name;
  const command = named(algorithm).command.replace("strata render", "strata explain") + ` --pixel ${x0},${y0}`;
  at("history").textContent = historyAt(pixel.x, pixel.y) ||
    (columns.all[p] === 0 ? "Nothing was drawn here.\n" : "The whole history of this pixel is not in this page. It is what this command prints:\n") + command;
}

function pick(event, canvas) {
  const box = canvas.getBoundingClientRect();
  select(Math.floor((event.clientX - box.left) / box.width * width), Math.floor((event.clientY - box.top) / box.height * height));
}
function followKeys(canvas) {
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    select(pixel.x + far * step[0], pixel.y + far * step[1]);
  });
}

const numbers = [["algorithm", (a) => a.name], ["passes", (a) => a.stats.geometry_passes], ["full screen", (a) => a.stats.fullscreen_passes],
  ["layers", (a) => a.stats.layers_max], ["order errors", (a) => a.stats.order_errors], ["lost by ties", (a) => a.stats.lost_by_ties],
  ["max difference /255", (a) => a.stats.max_difference_from_a_buffer], ["fragments", (a) => a.stats.counters.fragments_rasterized],
  ["blended", (a) => a.stats.counters.blended], ["digest", (a) => a.picture.digest.slice(0, 12)]];
let sorted = { column: -1, falling: false };
function showNumbers() {
  const table = at("numbers"), head = element("tr");
  table.replaceChildren(head);
  numbers.forEach(([name], column) => {
    const cell = element("th", undefined, { scope: "col", "aria-sort": sorted.column !== column ? "none" : sorted.falling ? "descending" : "ascending" });
    const button = element("button", name, { type: "button" });
    button.addEventListener("click", () => {
      sorted = { column, falling: sorted.column === column && !sorted.falling };
      showNumbers();
      at("numbers").querySelectorAll("th button")[column].focus();
    });
    cell.append(button);
    head.append(cell);
  });
  const rows = [...shown];
  if (sorted.column >= 0) {
    const key = numbers[sorted.column][1];
    rows.sort((a, b) => (key(a) > key(b) ? 1 : key(a) < key(b) ? -1 : 0) * (sorted.falling ? -1 : 1));
  }
  for (const algorithm of rows) {
    const row = element("tr");
    fillRow(row, numbers.map(([, key]) => { const v = key(algorithm); return v === null ? "-" : Number.isInteger(v) || typeof v === "string" ? v : v.toFixed(3); }));
    table.append(row);
  }
}

function showRest() {
  for (const algorithm of report.algorithms) {
    for (const d of algorithm.refusal === null ? algorithm.stats.diagnostics : [])
      at("diagnostics").append(element("li", `${algorithm.name}: ${d.fault.replaceAll("_", " ")}` +
        (d.pixels ? ` at ${d.pixels} pixels, first at ${d.first.join(",")}` : "") + (d.detail ? `: ${d.detail}` : "")));
    const entry = element("p", algorithm.name + ": ");
    const command = element("code");
    for (const word of algorithm.command.split(" ")) command.append(...(command.childNodes.length ? [" "] : []), element("span", word, { class: "word" }));
    entry.append(command, algorithm.refusal === null ? `, digest ${algorithm.picture.digest}` : ", refused");
    at("again").append(entry);
  }
  for (const sentence of report.left_out) at("left-out").append(element("li", sentence));
  if (report.left_out.length === 0) at("left-out").append(element("li", "nothing"));
}

function fillChoices() {
  for (const id of ["left", "right", "map-algorithm"])
    for (const algorithm of shown) at(id).append(element("option", algorithm.name));
  for (const name of Object.keys(maps)) at("map").append(element("option", name));
  const first = shown.find((a) => a.name === "dual") ?? shown.find((a) => a.exact) ?? shown[0];
  at("left").value = shown.find((a) => !a.exact)?.name ?? first.name;
  at("right").value = at("map-algorithm").value = first.name;
}

async function start() {
  document.title = `Strata report: ${report.scene}`;
  at("title").textContent = report.scene;
  const [frameWidth, frameHeight] = report.frame;
  const part = frameWidth > width || frameHeight > height ? ` at ${originX},${originY} of ${frameWidth} x ${frameHeight}` : "";
  at("subtitle").textContent = `${width} x ${height} pixels${part} on ${report.profile}, depth ${report.depth_format}, ${report.colour} colours, Strata ${report.version}`;
  showRest();
  if (shown.length === 0) { document.body.dataset.ready = "yes"; return; }
  await unpack();
  fillChoices();
  buildSheet();
  drawSheet();
  drawCompare();
  at("layer").max = Math.max(0, deepest() - 1);
  fitDepth();
  drawLayer();
  drawMap();
  showNumbers();
  at("x").min = originX; at("y").min = originY;
  at("x").max = originX + width - 1; at("y").max = originY + height - 1;
  // Begins with the deepest pixel whose history is in this page.
  const told = (p) => historyAt(p % width, Math.floor(p / width)) !== "";
  let deep = 0;
  for (let p = 0; p < width * height; ++p)
    if (columns.all[p] > 0 && (told(p) > told(deep) || (told(p) === told(deep) && columns.all[p] > columns.all[deep]))) deep = p;
  select(deep % width, Math.floor(deep / width));
  at("gain").addEventListener("input", drawSheet);
  for (const id of ["left", "right", "divide"]) at(id).addEventListener("input", drawCompare);
  for (const id of ["layer", "near", "far"]) at(id).addEventListener("input", drawLayer);
  at("fit").addEventListener("click", () => { fitDepth(); drawLayer(); });
  for (const id of ["map", "map-algorithm"]) at(id).addEventListener("input", drawMap);
  for (const id of ["x", "y"]) at(id).addEventListener("change", () => select(Number(at("x").value) - originX, Number(at("y").value) - originY));
  for (const id of ["compare", "layer-color", "layer-depth", "map-canvas"]) {
    at(id).addEventListener("click", (event) => pick(event, at(id)));
    followKeys(at(id));
  }
  document.body.dataset.ready = "yes";
}
start();
