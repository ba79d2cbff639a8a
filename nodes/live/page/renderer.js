// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Draws with WebGL2: the points of a frame in their original layout, and the lines and faces of batches.
// Throws if the browser has no WebGL2.
import { LINE_BYTES, LINE_CORNERS, VERTEX_BYTES } from "./batch.js";
import { THEMES } from "./palette.js";
import { FACE_FRAGMENT, FACE_VERTEX, LINE_FRAGMENT, LINE_VERTEX, POINT_FRAGMENT, POINT_VERTEX } from "./shaders.js";

const COLOURS_WIDE = 1024;

class Program {
  constructor(gl, vertex, fragment) {
    this.gl = gl;
    this.id = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.id, shader);
    }
    gl.linkProgram(this.id);
    if (!gl.getProgramParameter(this.id, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = gl.getAttachedShaders(this.id).map((shader) => gl.getShaderInfoLog(shader));
      throw new Error(`a shader does not compile: ${[...logs, gl.getProgramInfoLog(this.id)].join(" ")}`);
    }
    this.locations = new Map();
  }

  uniformLocation(name) {
    if (!this.locations.has(name)) this.locations.set(name, this.gl.getUniformLocation(this.id, name));
    return this.locations.get(name);
  }
}

export class Renderer {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false });
    if (!gl) throw new Error("This browser offers no WebGL2, which the view needs.");
    this.gl = gl;
    this.canvas = canvas;
    this.setUp();
  }

  // Creates all WebGL objects. Called at the start, and again when the browser has restored a lost context.
  setUp() {
    const gl = this.gl;
    this.pointProgram = new Program(gl, POINT_VERTEX, POINT_FRAGMENT);
    this.lineProgram = new Program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.faceProgram = new Program(gl, FACE_VERTEX, FACE_FRAGMENT);
    this.pointArray = gl.createVertexArray();
    this.pointBuffer = gl.createBuffer();
    this.points = null;
    this.colours = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    this.setObjectColours([]);
    this.corners = gl.createBuffer();
    this.reserved = 0;
    this.volumes = this.newLayer();
    this.ground = this.newLayer();
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Creates the buffers of one batch.
  newLayer() {
    const gl = this.gl;
    const layer = { lines: 0, indices: 0, buffers: [0, 1, 2].map(() => gl.createBuffer()) };
    const [lines, vertices, indices] = layer.buffers;
    layer.lineArray = gl.createVertexArray();
    gl.bindVertexArray(layer.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, lines);
    this.attribute(0, 3, gl.FLOAT, false, LINE_BYTES, 0);
    this.attribute(1, 3, gl.FLOAT, false, LINE_BYTES, 12);
    this.attribute(2, 4, gl.UNSIGNED_BYTE, true, LINE_BYTES, 24);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.corners);
    layer.faceArray = gl.createVertexArray();
    gl.bindVertexArray(layer.faceArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
    this.attribute(0, 3, gl.FLOAT, false, VERTEX_BYTES, 0);
    this.attribute(1, 3, gl.BYTE, true, VERTEX_BYTES, 12);
    this.attribute(2, 4, gl.UNSIGNED_BYTE, true, VERTEX_BYTES, 16);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    return layer;
  }

  attribute(index, size, type, normalised, stride, offset) {
    this.gl.enableVertexAttribArray(index);
    this.gl.vertexAttribPointer(index, size, type, normalised, stride, offset);
  }

  // Enlarges the index buffer of the lines, which all layers share. It has two triangles for each line.
  reserveLines(lines) {
    if (lines <= this.reserved) return;
    this.reserved = 2 ** Math.ceil(Math.log2(lines));
    const indices = new Uint32Array(6 * this.reserved);
    for (let line = 0; line < this.reserved; ++line) {
      [0, 1, 2, 2, 1, 3].forEach((corner, k) => (indices[6 * line + k] = LINE_CORNERS * line + corner));
    }
    this.gl.bindVertexArray(null);
    this.gl.bindBuffer(this.gl.ELEMENT_ARRAY_BUFFER, this.corners);
    this.gl.bufferData(this.gl.ELEMENT_ARRAY_BUFFER, indices, this.gl.STATIC_DRAW);
  }

  // `points` are as described in messages.js, or null.
  setPoints(points) {
    this.points = points;
    if (!points) return;
    const gl = this.gl;
    gl.bindVertexArray(this.pointArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.pointBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, points.bytes, gl.STREAM_DRAW);
    this.attribute(0, 3, gl.FLOAT, false, points.stride, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribIPointer(1, 1, gl.UNSIGNED_INT, points.stride, 12);
    if (points.intensity) this.attribute(2, 1, gl.FLOAT, false, points.stride, 16);
    else gl.disableVertexAttribArray(2);
    gl.bindVertexArray(null);
  }

  // Sets the colours of the objects' points. The index of a colour is the label of the points.
  setObjectColours(colours) {
    const gl = this.gl;
    const rows = Math.max(1, Math.ceil(colours.length / COLOURS_WIDE));
    const texels = new Uint8Array(4 * COLOURS_WIDE * rows);
    colours.forEach((colour, i) => texels.set([...colour.map((part) => Math.round(255 * part)), 255], 4 * i));
    this.objects = colours.length;
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, COLOURS_WIDE, rows, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  }

  setLayer(layer, batch) {
    const gl = this.gl;
    const [lines, vertices, indices] = layer.buffers;
    layer.lines = batch.lines;
    this.reserveLines(batch.lines);
    layer.indices = batch.indexCount;
    gl.bindVertexArray(layer.faceArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, lines);
    const lineBytes = batch.lines * LINE_CORNERS * LINE_BYTES;
    gl.bufferData(gl.ARRAY_BUFFER, new Uint8Array(batch.lineBytes, 0, lineBytes), gl.STREAM_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
    gl.bufferData(gl.ARRAY_BUFFER, new Uint8Array(batch.vertexBytes, 0, batch.vertices * VERTEX_BYTES), gl.STREAM_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, batch.indices.subarray(0, batch.indexCount), gl.STREAM_DRAW);
    gl.bindVertexArray(null);
  }

  // `look` is {theme, mode, range, pointSize, lineWidth, origin, faces, grid}. Sizes are in device pixels.
  draw(camera, look) {
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...THEMES[look.theme].background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    const matrix = new Float32Array(camera.matrix());
    if (this.points) this.drawPoints(matrix, camera, look);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    if (look.grid) this.drawLines(this.ground, matrix, 1);
    if (look.faces) this.drawFaces(matrix, camera);
    gl.depthMask(true);
    this.drawLines(this.volumes, matrix, look.lineWidth);
    gl.disable(gl.BLEND);
  }

  drawPoints(matrix, camera, look) {
    const gl = this.gl;
    const program = this.pointProgram;
    const theme = THEMES[look.theme];
    gl.useProgram(program.id);
    gl.uniformMatrix4fv(program.uniformLocation("matrix"), false, matrix);
    gl.uniform3fv(program.uniformLocation("shift"), this.points.origin.map((x, k) => x - look.origin[k]));
    gl.uniform3fv(program.uniformLocation("up"), camera.up);
    gl.uniform2fv(program.uniformLocation("range"), look.range);
    gl.uniform3fv(program.uniformLocation("ramp"), theme.ramp);
    gl.uniform3fv(program.uniformLocation("plain"), theme.plain);
    gl.uniform1i(program.uniformLocation("mode"), { height: 1, intensity: 2 }[look.mode] ?? 0);
    gl.uniform1i(program.uniformLocation("objects"), this.objects);
    gl.uniform1f(program.uniformLocation("size"), look.pointSize);
    gl.bindTexture(gl.TEXTURE_2D, this.colours);
    gl.bindVertexArray(this.pointArray);
    gl.drawArrays(gl.POINTS, 0, this.points.count);
  }

  drawLines(layer, matrix, width) {
    const gl = this.gl;
    if (layer.lines === 0) return;
    gl.useProgram(this.lineProgram.id);
    gl.uniformMatrix4fv(this.lineProgram.uniformLocation("matrix"), false, matrix);
    gl.uniform2f(this.lineProgram.uniformLocation("viewport"), this.canvas.width, this.canvas.height);
    gl.uniform1f(this.lineProgram.uniformLocation("width"), width);
    gl.bindVertexArray(layer.lineArray);
    gl.drawElements(gl.TRIANGLES, 6 * layer.lines, gl.UNSIGNED_INT, 0);
  }

  drawFaces(matrix, camera) {
    const gl = this.gl;
    if (this.volumes.indices === 0) return;
    gl.useProgram(this.faceProgram.id);
    gl.uniformMatrix4fv(this.faceProgram.uniformLocation("matrix"), false, matrix);
    gl.uniform3fv(this.faceProgram.uniformLocation("eye"), camera.eye());
    gl.bindVertexArray(this.volumes.faceArray);
    gl.drawElements(gl.TRIANGLES, this.volumes.indices, gl.UNSIGNED_INT, 0);
  }
}
