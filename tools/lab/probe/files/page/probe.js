// Renders every scene of the kit with WebGL 2 and packs the answers for `strata infer`. Clip-space +y points down in
// memory here: WebGL has no clip control, and a framebuffer's first row is its lowest.
const orientation = 'down';
const element = (id) => document.getElementById(id);

const vertexText = `#version 300 es
layout(location = 0) in highp vec4 clip;
layout(location = 1) in highp vec4 cornerColor;
out highp vec4 color;
void main() { gl_Position = clip; color = cornerColor; }`;
const fragmentText = `#version 300 es
in highp vec4 color;
layout(location = 0) out highp vec4 drawn;
void main() { drawn = color; }`;
// A depth buffer cannot be read back: this pass reads it as a texture and writes the bits of its floats.
const quadText = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
const bitsText = `#version 300 es
uniform highp sampler2D depth;
layout(location = 0) out highp uvec4 bits;
void main() { bits = uvec4(floatBitsToUint(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r), 0u, 0u, 0u); }`;

const equations = { add: 'FUNC_ADD', subtract: 'FUNC_SUBTRACT', reverse_subtract: 'FUNC_REVERSE_SUBTRACT', min: 'MIN', max: 'MAX' };

// Words of a text of hexadecimal digits, 8 per word.
function wordsOf(digits) {
  const words = new Uint32Array(digits.length / 8);
  for (let i = 0; i < words.length; ++i) words[i] = parseInt(digits.substring(8 * i, 8 * i + 8), 16);
  return words;
}
const floatsOf = (digits) => new Float32Array(wordsOf(digits).buffer);

// The first error of a compiler's output, because the others follow from it.
const firstLine = (log) => log.trim().split('\n')[0];

function makeProgram(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(firstLine(gl.getShaderInfoLog(shader)));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(firstLine(gl.getProgramInfoLog(program)));
  return program;
}

function makeTexture(gl, format, width, height) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

function makeDevice() {
  const canvas = document.createElement('canvas');
  const gl = canvas.getContext('webgl2', { antialias: false, depth: false, stencil: false });
  if (!gl) throw new Error('this browser has no WebGL 2');
  const device = { gl, canFloat: gl.getExtension('EXT_color_buffer_float') !== null, canBlendFloat: gl.getExtension('EXT_float_blend') !== null };
  device.draw = makeProgram(gl, vertexText, fragmentText);
  device.bits = makeProgram(gl, quadText, bitsText);
  device.layout = gl.createVertexArray();
  device.buffer = gl.createBuffer();
  device.empty = gl.createVertexArray();
  gl.bindVertexArray(device.layout);
  gl.bindBuffer(gl.ARRAY_BUFFER, device.buffer);
  for (let i = 0; i < 2; ++i) {
    gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(i, 4, gl.FLOAT, false, 32, 16 * i);
  }
  gl.disable(gl.DITHER);
  gl.disable(gl.CULL_FACE);
  return device;
}

// The reason why the device cannot render the scene; empty if it can.
function refusal(device, item) {
  if (item.draws.some((draw) => draw.alpha_above !== null)) return 'WebGL 2 has no alpha test';
  if (item.color !== 'rgba8' && !device.canFloat) return 'no float targets (EXT_color_buffer_float)';
  const blends = item.draws.some((draw) => draw.blend !== null);
  if (item.color === 'rgba32f' && blends && !device.canBlendFloat) return 'no blending of binary32 (EXT_float_blend)';
  return '';
}

function drawItem(device, item, target) {
  const { gl } = device, [width, height] = item.size, range = floatsOf(item.depth_range);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.viewport(0, 0, width, height);
  gl.depthRange(range[0], range[1]);
  gl.depthMask(true);
  gl.depthFunc(gl.ALWAYS);
  gl[item.depth === null ? 'disable' : 'enable'](gl.DEPTH_TEST);
  gl.clearColor(...floatsOf(item.clear));
  gl.clearDepth(1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.useProgram(device.draw);
  gl.bindVertexArray(device.layout);
  gl.bindBuffer(gl.ARRAY_BUFFER, device.buffer);
  for (const draw of item.draws) {
    gl[draw.blend ? 'enable' : 'disable'](gl.BLEND);
    if (draw.blend) {
      gl.blendEquation(gl[equations[draw.blend[0]]]);
      gl.blendFunc(gl[draw.blend[1].toUpperCase()], gl[draw.blend[2].toUpperCase()]);
    }
    gl[draw.polygon_offset ? 'enable' : 'disable'](gl.POLYGON_OFFSET_FILL);
    if (draw.polygon_offset) gl.polygonOffset(...floatsOf(draw.polygon_offset));
    const words = wordsOf(draw.corners);
    gl.bufferData(gl.ARRAY_BUFFER, words, gl.STREAM_DRAW);
    gl.drawArrays(gl.TRIANGLES, 0, words.length / 8);
  }
  gl.disable(gl.BLEND);
  gl.disable(gl.POLYGON_OFFSET_FILL);
}

// The bits of a half whose value is given as a float.
function halfBits(value) {
  const bits = new Uint32Array(new Float32Array([value]).buffer)[0], sign = (bits >>> 16) & 0x8000;
  const exponent = (bits >>> 23) & 0xff, mantissa = bits & 0x7fffff;
  if (exponent === 255) return sign | 0x7c00 | (mantissa ? 0x200 : 0);
  if (exponent > 112) return sign | ((exponent - 112) << 10) | (mantissa >>> 13);
  return exponent < 103 ? sign : sign | ((mantissa | 0x800000) >>> (126 - exponent));
}

function readColor(gl, item) {
  const [width, height] = item.size, count = 4 * width * height;
  if (item.color === 'rgba8') {
    const codes = new Uint8Array(count);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
    return npy('|u1', [height, width, 4], codes);
  }
  const values = new Float32Array(count);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, values);
  if (item.color === 'rgba32f') return npy('<f4', [height, width, 4], new Uint8Array(values.buffer));
  return npy('<f2', [height, width, 4], new Uint8Array(Uint16Array.from(values, halfBits).buffer));
}

function readDepth(device, item, depth) {
  const { gl } = device, [width, height] = item.size;
  const bits = makeTexture(gl, gl.RGBA32UI, width, height), target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, bits, 0);
  gl.bindTexture(gl.TEXTURE_2D, depth);
  gl.disable(gl.DEPTH_TEST);
  gl.useProgram(device.bits);
  gl.bindVertexArray(device.empty);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const words = new Uint32Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
  gl.deleteFramebuffer(target);
  gl.deleteTexture(bits);
  return npy('<f4', [height, width], new Uint8Array(words.filter((word, i) => i % 4 === 0).buffer));
}

// The files of one scene's answer; an Error with the reason if there is none.
function answer(device, item) {
  const { gl } = device, [width, height] = item.size;
  const why = refusal(device, item);
  if (why) throw new Error(why);
  while (gl.getError() !== gl.NO_ERROR);
  const color = makeTexture(gl, gl[item.color.toUpperCase()], width, height);
  const formats = { d16: gl.DEPTH_COMPONENT16, d24: gl.DEPTH_COMPONENT24, d32f: gl.DEPTH_COMPONENT32F };
  const depth = item.depth === null ? null : makeTexture(gl, formats[item.depth], width, height);
  const target = gl.createFramebuffer();
  try {
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
    if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error('the targets cannot be drawn to together');
    drawItem(device, item, target);
    const files = { 'color.npy': readColor(gl, item) };
    if (depth) files['depth.npy'] = readDepth(device, item, depth);
    const error = gl.getError();
    if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
    return files;
  } finally {
    gl.deleteFramebuffer(target);
    gl.deleteTexture(color);
    if (depth) gl.deleteTexture(depth);
  }
}

// NPY 1.0: a header of 128 bytes, then the array as in memory (all computers with browsers are little endian).
function npy(type, shape, bytes) {
  const text = `{'descr': '${type}', 'fortran_order': False, 'shape': (${shape.join(', ')}), }`;
  const head = '\x93NUMPY\x01\x00\x76\x00' + text.padEnd(117, ' ') + '\n';
  const file = new Uint8Array(128 + bytes.length);
  for (let i = 0; i < 128; ++i) file[i] = head.charCodeAt(i);
  file.set(bytes, 128);
  return file;
}

// One file of a tar archive (ustar): a header of 512 bytes, then the content in blocks of 512.
function tarEntry(name, bytes) {
  const entry = new Uint8Array(512 + Math.ceil(bytes.length / 512) * 512);
  const put = (at, text) => { for (let i = 0; i < text.length; ++i) entry[at + i] = text.charCodeAt(i); };
  put(0, name);
  put(100, '0000644\0' + '0000000\0' + '0000000\0');
  put(124, bytes.length.toString(8).padStart(11, '0') + '\0' + '00000000000\0' + '        ' + '0');
  put(257, 'ustar\x0000');
  const sum = entry.subarray(0, 512).reduce((a, b) => a + b, 0);
  put(148, sum.toString(8).padStart(6, '0') + '\0 ');
  entry.set(bytes, 512);
  return entry;
}

function featuresOf(device) {
  const { gl } = device;
  return {
    has_d16: true, has_d24: true, has_d32f: true, has_d16f: false, has_d24f: false, has_narrow_surfaces: false,
    has_float_targets: device.canFloat && device.canBlendFloat, has_fragment_programs: true, has_separate_alpha_blend: true,
    has_independent_blend: gl.getExtension('OES_draw_buffers_indexed') !== null, has_two_sided_stencil: true,
    has_depth_clamp: gl.getExtension('EXT_depth_clamp') !== null, has_depth_replace: false, has_signed_blend: false, has_logic_op: false,
    max_render_targets: gl.getParameter(gl.MAX_DRAW_BUFFERS), max_texture_units: gl.getParameter(gl.MAX_TEXTURE_IMAGE_UNITS),
    max_viewport_px: gl.getParameter(gl.MAX_VIEWPORT_DIMS)[0], max_samples: gl.getParameter(gl.MAX_SAMPLES),
  };
}

function rendererOf(gl) {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

const nextFrame = () => new Promise((resolve) => setTimeout(resolve, 0));

async function measure() {
  const kit = JSON.parse(element('kit').textContent);
  const device = makeDevice(), entries = [], missing = {}, count = kit.items.length;
  element('progress').max = count;
  for (const [number, item] of kit.items.entries()) {
    const place = `${orientation}/${item.name}`;
    try {
      for (const [name, bytes] of Object.entries(answer(device, item))) entries.push(tarEntry(`probe/${place}/${name}`, bytes));
    } catch (error) {
      missing[place] = error.message;
      const row = element('reasons').insertRow();
      row.insertCell().textContent = item.name;
      row.insertCell().textContent = error.message;
      element('skipped').hidden = false;
    }
    element('progress').value = number + 1;
    element('status').textContent = `Scene ${number + 1} of ${count}: ${item.name}`;
    await nextFrame();
  }
  const candidate = { format: 'strata-candidate', version: 1, made_by: `strata probe page, ${rendererOf(device.gl)}`,
    probe: { kit: kit.digest, device: featuresOf(device), missing } };
  entries.push(tarEntry('candidate.json', new TextEncoder().encode(JSON.stringify(candidate, null, 1))), new Uint8Array(1024));
  element('download').href = URL.createObjectURL(new Blob(entries, { type: 'application/x-tar' }));
  element('offer').hidden = false;
  const skipped = Object.keys(missing).length;
  element('status').textContent = `${count - skipped} of ${count} scenes drawn by ${rendererOf(device.gl)}. The answers are ready.`;
  element('download').focus();
}

element('start').addEventListener('click', async () => {
  element('start').disabled = true;
  try {
    await measure();
    document.body.dataset.ready = 'yes';
  } catch (error) {
    element('status').textContent = `Nothing can be measured: ${error.message}`;
    document.body.dataset.ready = 'failed';
  }
});
