'use strict';
// Operations of shaders, textures and tests: a fragment reads four words of its texel and writes four.
const esHead = '#version 300 es\nprecision highp float;\nprecision highp int;\n';
const stencilReference = 0xa5;

// A texture of one row, or of the inputs.
function makeSource(gl, sized, external, type, width, height, texels) {
  const texture = makeTexture(gl, gl[sized], width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl[external], gl[type], texels);
  return texture;
}

function makeImage(gl, image) {
  const words = wordsOf(image.texels), floats = new Float32Array(words.buffer), bytes = new Uint8Array(words.buffer);
  const [sized, external, type, texels] = {
    r32f: ['R32F', 'RED', 'FLOAT', floats], r16f: ['R16F', 'RED', 'FLOAT', floats],
    rgba8: ['RGBA8', 'RGBA', 'UNSIGNED_BYTE', bytes], srgb8: ['SRGB8_ALPHA8', 'RGBA', 'UNSIGNED_BYTE', bytes],
    d16: ['DEPTH_COMPONENT16', 'DEPTH_COMPONENT', 'UNSIGNED_SHORT', Uint16Array.from(words)],
    d24: ['DEPTH_COMPONENT24', 'DEPTH_COMPONENT', 'UNSIGNED_INT', words.map((word) => (word << 8) | (word >>> 16))],
    d32f: ['DEPTH_COMPONENT32F', 'DEPTH_COMPONENT', 'FLOAT', floats],
  }[image.format];
  const texture = makeSource(gl, sized, external, type, words.length, 1, texels);
  const filter = image.linear ? gl.LINEAR : gl.NEAREST;
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  if (image.compare) {
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL);
  }
  return texture;
}

function makeOperationProgram(gl, { vertex, fragment }) {
  const program = makeProgram(gl, esHead + vertex, esHead + fragment);
  gl.useProgram(program);
  for (const [unit, name] of ['inputs', 'image'].entries()) gl.uniform1i(gl.getUniformLocation(program, name), unit);
  return program;
}

// In each column: the initial value, one draw with the operation, then one bit per row by EQUAL.
function drawStencil(gl, work, inputs, draw) {
  const [width, height] = work.size;
  const steps = [gl.KEEP, gl.ZERO, gl.REPLACE, gl.INCR, gl.DECR, gl.INVERT, gl.INCR_WRAP, gl.DECR_WRAP];
  gl.enable(gl.SCISSOR_TEST);
  gl.enable(gl.STENCIL_TEST);
  gl.enable(gl.DEPTH_TEST);
  for (let x = 0; x < width; ++x) {
    const [value, step, when] = inputs.subarray(4 * x, 4 * x + 3), chosen = (k) => (k === when ? steps[step] : gl.KEEP);
    gl.scissor(x, 0, 1, height);
    gl.clearStencil(value);
    gl.clear(gl.STENCIL_BUFFER_BIT);
    gl.colorMask(false, false, false, false);
    gl.depthFunc(when === 1 ? gl.NEVER : gl.ALWAYS);
    gl.stencilFunc(when === 0 ? gl.NEVER : gl.ALWAYS, stencilReference, 255);
    gl.stencilOp(chosen(0), chosen(1), chosen(2));
    draw();
    gl.colorMask(true, true, true, true);
    gl.depthFunc(gl.ALWAYS);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
    for (let bit = 0; bit < height; ++bit) {
      gl.scissor(x, bit, 1, 1);
      gl.stencilFunc(gl.EQUAL, 255, 1 << bit);
      draw();
    }
  }
  gl.disable(gl.SCISSOR_TEST);
  gl.disable(gl.STENCIL_TEST);
}

// Draws depths with the first program, then with the second, which passes where they are equal.
function drawTwice(gl, programs, draw) {
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.ALWAYS);
  gl.colorMask(false, false, false, false);
  gl.useProgram(programs[0]);
  draw();
  gl.colorMask(true, true, true, true);
  gl.depthFunc(gl.EQUAL);
  gl.useProgram(programs[1]);
  draw();
}

function drawOperation(device, work, inputs, programs) {
  const { gl } = device, [width, height] = work.size, corners = wordsOf(work.corners);
  gl.viewport(0, 0, width, height);
  gl.disable(gl.DEPTH_TEST);
  gl.depthRange(0, 1);
  gl.depthMask(true);
  if (work.target === 'words') gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
  else gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
  gl.clearDepth(1);
  gl.clear(gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  gl.bindVertexArray(device.corners);
  gl.bindBuffer(gl.ARRAY_BUFFER, device.cornerBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STREAM_DRAW);
  const draw = () => gl.drawArrays(gl.TRIANGLES, 0, corners.length / 4);
  gl.useProgram(programs[0]);
  if (work.stencil) drawStencil(gl, work, inputs, draw);
  else if (programs.length === 2) drawTwice(gl, programs, draw);
  else draw();
}

// The results as an array of words; an Error with the reason if there are none.
function answerOperation(device, work) {
  const { gl } = device, [width, height] = work.size, inputs = wordsOf(work.inputs);
  while (gl.getError() !== gl.NO_ERROR);
  if (!device.corners) {
    device.corners = gl.createVertexArray();
    device.cornerBuffer = gl.createBuffer();
    gl.bindVertexArray(device.corners);
    gl.bindBuffer(gl.ARRAY_BUFFER, device.cornerBuffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 16, 0);
  }
  const programs = work.programs.map((texts) => makeOperationProgram(gl, texts));
  const isWords = work.target === 'words', color = makeTexture(gl, isWords ? gl.RGBA32UI : gl.SRGB8_ALPHA8, width, height);
  const textures = [color], target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  try {
    if (work.stencil || programs.length === 2) {
      textures.push(makeTexture(gl, work.stencil ? gl.DEPTH24_STENCIL8 : gl.DEPTH_COMPONENT32F, width, height));
      gl.framebufferTexture2D(gl.FRAMEBUFFER, work.stencil ? gl.DEPTH_STENCIL_ATTACHMENT : gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, textures[1], 0);
    }
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error('the targets cannot be drawn to together');
    textures.push(makeSource(gl, 'RGBA32UI', 'RGBA_INTEGER', 'UNSIGNED_INT', width, height, inputs));
    const units = [textures[textures.length - 1]];
    if (work.image) units.push(makeImage(gl, work.image));
    textures.push(...units.slice(1));
    for (const [unit, texture] of units.entries()) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    }
    drawOperation(device, work, inputs, programs);
    const words = new Uint32Array(4 * width * height);
    if (isWords) gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
    else {
      const codes = new Uint8Array(words.length);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
      words.set(codes);
    }
    const error = gl.getError();
    if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
    return npy('<u4', [height, width, 4], new Uint8Array(words.buffer));
  } finally {
    gl.activeTexture(gl.TEXTURE0);
    gl.disable(gl.DEPTH_TEST);
    gl.deleteFramebuffer(target);
    for (const texture of textures) gl.deleteTexture(texture);
    for (const program of programs) gl.deleteProgram(program);
  }
}
